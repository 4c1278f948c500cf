"""The commands: exit codes, one-line errors, and what they leave behind. The FMU is the linear stand-in."""

import argparse
import json
import shlex
import subprocess
import sys
from collections.abc import Sequence
from dataclasses import replace
from importlib import import_module
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

import pysim.cli
from pysim.cli import main
from pysim.cli._answer_folder import MARKER
from pysim.cli._options import read_parameters
from pysim.cli._outputs import command_line
from pysim.types import BadInput, Experiment, Record, SimulationError
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
    """A place with a data set of the linear system in bench/; reading and running any .fmu replaced by that system."""
    bench = tmp_path / "bench"
    bench.mkdir()
    head = '[dataset]\nname = "bench"\ndescription = "Take it with care."\n'
    head += '[signals.cmd]\nrole = "input"\nunit = "%"\n[signals.angle]\nrole = "output"\nunit = "%"\n'
    records = []
    for i, response in enumerate(linear.dataset().responses()):
        rows = zip(response.frequency, 20 * np.log10(response.gain), np.degrees(response.phase), strict=True)
        (bench / f"{i}.csv").write_text("\n".join(",".join(map(str, row)) for row in rows))
        test = response.test
        records.append(RECORD.format(file=f"{i}.csv", offset=test.offset, amplitude=test.amplitude))
    (bench / "dataset.toml").write_text(head + "".join(records))

    def simulate_many(_: Any, experiments: Sequence[Experiment], **__: Any) -> list[Record]:
        return [linear.steady_output(experiment) for experiment in experiments]

    monkeypatch.setattr(import_module("pysim.diagnose.compare"), "simulate_many", simulate_many)
    monkeypatch.setattr("pysim.io.read_model", lambda path: linear.model())
    monkeypatch.setattr("pysim.plot.render", lambda figure, form: b"drawn")  # slow, and tested where it lives
    return tmp_path


def test_compare_passes_and_writes_what_was_asked_for(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    out, numbers = folder / "new" / "out", folder / "other" / "numbers.json"
    words = ["compare", str(folder / "bench"), "--model", "linear.fmu", "--output", str(out), "--json", str(numbers)]
    assert main(words) == 0
    text = capsys.readouterr().out
    assert "(4 of 4 rows)" in text
    assert "Take it with care." in text
    assert json.loads(numbers.read_text())["parameter_sets"][0]["passes"] is True
    ours = {"bode_O+50.png", "bode_O-50.png", "deviations.png", "report.html"}
    assert {path.name for path in out.iterdir()} == {*ours, MARKER}
    assert main(words) == 0
    assert {path.name for path in out.iterdir()} == {*ours, MARKER}
    assert "pysim compare " in (out / "report.html").read_text(encoding="utf-8")


def test_the_reference_frequency_can_be_chosen(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    numbers = folder / "numbers.json"
    words = ["compare", str(folder / "bench"), "--model", "linear.fmu", "--json", str(numbers), "--reference-hz"]
    for text, value in (("1", 1.0), ("none", None)):
        assert main([*words, text]) == 0
        assert json.loads(numbers.read_text(encoding="utf-8"))["reference_hz"] == value
    capsys.readouterr()
    assert main([*words, "0.7"]) == 2
    assert "relative to 0.7 Hz need that frequency" in capsys.readouterr().err
    assert main([*words, "low"]) == 2
    assert "'low' is no frequency; write a number in Hz, or none" in capsys.readouterr().err


def test_a_failed_criterion_is_exit_1(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["compare", str(folder / "bench"), "--model", "linear.fmu", "--set", "k=0.02"]) == 1
    assert "(0 of 4 rows)" in capsys.readouterr().out


def test_parameters_from_a_file_yield_to_set(folder: Path) -> None:
    file = folder / "parameters.toml"
    file.write_text("k = 0.02\n")
    words = ["compare", str(folder / "bench"), "--model", "linear.fmu", "--parameters", str(file)]
    assert main(words) == 1
    assert main([*words, "--set", "k=0"]) == 0


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["--set", "k"], "--set k: write NAME=VALUE"),
        (["--set", "k=much"], "--set k=much: write NAME=VALUE"),
        (["--set", "k=nan"], "--set k=nan: write NAME=VALUE with a finite number"),
        (["--set", "kk=1"], "linear.fmu has no variable 'kk'; near it: k"),
        (["--set", "cmd=1"], "cmd of linear.fmu has the causality input"),
        (
            ["--parameters", "none.toml"],
            "--parameters: cannot read none.toml (No such file or directory); correct the name",
        ),
        (["--output", "{folder}/bench/0.csv"], "inside the data set, which is never written to"),
        (["--output", "{folder}/file"], "cannot write there"),
    ],
)
def test_wrong_use_is_one_line_and_exit_2(
    folder: Path, words: list[str], message: str, capsys: pytest.CaptureFixture[str]
) -> None:
    (folder / "file").write_text("")
    before = sorted(folder.rglob("*"))
    words = [word.replace("{folder}", str(folder)) for word in words]
    assert main(["compare", str(folder / "bench"), "--model", "linear.fmu", *words]) == 2
    error = capsys.readouterr().err
    assert message in error
    assert error.count("\n") == 1
    assert sorted(folder.rglob("*")) == before


