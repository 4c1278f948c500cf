"""`pysim data check`: what is printed, written and refused."""

import json
from pathlib import Path

import numpy as np
import pytest

from pysim.cli import main
from pysim.io import write_dataset
from pysim.types import Dataset, FrequencyResponse, MeasuredRecord, MeasuredSignal, Record, SineTest

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


def test_prints_what_it_holds(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["data", "check", str(folder)]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert lines[:4] == [
        "bench (system mass): by hand",
        "signals",
        "  cmd  input, Pa, command, no noise told, no resolution told",
        "  y    output, %, angle, model.y in the model, noise 0.01 %, no resolution told",
    ]
    text = "\n".join(lines)
    assert "frequency-response: 6\n" in text
    assert "offset 25 bar, amplitude 5 bar: 1, 10, 30 Hz; 3 s at 200 Hz; cmd, y; fit, validate" in text
    assert "wave.txt: 3 s at 200 Hz; cmd, y; validate" in text
    assert "t.csv: 2 rows; cmd, y; fit" in text
    assert lines[-1] == "0 warnings, ready to use"


def test_warnings_are_no_errors(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    description = folder / "dataset.toml"
    description.write_text(description.read_text().replace("frequency = 1.0", "frequency = 1.1", 1))
    assert main(["data", "check", str(description)]) == 0
    assert "1 warning:\n  O+25_A5/1Hz.txt: cmd swings at 1 Hz, not at 1.1 Hz" in capsys.readouterr().out


def test_numbers_report_and_pictures(folder: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    before = {path: path.stat().st_mtime_ns for path in folder.rglob("*")}
    numbers, out = tmp_path / "check.json", tmp_path / "report"
    assert main(["data", "check", str(folder), "--json", str(numbers), "--output", str(out)]) == 0
    data = json.loads(numbers.read_text())
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
    assert {path.name for path in out.iterdir()} == {"report.html", *pictures}
    page = (out / "report.html").read_text()
    assert page.count("data:image/svg+xml") == 3
    assert "O+25_A10/30Hz.txt" in page
    assert f"data check {folder} --json {numbers} --output {out}" in page
    assert before == {path: path.stat().st_mtime_ns for path in folder.rglob("*")}


def test_folders_without_a_description(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    for name in ("dataset.toml", "t.csv"):
        (folder / name).unlink()
    words = ["data", "check", str(folder), "--input", "cmd:bar", "--response", "y:%"]
    assert main(words) == 0
    out = capsys.readouterr().out
    assert "amplitude 10 bar: 1, 10, 30 Hz" in out
    assert "left out: wave.txt" in out


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["{}"], "holds no dataset.toml; name the folder that does, or have one drafted: "),
        (["{}/none"], "there is no folder"),
        (["{}", "--input", "cmd:bar"], "need one --input NAME:UNIT and at least one --response"),
        (["{}", "--input", "cmd", "--response", "y:%"], "cmd: write NAME:UNIT, as alphaCMD:%"),
        (["{}", "--input", "cmd:furlong", "--response", "y:%"], "signal cmd: unit = 'furlong' is not known"),
    ],
)
def test_what_cannot_be_read_is_refused(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], words: list[str], message: str
) -> None:
    assert main(["data", "check", *(word.format(tmp_path) for word in words)]) == 2
    assert message in capsys.readouterr().err


@pytest.mark.parametrize("option", ["--json", "--output"])
def test_nothing_is_written_into_the_data_set(folder: Path, capsys: pytest.CaptureFixture[str], option: str) -> None:
    assert main(["data", "check", str(folder), option, str(folder / "new")]) == 2
    assert "inside the data set, which is never written to" in capsys.readouterr().err
    assert not (folder / "new").exists()
