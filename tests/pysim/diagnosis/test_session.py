"""Which measurements are refused before anything is simulated, and what a session keeps of the others."""

from dataclasses import replace

import numpy as np
import pytest

from pysim.diagnosis import compare
from pysim.types import BadInput, Dataset, Record
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


def test_a_held_out_log_keeps_its_place_among_all_logs() -> None:
    """Results name a log by its number in the data set: one that is held out must not shift the others."""
    data = measured("mass", fit=(1, 2, 3), length=2.0)
    uses = ("fit", "test", "fit", "validate")
    data = replace(data, records=tuple(replace(one, use=use) for one, use in zip(data.records, uses, strict=True)))
    (step,) = compare(given("mass", data, ()), refitted=False).history
    assert sorted(record.index for record in step.records) == [0, 1, 2, 3]
    for record in step.records:
        own = data.records[record.index]
        assert (record.source, record.use) == (own.source, own.use)
        assert isinstance(own.data, Record)
        np.testing.assert_array_equal(record.measured["x"], own.data["x"])
