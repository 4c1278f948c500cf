"""The commands: exit codes, one-line errors, and what they leave behind. The FMU is the linear stand-in."""

import json
import subprocess
import sys
from collections.abc import Sequence
from importlib import import_module
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from pysim.cli import main
from pysim.types import BadInput, Experiment, Record
from tests.pysim import comparisons as linear

RECORD = """
[[records]]
file = "{file}"
columns = ["frequency_hz", "magnitude_db", "phase_deg"]
kind = "frequency-response-table"
offset = {offset}
amplitude = {amplitude}
"""


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A data set of the linear system, and reading and running any .fmu replaced by it."""
    head = '[dataset]\nname = "bench"\ndescription = "Take it with care."\n'
    head += '[signals.cmd]\nrole = "input"\nunit = "%"\n[signals.angle]\nrole = "output"\nunit = "%"\n'
    records = []
    for i, response in enumerate(linear.dataset().responses()):
        rows = zip(response.frequency, 20 * np.log10(response.gain), np.degrees(response.phase), strict=True)
        (tmp_path / f"{i}.csv").write_text("\n".join(",".join(map(str, row)) for row in rows))
        test = response.test
        records.append(RECORD.format(file=f"{i}.csv", offset=test.offset, amplitude=test.amplitude))
    (tmp_path / "dataset.toml").write_text(head + "".join(records))

    def simulate_many(_: Any, experiments: Sequence[Experiment], **__: Any) -> list[Record]:
        return [linear.steady_output(experiment) for experiment in experiments]

    monkeypatch.setattr(import_module("pysim.diagnose.compare"), "simulate_many", simulate_many)
    monkeypatch.setattr("pysim.io.read_model", lambda path: linear.model())
    monkeypatch.setattr("pysim.plot.render", lambda figure, form: b"drawn")  # slow, and tested where it lives
    return tmp_path


def test_compare_passes_and_writes_what_was_asked_for(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    out, numbers = folder / "new" / "out", folder / "other" / "numbers.json"
    words = ["compare", "linear.fmu", "--data", str(folder), "--output", str(out), "--json", str(numbers)]
    assert main(words) == 0
    text = capsys.readouterr().out
    assert "4 of 4 tests pass" in text
    assert "Take it with care." in text
    assert json.loads(numbers.read_text())["parameter_sets"][0]["passes"] is True
    assert sorted(path.name for path in out.iterdir()) == [
        "bode_O+50.png",
        "bode_O-50.png",
        "deviations.png",
        "report.html",
    ]
    assert "pysim compare linear.fmu" in (out / "report.html").read_text(encoding="utf-8")


def test_a_failed_criterion_is_exit_1(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["compare", "linear.fmu", "--data", str(folder), "--set", "k=0.02"]) == 1
    assert "0 of 4 tests pass" in capsys.readouterr().out


def test_parameters_from_a_file_yield_to_set(folder: Path) -> None:
    file = folder / "parameters.toml"
    file.write_text("k = 0.02\n")
    words = ["compare", "linear.fmu", "--data", str(folder), "--parameters", str(file)]
    assert main(words) == 1
    assert main([*words, "--set", "k=0"]) == 0


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["--set", "k"], "--set k: write NAME=VALUE"),
        (["--set", "k=much"], "--set k=much: write NAME=VALUE"),
        (["--set", "kk=1"], "linear.fmu has no variable 'kk'; near it: k"),
        (["--set", "cmd=1"], "cmd of linear.fmu has the causality input"),
        (["--parameters", "none.toml"], "--parameters none.toml: cannot be read"),
        (["--output", "{folder}/dataset.toml"], "cannot write there"),
    ],
)
def test_wrong_use_is_one_line_and_exit_2(
    folder: Path, words: list[str], message: str, capsys: pytest.CaptureFixture[str]
) -> None:
    before = sorted(folder.rglob("*"))
    words = [word.replace("{folder}", str(folder)) for word in words]
    assert main(["compare", "linear.fmu", "--data", str(folder), *words]) == 2
    error = capsys.readouterr().err
    assert message in error
    assert error.count("\n") == 1
    assert sorted(folder.rglob("*")) == before


@pytest.mark.parametrize("content", ["k = [1]", 'k = "2"', "k = true", "k ="])
def test_a_parameter_file_holds_numbers(folder: Path, content: str, capsys: pytest.CaptureFixture[str]) -> None:
    file = folder / "parameters.toml"
    file.write_text(content)
    assert main(["compare", "linear.fmu", "--data", str(folder), "--parameters", str(file)]) == 2
    assert "write" in capsys.readouterr().err


def test_missing_data_and_missing_model(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["compare", "none.fmu", "--data", str(tmp_path / "none")]) == 2
    assert "dataset.toml" in capsys.readouterr().err
    assert main(["simulate", str(tmp_path / "none.fmu")]) == 2
    assert "none.fmu" in capsys.readouterr().err


@pytest.mark.parametrize("words", [[], ["nonsense"], ["compare"], ["compare", "x.fmu", "--dta", "y"]])
def test_unknown_words_are_exit_2(words: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    assert main(words) == 2
    assert "usage" in capsys.readouterr().err


def test_help_is_exit_0() -> None:
    assert main(["--help"]) == 0
    assert main(["compare", "--help"]) == 0


@pytest.mark.parametrize(
    ("error", "code"), [(BadInput("no"), 2), (OSError("no"), 2), (KeyboardInterrupt(), 2), (KeyError("x"), 3)]
)
def test_what_goes_wrong_becomes_an_exit_code(
    error: BaseException, code: int, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def run(_: Any) -> int:
        raise error

    commands = {"demo": SimpleNamespace(run=run, add_arguments=lambda parser: None, __doc__="Fail.")}
    monkeypatch.setattr(import_module("pysim.cli._main"), "_COMMANDS", commands)
    assert main(["demo"]) == code
    assert ("our mistake" in capsys.readouterr().err) == (code == 3)


def test_commands_start_without_heavy_imports() -> None:
    heavy = {"numpy", "numba", "matplotlib", "casadi", "rumoca"}
    script = f"import sys, pysim.cli; sys.exit(str({heavy} & set(sys.modules)) if {heavy} & set(sys.modules) else 0)"
    assert subprocess.run([sys.executable, "-c", script], check=False).returncode == 0


def test_simulate_writes_the_outputs(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    def simulate(_: Any, experiment: Experiment, **__: Any) -> Record:
        return Record(experiment.times, experiment.times[:, None] * 2, experiment.record, ("%",))

    monkeypatch.setattr("pysim.io.read_model", lambda path: linear.model())
    monkeypatch.setattr("pysim.simulate.simulate", simulate)
    file = tmp_path / "out.csv"
    assert main(["simulate", "linear.fmu", "--stop", "0.3", "--step", "0.1", "--output", str(file)]) == 0
    assert file.read_text().startswith("time [s],angle [%]\n")
    rows = np.loadtxt(file, delimiter=",", skiprows=1)
    np.testing.assert_allclose(rows, [[0, 0], [0.1, 0.2], [0.2, 0.4], [0.3, 0.6]], atol=1e-12)
    assert main(["simulate", "linear.fmu", "--stop", "-1"]) == 2
