"""Where the error is: every record in its cell."""

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from pysim.app.error_map import command_unit, error_maps, response_unit, working_point
from pysim.io import read_stages, write_stages
from pysim.types import Dataset, MeasuredSignal, Record
from tests.pysim.diagnosis_answer import dataset, found_offset


def test_sines_go_by_working_point_and_frequency_and_logs_by_signal(tmp_path: Path) -> None:
    write_stages(tmp_path / "a.npz", found_offset().history)
    stage = read_stages(tmp_path / "a.npz").about[1]
    sines, logs = error_maps(stage, dataset())
    assert (sines.rows, sines.columns, sines.title) == (("50 ± 10 N",), ("1", "5"), "Frequency (Hz)")
    assert sines.logs == ((0, 1),)
    assert (logs.rows, logs.columns) == (("wave.txt (fitted)", "held.txt (used to choose)"), ("x",))
    told = {record["source"]: record["rms"][0] for record in stage["records"]}
    for one in (sines, logs):
        for row, own in zip(one.logs, one.values, strict=True):
            assert [told[dataset().logs()[number].source] for number in row if number is not None] == list(own)


def sine(index: int, rms: float, *names: str) -> dict[str, Any]:
    """A stepped sine of 1 Hz, as a file of stages has it."""
    names = names or ("x",)
    about = {"index": index, "source": "a.txt", "use": "fit", "frequency": 1.0}
    return {**about, "names": list(names), "rms": [rms] * len(names)}


def points(*tests: tuple[str, str, float, float], unit: str = "N", names: Sequence[str] = ("x",)) -> Dataset:
    """A data set of stepped sines.

    Args:
        tests: source, input, offset and amplitude of each.
        names: of what every log tells beside its input.
    """
    inputs = tuple(MeasuredSignal(name, "input", unit, name, name) for name in dict.fromkeys(t[1] for t in tests))
    sample = dataset().records[0]
    records = []
    for source, command, offset, amplitude in tests:
        data = Record(np.arange(2.0), np.zeros((2, 1 + len(names))), (command, *names), (unit, *["m"] * len(names)))
        test = replace(sample, source=source, command=command, offset=offset, amplitude=amplitude, data=data)
        records.append(replace(test, frequency=1.0))
    return replace(dataset(), signals=inputs, records=tuple(records))


def test_a_repeat_hides_no_other_and_can_be_opened() -> None:
    data = points(("a.txt", "F", 50.0, 10.0), ("b.txt", "F", 50.0, 10.0))
    (found,) = error_maps({"records": [sine(0, 30.0), sine(1, 1.0)]}, data)
    assert found.rows == ("50 ± 10 N", "50 ± 10 N, repeat 2")
    assert (found.values, found.logs) == (((30.0,), (1.0,)), ((0,), (1,)))


def test_the_same_point_on_another_input_has_a_row_of_its_own() -> None:
    data = points(("a.txt", "F", 50.0, 10.0), ("b.txt", "G", 50.0, 10.0), names=("x", "y"))
    (found,) = error_maps({"records": [sine(0, 30.0, "x", "y"), sine(1, 1.0, "x", "y")]}, data)
    assert found.rows == ("F: 50 ± 10 N, x", "F: 50 ± 10 N, y", "G: 50 ± 10 N, x", "G: 50 ± 10 N, y")
    assert found.logs == ((0,), (0,), (1,), (1,))


def test_two_records_of_one_file_are_told_apart_by_their_signals() -> None:
    """As a .tdms file holds them; each has the point of its own test, and opens its own log."""
    one, other = points(("a.tdms", "F", 50.0, 10.0), ("a.tdms", "F", 20.0, 5.0)).records
    assert isinstance(other.data, Record)
    data = points(("a.tdms", "F", 50.0, 10.0))
    data = replace(data, records=(one, replace(other, data=replace(other.data, names=("F", "y")))))
    (found,) = error_maps({"records": [sine(0, 30.0), sine(1, 1.0, "y")]}, data)
    assert found.rows == ("20 ± 5 N, y", "50 ± 10 N, x")
    assert (found.values, found.logs) == (((1.0,), (30.0,)), ((1,), (0,)))


def test_two_records_of_one_log_stand_beside_each_other() -> None:
    twice = [{**sine(2, rms), "frequency": None} for rms in (30.0, 1.0)]
    (found,) = error_maps({"records": twice}, dataset())
    assert found.rows == ("a.txt (fitted)", "a.txt (fitted), repeat 2")
    assert found.values == ((30.0,), (1.0,))


def test_points_are_told_in_the_unit_that_people_read() -> None:
    (found,) = error_maps({"records": [sine(0, 1.0)]}, points(("a.txt", "p", 1e7, 2e6), unit="Pa"))
    assert found.rows == ("100 ± 20 bar",)


@pytest.mark.parametrize(
    ("offset", "amplitude", "unit", "words"),
    [
        (1e7, 2e6, "Pa", "100 ± 20 bar"),
        (0.05, 0.002, "m", "50 ± 2 mm"),
        (-25.0, 10.0, "%", "-25 ± 10 %"),
        (0.5, 0.1, "1", "0.5 ± 0.1"),
        (50.0, 10.0, "", "50 ± 10"),
    ],
)
def test_both_numbers_are_in_the_unit_behind_them(offset: float, amplitude: float, unit: str, words: str) -> None:
    assert working_point(offset, amplitude, unit) == words


def test_the_unit_is_that_of_the_command() -> None:
    assert [command_unit(dataset(), name) for name in ("F", "x", "", "gone")] == ["N", "m", "", ""]


def test_a_response_of_logs_has_the_unit_of_the_logs_at_its_point() -> None:
    data = replace(dataset(), records=tuple(replace(record, command="F") for record in dataset().records))
    for name, offset, unit in (("command", 50.0, "N"), ("command", 51.0, ""), ("x", 51.0, "m")):
        assert response_unit(data, {"input": name, "offset": offset, "amplitude": 10.0}) == unit
