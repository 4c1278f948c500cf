"""`pysim data check`: what is printed, written and refused."""

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import pysim
from pysim.cli import main
from pysim.io import read_dataset, write_dataset
from pysim.io.prepare import call, typed
from pysim.nouns.data import load
from pysim.present.report import MARKER
from pysim.types import BadInput, Dataset, FrequencyResponse, MeasuredRecord, MeasuredSignal, Record, SineTest
from tests.pysim.cli.ran import refused
from tests.toy import library

SIGNALS = (
    MeasuredSignal("cmd", "input", "Pa", "command", "cmd"),
    MeasuredSignal("y", "output", "%", "angle", "model.y", noise=0.01),
)


def sine(frequency: float, amplitude: float) -> Record:
    time = np.arange(601) / 200
    swing = np.sin(2 * np.pi * frequency * time)
    noise = np.random.default_rng(1).normal(0, 0.01, time.size)
    values = np.column_stack([25e5 + amplitude * swing, 4 * swing + noise])
    return Record(time, values, ("cmd", "y"), ("Pa", "%"))


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """Sines at two points, one held out, a wave, and a table."""
    records = [
        MeasuredRecord(f"O+25_A{a:g}/{f:g}Hz.txt", "frequency-response", use, sine(f, 1e5 * a), 25e5, 1e5 * a, f)
        for a in (5.0, 10.0)
        for f, use in ((1.0, "fit"), (10.0, "fit"), (30.0, "validate"))
    ]
    records.append(MeasuredRecord("wave.txt", "stochastic", "validate", sine(3.0, 1e5)))
    table = FrequencyResponse(np.array([1.0, 2.0]), np.ones(2), np.zeros(2), SineTest(5.0, 1.0, "cmd", "y"), "t")
    records.append(MeasuredRecord("t.csv", "frequency-response-table", "fit", table, 5.0, 1.0))
    data = Dataset("bench", "by hand", "mass", SIGNALS, tuple(records))
    return write_dataset(tmp_path / "set", data, units={"cmd": "bar"}).parent


def numbers_of(tmp_path: Path, *words: str) -> dict[str, Any]:
    """What `pysim data check` finds."""
    assert main(["data", "check", *words, "--json", str(tmp_path / "check.json")]) == 0
    found: dict[str, Any] = json.loads((tmp_path / "check.json").read_text())
    return found


def test_warnings_are_no_errors(folder: Path, tmp_path: Path) -> None:
    description = folder / "dataset.toml"
    assert numbers_of(tmp_path, str(folder))["warnings"] == 0
    description.write_text(description.read_text().replace("frequency = 1.0", "frequency = 1.1", 1))
    assert numbers_of(tmp_path, str(description))["warnings"] == 1