@pytest.mark.parametrize("encoding", ["utf-8-sig", "utf-16", "latin-1"])
def test_parameters_are_read_in_the_encodings_of_windows(folder: Path, encoding: str) -> None:
    file = folder / "parameters.toml"
    file.write_text("k = 0.02  # für Müller\n", encoding=encoding)
    assert main(["compare", str(folder / "bench"), "--model", "linear.fmu", "--parameters", str(file)]) == 1


@pytest.mark.parametrize("words", [["--free", "k"], ["--bounds", "k=-1:1"]])
def test_nothing_is_free_where_nothing_is_refitted(
    folder: Path, words: list[str], capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["compare", str(folder / "bench"), "--model", "linear.fmu", *words]) == 2
    assert f"{words[0]}: nothing is refitted without --refit" in capsys.readouterr().err


def test_logs_beside_tables_are_said_first_not_to_be_compared(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    bench = folder / "bench"
    (bench / "log.csv").write_text("0,1,1\n1,2,2\n2,3,3\n")
    log = '[[records]]\nfile = "log.csv"\ncolumns = ["time", "cmd", "angle"]\nkind = "other"\n'
    (bench / "dataset.toml").write_text((bench / "dataset.toml").read_text() + log)
    assert main(["compare", str(bench), "--model", "linear.fmu"]) == 0
    first = capsys.readouterr().out.splitlines()[0]
    assert first.startswith("Compared are tables of frequency responses alone (4), not the logs over time beside them")


@pytest.mark.parametrize("content", ["k = [1]", 'k = "2"', "k = true", "k ="])
def test_a_parameter_file_holds_numbers(folder: Path, content: str, capsys: pytest.CaptureFixture[str]) -> None:
    file = folder / "parameters.toml"
    file.write_text(content)
    assert main(["compare", str(folder / "bench"), "--model", "linear.fmu", "--parameters", str(file)]) == 2
    assert "write" in capsys.readouterr().err


def test_missing_data_and_missing_model(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["compare", str(tmp_path / "none"), "--model", "none.fmu"]) == 2
    assert "there is no folder" in capsys.readouterr().err
    assert main(["simulate", str(tmp_path / "none.fmu")]) == 2
    assert "none.fmu" in capsys.readouterr().err


@pytest.mark.parametrize("words", [[], ["nonsense"], ["compare"], ["compare", "x", "--modell", "y"]])
def test_unknown_words_are_exit_2(words: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    assert main(words) == 2
    assert "usage" in capsys.readouterr().err


def test_help_is_exit_0() -> None:
    assert main(["--help"]) == 0
    assert main(["compare", "--help"]) == 0


@pytest.mark.parametrize(
    ("error", "code"),
    [
        (BadInput("no"), 2),
        (OSError("no"), 2),
        (KeyboardInterrupt(), 2),
        (KeyError("x"), 3),
        (SimulationError("stopped at 1 s", Record(np.zeros(0), np.zeros((0, 0)), (), ())), 1),
    ],
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


def test_numbers_outside_the_bounds_are_said_and_used(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    bounded = replace(linear.model()["k"], min=-0.01, max=0.01)
    model = replace(linear.model(), variables=(*linear.model().variables[:2], bounded))
    args = argparse.Namespace(parameters=None, set=["k=0.02"])
    assert read_parameters(args, model) == {"k": 0.02}
    assert "k = 0.02 of linear.fmu is outside its bounds, -0.01 to 0.01" in capsys.readouterr().err
    args.set = ["k=0.01"]
    assert read_parameters(args, model) == {"k": 0.01}
    assert capsys.readouterr().err == ""


@pytest.mark.parametrize("option", ["--output", "--json"])
def test_a_place_that_cannot_be_written_is_known_before_the_runs(
    folder: Path, option: str, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(import_module("pysim.diagnose.compare"), "simulate_many", None)  # a run would be our bug
    (folder / "file").write_text("")
    words = ["compare", str(folder / "bench"), "--model", "linear.fmu", option, str(folder / "file" / "x.json")]
    assert main(words) == 2
    error = capsys.readouterr().err
    assert f"{option} {folder / 'file' / 'x.json'}: cannot write there" in error
    assert error.count("\n") == 1


def test_a_reader_that_went_away_ends_the_command_quietly() -> None:
    script = (
        "import sys; from types import SimpleNamespace; from pysim.cli import _main\n"
        "run = lambda args: print('x' * 10_000_000) or 0\n"
        "_main._COMMANDS = {'demo': SimpleNamespace(run=run, add_arguments=lambda p: None, __doc__='Print.')}\n"
        "sys.exit(_main.main(['demo']))\n"
    )
    with subprocess.Popen([sys.executable, "-c", script], stdout=subprocess.PIPE, stderr=subprocess.PIPE) as process:
        assert process.stdout is not None
        assert process.stderr is not None
        process.stdout.read(5)
        process.stdout.close()
        assert process.stderr.read() == b""
    assert process.returncode == 2


def test_the_line_to_redo_is_quoted_and_starts_where_it_works(monkeypatch: pytest.MonkeyPatch) -> None:
    root = Path(pysim.cli.__file__).parents[2]
    monkeypatch.setattr(sys, "prefix", "/usr")
    assert command_line(["demo", "--output", "my results"]) == "pysim demo --output 'my results'"
    assert command_line(["A.B"], program="fmu-build") == "fmu-build A.B"
    monkeypatch.setattr(sys, "prefix", str(root / ".venv"))
    monkeypatch.chdir(root)
    assert command_line(["demo"]) == "python3 run.py pysim demo"
    assert command_line(["A.B"], program="fmu-build") == "python3 run.py fmu-build A.B"
    monkeypatch.chdir(root / "tests")
    assert shlex.split(command_line(["demo"])) == ["python3", str(root / "run.py"), "pysim", "demo"]
    assert command_line(["demo"], root) == "python3 run.py pysim demo"  # typed there, wherever this process is
    monkeypatch.chdir(root)
    assert shlex.split(command_line(["demo"], root / "tests"))[1] == str(root / "run.py")


def test_the_line_to_redo_is_quoted_as_windows_wants_it(monkeypatch: pytest.MonkeyPatch) -> None:
    root = Path(pysim.cli.__file__).parents[2]
    monkeypatch.setattr(sys, "platform", "win32")
    monkeypatch.setattr(sys, "prefix", "/usr")
    assert command_line(["demo", "--output", "my results"]) == 'pysim demo --output "my results"'
    monkeypatch.setattr(sys, "prefix", str(root / ".venv"))
    monkeypatch.chdir(root)
    assert command_line(["demo"]) == "py run.py pysim demo"


@pytest.mark.parametrize(
    "said",
    [
        "seed of the random draws; the same seed gives the same answer (0)",
        "all with min, max and nominal that are not set",
        "bounds in the parameter's own unit, in place of the model's; without --free they make it free too",
        "with the model or your effects: folder with package.mo, or .mo file; repeat",
        "where both set a parameter, --set wins",
        "frequency in Hz whose gain counts as 0 dB, or none for absolute gains (0.1 where every test",
    ],
)
@pytest.mark.parametrize("command", ["diagnose"])
def test_the_help_says_what_an_option_does(command: str, said: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main([command, "--help"]) == 0
    words = " ".join(capsys.readouterr().out.split())
    assert said in words
