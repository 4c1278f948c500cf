"""Which measurements are refused before anything is simulated."""

from dataclasses import replace

import pytest

from pysim.types import BadInput, Dataset
from tests.pysim.diagnosis.plants import given, measured


def still() -> Dataset:
    """A log in which nothing pushes the mass."""
    data = measured("mass", fit=(1,), validate=(), length=4.0)
    (record,) = data.records
    record = replace(record, data=replace(record.data, values=record.data.values * [0.0, 1.0]))
    return replace(data, records=(record,))


def test_a_log_whose_input_never_moves_is_refused_unless_the_plant_may_move_as_it_begins() -> None:
    with pytest.raises(BadInput):
        given("mass", still(), [], initial="near rest")
    assert given("mass", still(), [], initial="estimate").dataset.records
