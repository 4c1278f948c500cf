"""`pysim simulate` with the undamped oscillator x'' + 4 x = u: 1 - cos 2t for u = 4, t - sin(2t) / 2 for u = 4 t."""

import json
import zipfile
from pathlib import Path

import numpy as np
import pytest

from pysim.cli import main
from pysim.io import read_record
from tests.pysim.cli.ran import refused
from tests.pysim.simulate.fixture_fmus import OSCILLATOR, build
from tests.toy import base, library

FREE = ["--set", "D=0", "--record", "x", "--record", "v"]


@pytest.fixture(scope="module")
def fmu(tmp_path_factory: pytest.TempPathFactory) -> str:
    return str(build(OSCILLATOR, 2, tmp_path_factory.mktemp("fmu")))


def edited(fmu: str, target: Path, old: str, new: str) -> str:
    """The FMU with another description."""
    with zipfile.ZipFile(fmu) as source, zipfile.ZipFile(target, "w") as archive:
        for name in source.namelist():
            content = source.read(name)
            archive.writestr(name, content.replace(old.encode(), new.encode()) if name.endswith("xml") else content)
    return str(target)


@pytest.mark.parametrize("solver", ["rodas", "rk45"])
@pytest.mark.parametrize("suffix", ["csv", "npz"])
def test_constant_input_gives_the_closed_form(fmu: str, tmp_path: Path, solver: str, suffix: str) -> None:
    out = tmp_path / "new" / f"r.{suffix}"
    words = ["--stop", "2", "--step", "0.1", "--input", "u=4", "--solver", solver, "--output", str(out)]
    assert main(["simulate", fmu, *FREE, *words]) == 0
    record = read_record(out)
    assert record.names == ("x", "v")
    np.testing.assert_allclose(record.time, np.arange(21) / 10, atol=1e-12)
    np.testing.assert_allclose(record["x"], 1 - np.cos(2 * record.time), atol=1e-4)
    assert [path.name for path in out.parent.iterdir()] == [out.name]


@pytest.mark.parametrize(
    ("stop", "step", "times"),
    [
        ("1", "0.3", [0.0, 0.3, 0.6, 0.9, 1.0]),
        ("1", "0.7", [0.0, 0.7, 1.0]),
        ("0.3", "0.1", [0.0, 0.1, 0.2, 0.3]),
        ("0.7", "0.1", [0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7]),
    ],
)
def test_rows_are_a_step_apart_up_to_the_end(
    fmu: str, tmp_path: Path, stop: str, step: str, times: list[float]
) -> None:
    out = tmp_path / "r.csv"
    assert main(["simulate", fmu, "--stop", stop, "--step", step, "--output", str(out)]) == 0
    assert read_record(out).time == pytest.approx(np.array(times), abs=1e-12)


def test_input_from_a_file_and_json(fmu: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "u.csv").write_text("time,value\n0,0\n0.7,2.8\n2,8\n")
    numbers = tmp_path / "r.json"
    words = ["--stop", "2", "--input", f"u={tmp_path / 'u.csv'}", "--json", str(numbers)]
    assert main(["simulate", fmu, *FREE, *words]) == 0
    data = json.loads(numbers.read_text())
    t = np.array(data["time"])
    assert t.size == 501
    np.testing.assert_allclose(data["signals"]["x"], t - np.sin(2 * t) / 2, atol=1e-4)
    assert (data["names"], data["units"], data["outcome"]) == (["x", "v"], ["m", "m"], "DONE")
    assert data["statistics"]["steps"] > 0
    assert len(capsys.readouterr().out.splitlines()) == 503  # note, heading, rows


def test_the_models_own_stop_time(fmu: str, tmp_path: Path) -> None:
    new = '<DefaultExperiment stopTime="0.25"/><ModelVariables>'
    path, out = edited(fmu, tmp_path / "own.fmu", "<ModelVariables>", new), tmp_path / "r.csv"
    assert main(["simulate", path, "--output", str(out)]) == 0
    assert read_record(out).time[-1] == 0.25
    assert main(["simulate", fmu, "--output", str(out)]) == 0
    assert read_record(out).time[-1] == 1.0


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["--input", "u"], "--input u: write NAME=NUMBER or NAME=FILE.csv"),
        (["--input", "u=1", "--input", "u=2"], "u is driven already"),
        (["--input", "u=nan"], "--input u=nan: nan is not finite"),
        (["--input", "u=none.csv"], "--input u=none.csv: cannot read none.csv"),
        (["--input", "u=20,5"], "--input u=20,5: write the number with a point: 20.5"),
        (["--set", "w=2,5"], "a finite number in the parameter's unit, and a point where the comma is: 2.5"),
        (["--input", "uu=1"], "has no variable 'uu'"),
        (["--input", "x=1"], "x is no input"),
        (["--stop", "1e12", "--step", "1e-3"], "1e+15 rows are more than 10,000,000; widen the step"),
        (["--stop", "-1"], "the step must be positive"),
        (["--output", "r.xlsx"], "--output r.xlsx: the suffix chooses the form; write one of .csv, .npz"),
        (["--json", "."], "--json .: this is a folder"),
    ],
)
def test_wrong_use_is_one_line(
    fmu: str,
    words: list[str],
    message: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(tmp_path)
    refused(["simulate", fmu, *words], capsys, message)
    assert list(tmp_path.iterdir()) == []


def test_an_fmu_of_another_guid_is_one_line_and_exit_2(
    fmu: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = edited(fmu, tmp_path / "other.fmu", 'guid="oscillator"', 'guid="{other}"')
    refused(["simulate", path], capsys, "other.fmu", "could not be instantiated")


def test_a_class_is_run_as_its_fmu_is(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    words = ["--input", "F=1", "--stop", "1", "--record", "x,v", "--output"]
    model = ["Toy.Mass", "--library", str(library())]
    assert main(["simulate", *model, *words, str(tmp_path / "a.csv")]) == 0
    assert main(["simulate", str(base().path), *words, str(tmp_path / "b.csv")]) == 0
    one, other = (read_record(tmp_path / name) for name in ("a.csv", "b.csv"))
    assert one.names == ("x", "v")
    np.testing.assert_array_equal(one.values, other.values)
    refused(["simulate", "Toy.Nothing", "--library", str(library())], capsys, "Toy.Nothing")
