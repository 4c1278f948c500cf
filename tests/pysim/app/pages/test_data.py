"""The page of data: what stands in its tables, and what its buttons write."""

from dataclasses import replace

import numpy as np

from pysim.app.pages.data import _log_number, _row
from pysim.identify.data_check import check_dataset
from pysim.types import FrequencyResponse, SineTest
from tests.pysim.diagnosis_answer import dataset


def test_a_point_is_told_with_its_unit_and_sorted_by_its_size() -> None:
    signals = tuple(replace(signal, unit="Pa") if signal.name == "F" else signal for signal in dataset().signals)
    sine = replace(dataset().records[0], command="F", offset=1e7, amplitude=2e6)
    row = _row(check_dataset(replace(dataset(), signals=signals, records=(sine,))).records[0])
    assert row[-4:-1] == [{"text": "100 bar", "value": 1e7}, {"text": "20 bar", "value": 2e6}, "1"]
    log = _row(check_dataset(dataset()).records[-1])
    assert log[-4:-1] == ["", "", ""]


def test_of_two_records_of_one_log_the_one_that_was_picked_is_shown() -> None:
    sine, other, *_ = dataset().records
    table = FrequencyResponse(np.ones(1), np.ones(1), np.zeros(1), SineTest(0.0, 1.0, "F", "x"), "made up")
    records = (replace(sine, source="a.csv"), replace(sine, data=table), replace(other, source="a.csv"))
    check = check_dataset(replace(dataset(), records=records))
    assert [_log_number(check, row) for row in (-1, 0, 1, 2, 3)] == [None, 0, None, 1, None]
