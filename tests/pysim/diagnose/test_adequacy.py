"""Which measurements are refused, and which only weaken the answer."""

from dataclasses import replace

import numpy as np
import pytest

from pysim.diagnosis.adequacy import shortcomings
from pysim.types import BadInput, Dataset, FrequencyResponse, MeasuredRecord, MeasuredSignal, Record, SineTest

FREE = ("m", "d", "k")


def data(count: int = 30, *, second: float = 1.0, held: bool = True, spool: bool = True) -> Dataset:
    """Two inputs, one of them times `second`, and two outputs."""
    time = np.arange(float(count))
    columns = np.column_stack([np.sin(time), second * np.cos(time), time, time])[:, : 4 if spool else 3]
    names = ("F", "Q", "x", "u")[: columns.shape[1]]
    roles = ("input", "input", "output", "output")
    record = MeasuredRecord("a.txt", "other", "fit", Record(time, columns, names, ("1",) * len(names)))
    signals = tuple(MeasuredSignal(n, role, "1", n, n) for n, role in zip(names, roles, strict=False))
    records = (record, replace(record, source="b.txt", use="validate")) if held else (record,)
    return Dataset("toy", "", "mass", signals, records)


def test_a_full_set_has_no_shortcomings() -> None:
    assert shortcomings(data(), FREE) == ()


def test_too_few_samples_for_the_parameters_are_refused() -> None:
    assert shortcomings(data(15), FREE) == ()  # of two signals
    with pytest.raises(BadInput, match="28 samples to fit for 3 free parameters; log at least 30"):
        shortcomings(data(14), FREE)


def test_what_is_missing_is_noted() -> None:
    for lacking, word in ((data(held=False), "held out"), (data(spool=False), "x"), (data(second=0.0), "Q")):
        (note,) = shortcomings(lacking, FREE)
        assert f" {word} " in f" {note} "


def test_inputs_that_all_stand_still_are_refused() -> None:
    still = data()
    record = still.records[0]
    assert isinstance(record.data, Record)
    calm = replace(record.data, values=record.data.values * np.array([0.0, 0.0, 1.0, 1.0]))
    with pytest.raises(BadInput, match="F, Q is constant in every record to fit"):
        shortcomings(replace(still, records=(replace(record, data=calm),)), FREE)


def test_a_response_counts_two_numbers_per_frequency() -> None:
    f = np.arange(1.0, 14.0)
    response = FrequencyResponse(f, f, -f, SineTest(0, 1, "F", "x"), "measured")
    table = MeasuredRecord("t.csv", "frequency-response-table", "fit", response)
    assert len(shortcomings(replace(data(), records=(table,)), ("m", "d"))) == 2  # nothing held out, one signal
    with pytest.raises(BadInput, match="26 samples"):
        shortcomings(replace(data(), records=(table,)), FREE)
