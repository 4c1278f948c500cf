"""The commands: exit codes, one-line errors, and what they leave behind. The FMU is the linear stand-in."""

import argparse
import json
import subprocess
import sys
from collections.abc import Sequence
from dataclasses import replace
from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from pysim.cli import main
from pysim.cli.command import Command
from pysim.cli.main import argument_parser, registry
from pysim.cli.options import read_parameters
from pysim.present.report import MARKER
from pysim.types import BadInput, Experiment, Record, SimulationError
from tests.pysim import comparisons as linear
from tests.pysim.cli.ran import refused

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

    monkeypatch.setattr(import_module("pysim.identify.response_comparison"), "simulate_many", simulate_many)
    monkeypatch.setattr("pysim.workflow.model.read_model", lambda path: linear.model())
    return tmp_path


def test_compare_passes_and_writes_what_was_asked_for(folder: Path) -> None:
    out, numbers = folder / "new" / "out", folder / "other" / "numbers.json"
    words = ["compare", str(folder / "bench"), "--model", "linear.fmu", "--output", str(out), "--json", str(numbers)]
    assert main(words) == 0
    assert json.loads(numbers.read_text())["parameter_sets"][0]["passes"] is True
    drawn = ("bode_O+50", "bode_O-50", "deviations")
    ours = {"report.html", *(f"{name}.{form}" for name in drawn for form in ("png", "svg"))}
    assert {path.name for path in out.iterdir()} == {*ours, MARKER}
    assert main(words) == 0
    assert {path.name for path in out.iterdir()} == {*ours, MARKER}


def test_the_reference_frequency_can_be_chosen(folder: Path) -> None:
    numbers = folder / "numbers.json"
    words = ["compare", str(folder / "bench"), "--model", "linear.fmu", "--json", str(numbers), "--reference-hz"]
    for text, value in (("1", 1.0), ("none", None)):
        assert main([*words, text]) == 0
        assert json.loads(numbers.read_text(encoding="utf-8"))["reference_hz"] == value


def test_a_failed_criterion_is_exit_1(folder: Path) -> None:
    words = ["compare", str(folder / "bench"), "--model", "linear.fmu", "--set", "k=0.02"]
    assert main([*words, "--json", str(folder / "n.json")]) == 1
    tests = json.loads((folder / "n.json").read_text())["parameter_sets"][0]["tests"]
    assert [test["passes"] for test in tests] == [False] * 4


def test_parameters_from_a_file_yield_to_set(folder: Path) -> None:
    file = folder / "parameters.toml"
    file.write_text("k = 0.02\n")
    words = ["compare", str(folder / "bench"), "--model", "linear.fmu", "--parameters", str(file)]
    assert main(words) == 1
    assert main([*words, "--set", "k=0"]) == 0