def test_a_name_that_commands_the_terminal_is_shown_by_its_codes(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    description = folder / "dataset.toml"
    description.write_text(description.read_text().replace('"by hand"', '"by\\u001b[2J hand"'))
    assert main(["data", "check", str(folder)]) == 0
    assert r"by\x1b[2J hand" in capsys.readouterr().out


def test_numbers_report_and_pictures(folder: Path, tmp_path: Path) -> None:
    before = {path: path.stat().st_mtime_ns for path in folder.rglob("*")}
    out = tmp_path / "report"
    data = numbers_of(tmp_path, str(folder), "--output", str(out))
    assert [record["rows"] for record in data["records"]] == [601] * 7 + [2]
    assert data["records"][0]["clock"] == {
        "start_s": 0.0,
        "duration_s": 3.0,
        "rate_hz": pytest.approx(200),
        "jitter": pytest.approx(0, abs=1e-9),
        "gaps": [],
    }
    assert data["signals"][1]["noise"] == 0.01
    pictures = {f"{name}.{form}" for name in ("coverage", "sines", "logs") for form in ("png", "svg")}
    assert {path.name for path in out.iterdir()} == {"report.html", MARKER, *pictures}
    assert (out / "report.html").read_text().count("data:image/svg+xml") == 3
    assert before == {path: path.stat().st_mtime_ns for path in folder.rglob("*")}


def test_folders_without_a_description(folder: Path, tmp_path: Path) -> None:
    for name in ("dataset.toml", "t.csv"):
        (folder / name).unlink()
    found = numbers_of(tmp_path, str(folder), "--input", "cmd:bar", "--response", "y:%")
    assert len(found["records"]) == 6  # the wave's name tells no frequency


def test_empty_cells_are_reported_and_the_same_step_is_named_everywhere(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    time = np.arange(400) / 100
    force = np.cos(time)
    force[100:104] = force[300:380] = np.nan  # the second gap is too long for a straight line
    data = load({"t": time, "F [N]": force, "y [mm]": np.sin(time)}, inputs="F", outputs="y", time="t")
    (step,) = data.check().findings[0].cure
    (tmp_path / "set").mkdir()
    rows = [
        "time [s],F [N],y [mm]",
        *(f"{t},{v},{np.sin(t)}".replace("nan", "") for t, v in zip(time, force, strict=True)),
    ]
    (tmp_path / "set" / "log.csv").write_text("\n".join(rows))
    assert main(["data", "describe", str(tmp_path / "set")]) == 0
    found = numbers_of(tmp_path, str(tmp_path / "set"), "--output", str(tmp_path / "report"))
    assert (found["warnings"], found["cures"]) == (1, [typed(step)])
    assert load(tmp_path / "set").check().lines == data.check().lines
    for refused_by in (lambda: data.dataset, lambda: data.resample(50), lambda: read_dataset(tmp_path / "set")):
        with pytest.raises(BadInput) as error:
            refused_by()
        assert f"data = data.{call(step)} " in str(error.value)
    description = tmp_path / "set" / "dataset.toml"
    line = str(error.value).partition("in dataset.toml, ")[2].partition(" below [dataset]")[0]
    description.write_text(description.read_text().replace("[dataset]", f"[dataset]\n{line}"))
    cut = read_dataset(tmp_path / "set")
    assert [r.data.time.size for r in cut.records] == [r.data.time.size for r in data.after(step).dataset.records]
    assert numbers_of(tmp_path, str(tmp_path / "set"))["warnings"] == 0


def test_the_check_simulates_a_model(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    time = np.arange(400) / 100
    mass = pysim.model("Toy.Mass", library=library())
    x = mass.simulate(3.99, dt=0.01, F=np.column_stack([time, 10 * np.sin(time)])).record["x"]
    columns = {"t": time, "F [N]": 10 * np.sin(time), "x [mm]": -1e3 * x}
    load(columns, inputs="F", outputs="x", time="t").save(tmp_path / "set")
    beside = ["--model", "Toy.Mass", "--library", str(library())]
    assert numbers_of(tmp_path, str(tmp_path / "set"))["cures"] == []
    assert numbers_of(tmp_path, str(tmp_path / "set"), *beside)["cures"] == ["flip:x"]
    refused(["data", "check", str(tmp_path / "set"), *beside[2:]], capsys, "no model is named")


@pytest.mark.parametrize(
    ("words", "named"),
    [
        (["{}"], ["holds no dataset.toml", "name the folder that does", "data describe"]),
        (["{}/none"], ["there is no folder"]),
        (["{}", "--input", "cmd:bar"], ["one --input NAME:UNIT and at least one --response"]),
        (["{}", "--input", "cmd", "--response", "y:%"], ["cmd: write NAME:UNIT"]),
        (["{}", "--input", "cmd:furlong", "--response", "y:%"], ["signal cmd", "'furlong' is not known"]),
    ],
)
def test_mistakes_are_one_line(
    tmp_path: Path, words: list[str], named: list[str], capsys: pytest.CaptureFixture[str]
) -> None:
    refused(["data", "check", *(word.format(tmp_path) for word in words)], capsys, *named)


def test_logs_are_prepared_into_a_new_data_set(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    time = np.arange(400) / 100
    for k in (1, 2):
        rows = np.column_stack([time, np.sin(k * time), -2 * np.cos(k * time)])
        np.savetxt(tmp_path / f"run{k}.csv", rows, delimiter=",", header="t [s],F [kN],x", comments="")
    before = (tmp_path / "run1.csv").read_bytes()
    words = [
        "--input",
        "F",
        "--response",
        "x:mm",
        "--step",
        "flip:x",
        "--step",
        "trim:start=1",
        "--step",
        "hold_out:run2",
    ]
    into = ["--into", str(tmp_path / "ready")]
    assert main(["data", "prepare", str(tmp_path / "run*.csv"), *words, *into]) == 0
    assert "never falls and rises by 0.01" in capsys.readouterr().out
    data = read_dataset(tmp_path / "ready")
    assert [(record.source, record.use) for record in data.records] == [("run1.csv", "fit"), ("run2.csv", "test")]
    log = data.records[0].data
    assert isinstance(log, Record)
    np.testing.assert_allclose(log["x"], 2e-3 * np.cos(log.time), rtol=1e-12)
    assert log.time[0] == 1.0
    assert (tmp_path / "run1.csv").read_bytes() == before
    refused(["data", "prepare", str(tmp_path / "ready"), *into], capsys, "holds files already")
    again = ["--into", str(tmp_path / "more"), "--step", "split:0.5"]
    assert main(["data", "prepare", str(tmp_path / "ready"), *again]) == 0
    assert len(read_dataset(tmp_path / "more").records) == 3
    assert numbers_of(tmp_path, str(tmp_path / "more"))["warnings"] == 0
    refused(["data", "prepare", str(tmp_path / "ready"), "--into", "new", "--step", "flop:x"], capsys, "no step 'flop'")
    refused(["data", "prepare", str(tmp_path / "run1.csv"), "--into", "new"], capsys, "which columns are inputs")
