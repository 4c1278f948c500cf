"""Numbers as JSON takes them."""

import json
import math

import numpy as np
import pytest

from pysim.io import json_number
from pysim.types.json_number import json_data


@pytest.mark.parametrize("value", [math.inf, -math.inf, math.nan, None, np.float64(np.inf)])
def test_what_json_does_not_know_becomes_none(value: float | None) -> None:
    assert json_number(value) is None


def test_a_number_stays_and_can_be_written() -> None:
    assert json.dumps([json_number(np.float64(0.1)), json_number(-2.5)], allow_nan=False) == "[0.1, -2.5]"


def test_whatever_holds_numbers_can_be_written() -> None:
    value = {
        "a": np.array([[1.0, np.nan], [np.inf, 2.0]]),
        "b": (np.float64(3.0), np.int64(4), np.bool_(True), "c", None),
    }
    written = json.dumps(json_data(value), allow_nan=False)
    assert json.loads(written) == {"a": [[1.0, None], [None, 2.0]], "b": [3.0, 4, True, "c", None]}
