"""What is written is read back to the printed digits."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from pysim.io import read_dataset, read_single_log, write_dataset
from pysim.types import BadInput, Dataset, FrequencyResponse, MeasuredRecord, MeasuredSignal, Record, SineTest
from pysim.types.record_kind import Command

SIGNALS = (
    MeasuredSignal("cmd", "input", "%", "command", "alphaCMD", hold=Command.STEPS),
    MeasuredSignal("p A", "output", "Pa", "pressure", "chamber.p", noise=2e3, resolution=5e3),
    MeasuredSignal("w", "output", "rad/s", "speed", "w", noise=0.01),
)
UNITS = {"p A": "bar", "w": "rpm"}


def dataset(values: np.ndarray, time: np.ndarray) -> Dataset:
    log = Record(time, values, ("cmd", "p A", "w"), ("%", "Pa", "rad/s"), origin="measured, sub/log.txt")
    part = Record(time, values[:, [2, 0]], ("w", "cmd"), ("rad/s", "%"), origin="virtual bench")
    f = np.array([0.1, 1.0, 10.0])
    response = FrequencyResponse(
        f, np.array([1e3, 2e3, 1e-2]), np.array([-0.1, -3.0, -6.5]), SineTest(5.0, 2.0, "cmd", "p A"), "a table"
    )
    records = (
        MeasuredRecord("sub/log.txt", "frequency-response", "fit", log, 25.0, 0.1, 3.7),
        MeasuredRecord("w.txt", "other", "validate", part, initial="estimate", begin=86400.5),
        MeasuredRecord("tables/one.csv", "frequency-response-table", "fit", response, 5.0, 2.0),
    )
    return Dataset("written", 'with "quotes" and °C', "pump", SIGNALS, records)


def written(folder: Path, data: Dataset) -> Dataset:
    return read_dataset(write_dataset(folder, data, units=UNITS))


TIME = np.arange(50) / 70
VALUES = np.random.default_rng(1).normal(size=(50, 3)) * [40.0, 3e6, 10.0]


def test_a_csv_has_commas_between_its_columns(tmp_path: Path) -> None:
    data = dataset(VALUES, TIME)
    (first, *others) = data.records
    data = replace(data, records=(replace(first, source="run.CSV"), *others))
    back = written(tmp_path / "new", data)
    heading, row, *_ = (tmp_path / "new" / "run.CSV").read_text().splitlines()
    assert heading.split(",") == ["time_s", "cmd_pct", "p A_bar", "w_rpm"]
    assert len(row.split(",")) == 4
    assert (tmp_path / "new" / "w.txt").read_text().splitlines()[0] == "time_s\tw_rpm\tcmd_pct"
    assert back.records[0].data.values[:, 0] == pytest.approx(np.round(VALUES[:, 0], 4))


def test_everything_comes_back(tmp_path: Path) -> None:
    data = dataset(VALUES, TIME)
    back = written(tmp_path / "new", data)
    assert (back.name, back.description, back.system) == (data.name, data.description, data.system)
    for new, old in zip(back.signals, data.signals, strict=True):
        assert replace(new, noise=None, resolution=None) == replace(old, noise=None, resolution=None)
        assert (new.noise, new.resolution) == (pytest.approx(old.noise), pytest.approx(old.resolution))
    for new, old in zip(back.records, data.records, strict=True):
        assert (new.source, new.kind, new.use, new.frequency) == (old.source, old.kind, old.use, old.frequency)
        assert (new.initial, new.begin) == (old.initial, old.begin)
        assert (new.offset, new.amplitude) == (pytest.approx(old.offset), pytest.approx(old.amplitude))
    log, part, response = (record.data for record in back.records)
    assert (log.names, log.units, log.origin) == (("cmd", "p A", "w"), ("%", "Pa", "rad/s"), "measured, sub/log.txt")
    assert (part.names, part.origin) == (("w", "cmd"), "virtual bench")
    # noise and resolution over a hundred; seven digits of the command, which reaches some 100 percent
    np.testing.assert_allclose(log["p A"], VALUES[:, 1], atol=2e3 / 100 / 2)
    np.testing.assert_allclose(log["w"], VALUES[:, 2], atol=0.01 / 100 / 2)
    np.testing.assert_allclose(part["cmd"], VALUES[:, 0], atol=0.5e-4)
    np.testing.assert_allclose(log.time, TIME, atol=1e-4 / 70)
    np.testing.assert_allclose(response.gain, data.responses()[0].gain, rtol=1e-12)
    np.testing.assert_allclose(response.phase, data.responses()[0].phase, rtol=1e-12)


def test_a_log_without_a_description_comes_back(tmp_path: Path) -> None:
    (tmp_path / "a.txt").write_text("0.0\t1\t2\n0.1\t2\t4\n")
    alone = read_single_log(tmp_path / "a.txt", "step", ("time", "u", "y"), ("%", "deg"))
    back = read_dataset(write_dataset(tmp_path / "new", alone))
    assert (back.name, back.description, back.system) == ("a.txt", "-", "-")
    np.testing.assert_allclose(back.logs()[0].data.values, alone.logs()[0].data.values, atol=1e-7)
    assert read_dataset(write_dataset(tmp_path / "unnamed", replace(alone, name=""))).name == "unnamed"


def test_a_test_that_could_not_be_read_is_not_written(tmp_path: Path) -> None:
    data = dataset(VALUES, TIME)
    sine = replace(data.records[0], offset=None, frequency=None)
    with pytest.raises(
        BadInput, match=r"'sub/log\.txt': kind 'frequency-response' needs offset and frequency; tell what"
    ):
        write_dataset(tmp_path / "new", replace(data, records=(sine,)))
    assert not (tmp_path / "new").exists()


def test_units_with_a_zero_of_their_own_come_back(tmp_path: Path) -> None:
    signals = (MeasuredSignal("T", "input", "K", "", "T", noise=0.1), MeasuredSignal("y", "output", "bar", "", "y"))
    log = Record(np.arange(3), np.array([[293.15, 1.0], [303.15, 2.0], [313.15, 3.0]]), ("T", "y"), ("K", "bar"))
    record = MeasuredRecord("a.txt", "chirp", "fit", log, 303.15, 10.0)
    toml = write_dataset(tmp_path / "new", Dataset("x", "-", "-", signals, (record,)), units={"T": "degC"})
    assert [line.split("\t")[1] for line in (tmp_path / "new/a.txt").read_text().split("\n")[1:4]] == [
        "20.000",
        "30.000",
        "40.000",
    ]
    back = read_dataset(toml)
    (one,) = back.logs()
    np.testing.assert_allclose(one.data.values, log.values * [1.0, 1e5])
    assert (one.offset, one.amplitude) == (pytest.approx(303.15), pytest.approx(10.0))
    assert back.signal("T").noise == pytest.approx(0.1)


def test_the_input_that_numbers_speak_of_comes_back(tmp_path: Path) -> None:
    data = dataset(VALUES, TIME)
    signals = (SIGNALS[0], SIGNALS[1], replace(SIGNALS[2], role="input"))
    record = replace(data.records[0], command="w", offset=np.pi, amplitude=2 * np.pi)
    back = written(tmp_path / "new", replace(data, signals=signals, records=(record,))).records[0]
    assert (back.command, back.offset, back.amplitude) == ("w", pytest.approx(np.pi), pytest.approx(2 * np.pi))


def test_what_was_read_is_written_the_same_again(tmp_path: Path) -> None:
    once = written(tmp_path / "a", dataset(VALUES, TIME))
    twice = written(tmp_path / "b", once)
    files = [path.relative_to(tmp_path / "a") for path in (tmp_path / "a").rglob("*.*")]
    assert len(files) == 4
    for path in files:
        assert (tmp_path / "a" / path).read_text("utf-8") == (tmp_path / "b" / path).read_text("utf-8")
    for new, old in zip(twice.logs(), once.logs(), strict=True):
        np.testing.assert_array_equal(new.data.values, old.data.values)
        np.testing.assert_array_equal(new.data.time, old.data.time)


def test_logs_look_like_those_of_a_bench(tmp_path: Path) -> None:
    written(tmp_path / "new", dataset(np.array([[1.0, 2.5e5, 0.0], [99.5, 0.0, np.pi]]), np.array([2.0, 2.004])))
    lines = (tmp_path / "new" / "sub" / "log.txt").read_text().splitlines()
    assert lines == [
        "time_s\tcmd_pct\tp A_bar\tw_rpm",
        "2.0000\t1.00000\t2.5000\t0.0000",
        "2.0040\t99.50000\t0.0000\t30.0000",
    ]


@settings(max_examples=30)
@given(st.lists(st.floats(-1e9, 1e9).filter(lambda x: x == 0 or abs(x) > 1e-9), min_size=2, max_size=6))
def test_seven_digits_of_anything(tmp_path_factory: pytest.TempPathFactory, values: list[float]) -> None:
    column = np.array(values)
    signals = (SIGNALS[0], MeasuredSignal("y", "output", "Pa", "", "y"))
    log = Record(np.arange(column.size), np.column_stack([column, column]), ("cmd", "y"), ("%", "Pa"))
    data = Dataset("x", "-", "-", signals, (MeasuredRecord("x.txt", "other", "fit", log),))
    folder = tmp_path_factory.mktemp("set") / "new"
    back = read_dataset(write_dataset(folder, data, units={"y": "bar"})).logs()[0].data
    np.testing.assert_allclose(back.values, log.values, atol=1e-6 * np.abs(column).max())


def test_every_system_must_be_able_to_hold_the_names(tmp_path: Path) -> None:
    log = Record(np.arange(2.0), np.zeros((2, 1)), ("cmd",), ("%",))
    data = Dataset("x", "-", "-", SIGNALS[:1], (MeasuredRecord("run?1.txt", "other", "fit", log),))
    with pytest.raises(BadInput, match=r"'run\?1\.txt': Windows has no file names with \?; rename it"):
        write_dataset(tmp_path / "new", data)
    assert not (tmp_path / "new").exists()


@pytest.mark.parametrize("source", ["run.parquet", "sub/run.TDMS"])
def test_no_text_under_the_name_of_another_form(tmp_path: Path, source: str) -> None:
    data = dataset(VALUES, TIME)
    cure = r"what is written is text, which \.\w+ is not; give it a name that ends in \.txt"
    with pytest.raises(BadInput, match=rf"record '{source}': {cure}"):
        write_dataset(tmp_path / "new", replace(data, records=(replace(data.records[0], source=source),)))
    assert not (tmp_path / "new").exists()


@pytest.mark.parametrize("source", ["../out.txt", "/tmp/out.txt", "C:\\out.txt", "a/../../b.txt", "dataset.toml", "."])
def test_nothing_is_written_elsewhere(tmp_path: Path, source: str) -> None:
    data = dataset(VALUES, TIME)
    with pytest.raises(BadInput, match=r"record .* (outside the data set|the name of another file)"):
        write_dataset(tmp_path / "new", replace(data, records=(replace(data.records[0], source=source),)))
    assert not (tmp_path / "new").exists()


def test_refuses_twice_the_same_file_other_units_and_old_files(tmp_path: Path) -> None:
    data = dataset(VALUES, TIME)
    with pytest.raises(BadInput, match=r"record 'w\.txt' has the name of another file"):
        write_dataset(tmp_path / "new", replace(data, records=(data.records[1],) * 2))
    with pytest.raises(
        BadInput, match=r"signal w is in rad/s and cannot be written in 'bar'; use one of rad/s, deg/s, rpm"
    ):
        write_dataset(tmp_path / "new", data, units={"w": "bar"})
    (tmp_path / "old.txt").write_text("")
    with pytest.raises(BadInput, match="holds files already"):
        write_dataset(tmp_path, data)
    with pytest.raises(BadInput, match="cannot write there"):
        write_dataset(tmp_path / "old.txt", data)


@pytest.mark.parametrize("source", ["con.txt", "step/Aux", "LPT1.a.csv", "step./a.txt", "step /a.txt", "a.txt."])
def test_names_that_windows_cannot_hold_are_refused(tmp_path: Path, source: str) -> None:
    data = dataset(VALUES, TIME)
    with pytest.raises(BadInput, match=r"record '.*': .*Windows.*; rename it"):
        write_dataset(tmp_path / "new", replace(data, records=(replace(data.records[0], source=source),)))


@pytest.mark.parametrize(
    ("one", "other"), [("step/A.txt", "step/a.txt"), ("step/a.txt", "Step/a.txt"), ("x", "Dataset.toml")]
)
def test_names_that_differ_in_capital_letters_alone_are_refused(tmp_path: Path, one: str, other: str) -> None:
    data = dataset(VALUES, TIME)
    records = tuple(replace(data.records[0], source=source) for source in (one, other))
    with pytest.raises(BadInput, match=f"record '{other}' has the name of another file, but for capital letters"):
        write_dataset(tmp_path / "new", replace(data, records=records))
