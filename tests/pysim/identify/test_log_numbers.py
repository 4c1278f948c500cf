"""Compared records find their logs, though one file holds several."""

from dataclasses import replace

import numpy as np
import pytest

from pysim.identify import ComparedLog, log_numbers
from pysim.types import Dataset, MeasuredRecord, Record
from tests.pysim.diagnosis_story import dataset, stage

SINE = "frequency-response"


def log(
    *names: str, source: str = "a.tdms", use: str = "fit", at: tuple[float, float, float] | None = None
) -> MeasuredRecord:
    """A log of some signals; `at` is offset, amplitude and frequency of a stepped sine."""
    data = Record(np.arange(2.0), np.zeros((2, len(names))), names, ("1",) * len(names))
    return MeasuredRecord(source, SINE if at else "step", use, data, *(at or (None, None, None)))


def data(*logs: MeasuredRecord) -> Dataset:
    return replace(dataset(), records=logs)


def compared(*records: MeasuredRecord, without: tuple[str, ...] = ("u", "w")) -> list[ComparedLog]:
    """A record per log, in this order; frequencies have gone by way of rad/s."""
    found = []
    for one in records:
        assert isinstance(one.data, Record)
        frequency = None if one.frequency is None else (2 * np.pi * one.frequency) / (2 * np.pi)
        names = tuple(name for name in one.data.names if name not in without)
        found.append(ComparedLog(one.source, one.kind, one.use, names, frequency))
    return found


def test_a_file_that_holds_one_log_is_told_by_its_name() -> None:
    records = [ComparedLog.of(record) for record in stage("prior").records]
    assert log_numbers(records, dataset()) == (0, 1, 2, 3)
    assert log_numbers(records, data(*reversed(dataset().records))) == (3, 2, 1, 0)
    assert log_numbers(records, data(*dataset().records[1:])) == (None, 0, 1, 2)


@pytest.mark.parametrize(
    "logs",
    [
        (log("u", "x"), log("u", "y"), log("u", "x", "y")),  # the same command, other answers
        (log("u", "x"), log("u", "x", use="validate"), log("u", "x", source="b.tdms")),
        (log("u", "x"), log("w", "x")),  # other commands, or columns of the same names further right
        (log("u", "x", at=(0, 1, 5)), log("u", "x", at=(0, 1, 2)), log("u", "x", at=(0, 1, 0.1))),
        (log("u", "x", at=(0, 1, 5)), log("u", "x")),
    ],
)
def test_logs_of_one_file_are_told_apart(logs: tuple[MeasuredRecord, ...]) -> None:
    assert log_numbers(compared(*logs), data(*logs)) == tuple(range(len(logs)))


def test_sines_are_found_in_whatever_order_their_tests_have_them() -> None:
    early, wide, narrow = (
        log("u", "x", source=s, at=at) for s, at in (("b", (0, 1, 9)), ("a", (0, 2, 3)), ("a", (0, 1, 3)))
    )
    logs = data(early, wide, narrow)
    assert log_numbers(compared(narrow, early, wide), logs) == (2, 0, 1)  # of the test that began first, then the other
    slow = log("u", "x", at=(0, 1, 1))
    fast = log("u", "x", at=(0, 1, 8))
    found = compared(slow, fast)
    assert log_numbers(found, data(fast, slow)) == (1, 0)
    found[0] = found[0]._replace(frequency=None)  # it had not settled
    assert log_numbers(found, data(fast, slow)) == (1, 0)


def test_what_nothing_tells_apart_is_taken_for_neither() -> None:
    one, other = log("u", "x"), log("w", "x")
    assert log_numbers(compared(one), data(one, other)) == (None,)  # the other could not be simulated
    assert log_numbers(compared(log("u", "y"), other), data(one, log("u", "y"))) == (1, 0)
    assert log_numbers(compared(), data(one)) == ()
