from dataclasses import replace

import numpy as np
import pytest

from pysim.identify.greybox.checkpoint import digest
from pysim.types import Record
from tests.pysim.identify.greybox.functions import space


def test_a_digest_tells_the_last_bit_of_an_array() -> None:
    s = space([1.0, 2.0])
    assert digest(s) == digest(space([1.0, 2.0]))
    assert digest(s) != digest(space([1.0, np.nextafter(2.0, 3.0)]))
    long = np.zeros(5000)  # too long for numpy to print in full
    assert digest(long) != digest(np.where(np.arange(5000) == 2500, 1.0, long))


def test_a_digest_tells_kinds_and_sizes_apart() -> None:
    different = [(), ((),), ("a", "b"), ("ab",), ("a", ("b",)), {"a": "b"}, None, "None", 1.0, "1.0", np.ones(4)]
    different += [np.ones((2, 2)), np.ones(4, dtype=np.int64), (np.ones(2), np.ones(2)), (np.ones(1), np.ones(3))]
    assert len({digest(one) for one in different}) == len(different)


def test_a_digest_overlooks_order_of_names_and_what_is_only_said() -> None:
    assert digest({"a": 1, "b": 2.0}) == digest({"b": 2.0, "a": 1.0})
    record = Record(np.arange(2.0), np.ones((2, 1)), ("y",), ("m",), origin="measured, here/log.txt")
    assert digest(record) == digest(replace(record, origin="measured, there/log.txt"))
    assert digest(record) != digest(replace(record, units=("bar",)))


def test_what_has_no_exact_form_is_refused() -> None:
    with pytest.raises(TypeError, match="object has no digest"):
        digest(("a", object()))