@pytest.mark.parametrize(
    ("words", "named"),
    [
        (["--set", "k"], ["--set k", "write NAME=VALUE"]),
        (["--set", "k=much"], ["--set k=much", "write NAME=VALUE"]),
        (["--set", "k=nan"], ["--set k=nan", "a finite number"]),
        (["--set", "kk=1"], ["'kk'", "near it: k"]),
        (["--set", "cmd=1"], ["cmd", "set parameters only"]),
        (["--parameters", "none.toml"], ["--parameters", "none.toml", "correct the name"]),
        (["--parameters", "{folder}/list.toml"], ["list.toml", "write NAME = VALUE"]),
        (["--parameters", "{folder}/text.toml"], ["text.toml", "write NAME = VALUE"]),
        (["--parameters", "{folder}/half.toml"], ["half.toml", "write lines NAME = VALUE"]),
        (["--reference-hz", "0.7"], ["0.7 Hz need that frequency"]),
        (["--reference-hz", "low"], ["'low' is no frequency", "write a number in Hz, or none"]),
        (["--output", "{folder}/bench/0.csv"], ["--output", "inside the data set", "choose a place outside"]),
        (["--output", "{folder}/file/x"], ["--output {folder}/file/x", "choose another folder"]),
        (["--json", "{folder}/file/x.json"], ["--json {folder}/file/x.json", "choose another file"]),
    ],
)
def test_mistakes_are_one_line_before_the_runs(
    folder: Path, words: list[str], named: list[str], monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:  # fmt: skip
    comparison = import_module("pysim.identify.response_comparison")
    monkeypatch.setattr(comparison, "simulate_many", None)  # a run would be our bug
    for name, content in {"file": "", "list.toml": "k = [1]", "text.toml": 'k = "2"', "half.toml": "k ="}.items():
        (folder / name).write_text(content)
    before = sorted(folder.rglob("*"))
    filled = [[word.replace("{folder}", str(folder)) for word in texts] for texts in (words, named)]
    refused(["compare", str(folder / "bench"), "--model", "linear.fmu", *filled[0]], capsys, *filled[1])
    assert sorted(folder.rglob("*")) == before


@pytest.mark.parametrize("encoding", ["utf-8-sig", "utf-16", "latin-1"])
def test_parameters_are_read_in_the_encodings_of_windows(folder: Path, encoding: str) -> None:
    file = folder / "parameters.toml"
    file.write_text("k = 0.02  # für Müller\n", encoding=encoding)
    assert main(["compare", str(folder / "bench"), "--model", "linear.fmu", "--parameters", str(file)]) == 1


def test_logs_beside_tables_are_not_compared_and_said_so(folder: Path) -> None:
    bench, words = folder / "bench", ["compare", str(folder / "bench"), "--model", "linear.fmu", "--json"]
    (bench / "log.csv").write_text("0,1,1\n1,2,2\n2,3,3\n")
    log = '[[records]]\nfile = "log.csv"\ncolumns = ["time", "cmd", "angle"]\nkind = "other"\n'
    (bench / "dataset.toml").write_text((bench / "dataset.toml").read_text() + log)
    assert main([*words, str(folder / "both.json")]) == 0
    text = (folder / "both.json").read_text()
    assert len(json.loads(text)["parameter_sets"][0]["tests"]) == 4
    assert "log.csv" in text


def test_missing_data_and_missing_model(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    refused(["compare", str(tmp_path / "none"), "--model", "none.fmu"], capsys, "there is no folder")
    refused(["simulate", str(tmp_path / "none.fmu")], capsys, "none.fmu")


@pytest.mark.parametrize("words", [[], ["nonsense"], ["compare"], ["compare", "x", "--modell", "y"]])
def test_unknown_words_are_exit_2(words: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    assert main(words) == 2
    assert "usage" in capsys.readouterr().err


def test_every_command_is_found_and_its_help_is_shown(capsys: pytest.CaptureFixture[str]) -> None:
    from pysim.cli import commands

    names = {path.stem.replace("_", "-") for path in Path(commands.__file__).parent.glob("[a-z]*.py")}
    assert names <= set(registry())
    for name in registry():
        with pytest.raises(SystemExit):
            argument_parser(name).parse_args([name, "--help"])
        assert name in capsys.readouterr().out


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

    commands = {"demo": Command("demo", "Fail.", run)}
    monkeypatch.setattr(import_module("pysim.cli.main"), "registry", lambda: commands)
    assert main(["demo"]) == code
    assert ("our mistake" in capsys.readouterr().err) == (code == 3)


def test_commands_start_without_heavy_imports() -> None:
    heavy = {"numpy", "numba", "matplotlib", "casadi", "rumoca"}
    script = f"import sys; from pysim.cli.main import registry; registry(); sys.exit(bool({heavy} & set(sys.modules)))"
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


def test_a_reader_that_went_away_changes_no_answer() -> None:
    script = (
        "import sys; from importlib import import_module; from pysim.cli.command import Command\n"
        "run = lambda args: print('x' * 10_000_000) or 1\n"
        "commands = import_module('pysim.cli.main')\n"
        "demo = Command('demo', 'Print.', run)\n"
        "commands.registry = lambda: {'demo': demo}\n"
        "sys.exit(commands.main(['demo']))\n"
    )
    with subprocess.Popen([sys.executable, "-c", script], stdout=subprocess.PIPE, stderr=subprocess.PIPE) as process:
        assert process.stdout is not None
        assert process.stderr is not None
        process.stdout.read(5)
        process.stdout.close()
        assert process.stderr.read() == b""
    assert process.returncode == 1  # as the command says


def test_ctrl_c_while_the_options_are_looked_up_is_a_word(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def stopped(command: str) -> argparse.ArgumentParser:
        raise KeyboardInterrupt

    monkeypatch.setattr(sys.modules["pysim.cli.main"], "argument_parser", stopped)
    assert main(["fit", "--help"]) == 2
    assert capsys.readouterr().err == "pysim: stopped\n"
