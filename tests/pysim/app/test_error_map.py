"""Where the error is: every record in its cell."""

from dataclasses import replace
from pathlib import Path
from typing import Any

from pysim.app.error_map import error_maps
from pysim.io import read_stages, write_stages
from pysim.types import Dataset, MeasuredSignal
from tests.pysim.diagnosis_story import dataset, story


def test_sines_go_by_working_point_and_frequency_and_logs_by_signal(tmp_path: Path) -> None:
    write_stages(tmp_path / "a.npz", story().stages)
    stage = read_stages(tmp_path / "a.npz").about[1]
    sines, logs = error_maps(stage, dataset())
    assert (sines.rows, sines.columns, sines.title) == (("50 ± 10 N",), ("1", "5"), "Frequency (Hz)")
    assert sines.sources == (("sines/1Hz.txt", "sines/5Hz.txt"),)
    assert (logs.rows, logs.columns) == (("wave.txt (fitted)", "held.txt (held out)"), ("x",))
    told = {record["source"]: record["rms"][0] for record in stage["records"]}
    for one in (sines, logs):
        for row, own in zip(one.sources, one.values, strict=True):
            assert [told[source] for source in row] == list(own)


def sine(source: str, rms: float, *names: str) -> dict[str, Any]:
    """A stepped sine of 1 Hz, as a file of stages has it."""
    names = names or ("x",)
    return {"source": source, "use": "fit", "frequency": 1.0, "names": list(names), "rms": [rms] * len(names)}


def points(*tests: tuple[str, str, float, float], unit: str = "N") -> Dataset:
    """A data set of stepped sines.

    Args:
        tests: source, input, offset and amplitude of each.
    """
    inputs = tuple(MeasuredSignal(name, "input", unit, name, name) for name in dict.fromkeys(t[1] for t in tests))
    sample = dataset().records[0]
    records = [
        replace(sample, source=source, command=command, offset=offset, amplitude=amplitude, frequency=1.0)
        for source, command, offset, amplitude in tests
    ]
    return replace(dataset(), signals=inputs, records=tuple(records))


def test_a_repeat_hides_no_other_and_can_be_opened() -> None:
    data = points(("a.txt", "F", 50.0, 10.0), ("b.txt", "F", 50.0, 10.0))
    (found,) = error_maps({"records": [sine("a.txt", 30.0), sine("b.txt", 1.0)]}, data)
    assert found.rows == ("50 ± 10 N", "50 ± 10 N, repeat 2")
    assert (found.values, found.sources) == (((30.0,), (1.0,)), (("a.txt",), ("b.txt",)))


def test_the_same_point_on_another_input_has_a_row_of_its_own() -> None:
    data = points(("a.txt", "F", 50.0, 10.0), ("b.txt", "G", 50.0, 10.0))
    (found,) = error_maps({"records": [sine("a.txt", 30.0), sine("b.txt", 1.0, "x", "y")]}, data)
    assert found.rows == ("F: 50 ± 10 N, x", "G: 50 ± 10 N, x", "G: 50 ± 10 N, y")
    assert found.sources == (("a.txt",), ("b.txt",), ("b.txt",))


def test_two_records_of_one_log_stand_beside_each_other() -> None:
    twice = [{**sine("a.txt", rms), "frequency": None} for rms in (30.0, 1.0)]
    (found,) = error_maps({"records": twice}, dataset())
    assert found.rows == ("a.txt (fitted)", "a.txt (fitted), repeat 2")
    assert found.values == ((30.0,), (1.0,))


def test_points_are_told_in_the_unit_that_people_read() -> None:
    (found,) = error_maps({"records": [sine("a.txt", 1.0)]}, points(("a.txt", "p", 1e7, 2e6), unit="Pa"))
    assert found.rows == ("100 ± 20 bar",)
