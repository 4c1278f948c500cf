"""Mistakes that users make, through every command: exit code 2, one sentence that names what, where and the cure."""

import math
import re
from pathlib import Path

import pytest

from pysim.cli import main

SWINGS = [(k / 100, math.sin(2 * math.pi * k / 100)) for k in range(600)]
LOG = "\n".join(["time,u,y", *(f"{t},{u:.6f},{0.5 * u:.6f}" for t, u in SWINGS)])
TOML = """[dataset]
name = "d"
[signals.u]
role = "input"
unit = "%"
[signals.y]
role = "output"
unit = "{unit}"
noise = 0.1
[[records]]
file = "1Hz.csv"
columns = ["time", "u", "y"]
kind = "frequency-response"
offset = 0
amplitude = 1
frequency = 1
"""


@pytest.fixture(scope="module")
def place(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A data set d, logs without a description, a file that is no FMU, and a library of one class."""
    here = tmp_path_factory.mktemp("place")
    for name, unit in (("d", "%"), ("unknown-unit", "furlong")):
        (here / name).mkdir()
        (here / name / "1Hz.csv").write_text(LOG)
        (here / name / "dataset.toml").write_text(TOML.format(unit=unit))
    (here / "bare").mkdir()
    (here / "bare" / "1Hz.csv").write_text(LOG)
    (here / "gone").mkdir()
    (here / "gone" / "dataset.toml").write_text(TOML.format(unit="%"))
    (here / "half").mkdir()
    (here / "half" / "dataset.toml").write_text("[dataset\n")
    (here / "broken.fmu").write_text("no archive")
    (here / "Axis.mo").write_text(
        'model Axis\n  parameter Real m(unit="kg", min=0.1, max=9, nominal=1) = 1;\n  input Real u(unit="%");\n'
        '  output Real y(unit="%", start=0, fixed=true);\n'
        "equation\n  m*der(y) = u - y;\nend Axis;\n"
    )
    (here / "mine").mkdir()
    (here / "mine" / "notes.txt").write_text("mine")
    (here / "list.toml").write_text("m = [1, 2]\n")
    return here


FRICTION = ["friction", "d", "--speed", "y", "--supply", "u", "--inertia", "1"]
AXIS = ["--model", "Axis", "--library", "Axis.mo"]
CHIRP = ["signal", "chirp", "--sweep", "5"]
RUN = ["simulate", "Axis", "--library", "Axis.mo"]
BENCH = ["bench", "Axis", "--library", "Axis.mo", "--plan", "bench-01", "--seed", "1", "--output", "mine"]
MISTAKES = [
    # commands, options, choices
    (["diagnos", "d"], ["diagnos", "did you mean diagnose?"]),
    (["frf", "d", "--singal", "y"], ["--singal", "did you mean --signal?"]),
    (["fit", "d", *AXIS, "--objective", "nois"], ["'nois'", "did you mean noise?"]),
    (["blackbox", "d", "--poles", "2", "--weights", "uniformly"], ["'uniformly'", "did you mean uniform?"]),
    (["data", "chek", "d"], ["chek", "check"]),
    (["frf"], ["DATASET"]),
    (["frf", "d", "d"], ["d is one word too many", "quotation marks"]),
    (["frf", "d", "--signal"], ["--signal", "its value is missing"]),
    (["demo", "--quik"], ["--quik", "did you mean --quick?"]),
    (["report-bug", "now"], ["now is one word too many"]),
    (["rig", "jump"], ["there is no jump", "choose of step, heave"]),
    (["rig", "heave", "--fmi", "4"], ["--fmi", "none of 2, 3"]),
    (["signal", "sine"], ["there is no sine", "stepped-sine"]),
    (["simulate", "Axis", "--solver", "rk4"], ["'rk4'", "did you mean rk45?"]),
    (["tune", "laod"], ["'laod'", "did you mean load?"]),
    (["diagnose", "d"], ["--model"]),
    # data sets
    (["frf", "nowhere"], ["nowhere", "there is no folder"]),
    (["frf", "bare"], ["bare holds no dataset.toml", "pysim data describe bare"]),
    (["frf", "half"], ["half", "line 1"]),
    (["frf", "gone"], ["1Hz.csv"]),
    (["compare", "unknown-unit", *AXIS], ["unknown-unit/dataset.toml, line 6: unit = 'furlong'", "use one of"]),
    (["fit", "d", "nowhere", *AXIS], ["nowhere", "there is no folder"]),
    (["chirp", "bare/1Hz.csv"], ["--columns"]),
    (["chirp", "d", "--columns", "time,u,y"], ["--columns", "leave it out"]),
    (["chirp", "bare/1Hz.csv", "--columns", "time,u"], ["bare/1Hz.csv", "at least one response"]),
    (["chirp", "bare/1Hz.csv", "--columns", "time,u,y", "--units", "furlong,%"], ["'furlong'", "use one of"]),
    (["chirp", "d"], ["'d'", "give its chirps that kind"]),
    (["data", "check", "bare", "--input", "u", "--response", "y:%"], ["u: write NAME:UNIT", "as alphaCMD:%"]),
    (["data", "describe", "d"], ["d/dataset.toml is there already", "remove it first"]),
    (["data", "describe", "bare/1Hz.csv"], ["bare/1Hz.csv is no folder", "name the folder of the logs"]),
    (["multisine", "d"], ["no log of kind multisine", "--records PATTERN"]),
    (["multisine", "bare/1Hz.csv"], ["--input NAME --signal NAME"]),
    (["multisine", "d", "--period", "1", "--band", "1", "2"], ["--band", "leave one of them out"]),
    # signals, numbers
    (["frf", "d", "--signal", "z"], ["'z'"]),
    (["frf", "d", "--settle", "0,5"], ["'0,5'", "0.5"]),
    (["frf", "d", "--reference-hz", "low"], ["'low' is no frequency", "or none"]),
    ([*FRICTION, "--pulses", "0"], ["'0' is no number of pulses", "or none"]),
    ([*FRICTION[:-1], "heavy"], ["'heavy' is no number"]),
    (["blackbox", "d", "--poles", "2.5"], ["'2.5' is no whole number"]),
    (["blackbox", "d", "--poles", "2", "--test", "50"], ["'50'", "as 25/10"]),
    (["blackbox", "d", "--poles", "3", "--zeros", "1", "--orders", "suggest"], ["--zeros", "leave them out"]),
    (["multisine", "d", "--method", "robust"], ["--method robust", "--period"]),
    (["signal", "step", "--height", "1", "--length", "1"], ["name the file to write, -o FILE.csv"]),
    ([*CHIRP, "--amplitude", "1,5", "-o", "s.csv"], ["'1,5'", "1.5"]),
    ([*CHIRP, "--amplitude", "1", "-o", "s.txt"], ["s.txt", ".csv"]),
    ([*CHIRP, "--amplitude", "1", "-o", "s.csv", "--sampling", "40"], ["--sampling 40", "more than twice that"]),
    (["friction", "d", "--speed", "z", "--supply", "u", "--inertia", "1"], ["no signal 'z'", "it has u, y"]),
    ([*FRICTION[:-1], "-1"], ["--inertia", "0 or above"]),
    (["blackbox", "d", "--poles", "2", "--test", "50/10"], ["no test 50/10", "it has 0/1"]),
    (["tune", "load", "--gains", "1"], ["--gains 1", "write 2 numbers"]),
    # models
    (["compare", "d", "--model", "nowhere.fmu"], ["nowhere.fmu"]),
    (["compare", "d", "--model", "broken.fmu"], ["broken.fmu"]),
    (["simulate", "Axsi", "--library", "Axis.mo"], ["Axsi", "Axis"]),
    (["compare", "d", "--model", "Axis", "--library", "nowhere.mo"], ["nowhere.mo"]),
    (["check-fmu", "nowhere.fmu"], ["nowhere.fmu"]),
    (["check-fmu", "broken.fmu"], ["broken.fmu is not an FMU", "export it again"]),
    (["model", "Axsi", "--library", "Axis.mo"], ["class Axsi", "near it: Axis"]),
    (["model", "Axis.mo"], ["name the class", "Axis --library Axis.mo"]),
    (["model", "mine"], ["name the class", "CLASS --library mine"]),
    (["model", "Axis", "--library", "nowhere"], ["the library nowhere does not exist", "package.mo"]),
    ([*RUN, "--stop", "0"], ["--stop 0", "must be positive"]),
    ([*RUN, "--step", "1e-12"], ["rows are more than", "widen the step"]),
    ([*RUN, "--record", "z"], ["Axis has no variable 'z'", "pysim model Axis"]),
    ([*RUN, "--input", "u"], ["--input u", "NAME=NUMBER or NAME=FILE.csv"]),
    ([*RUN, "--input", "u=1,5"], ["--input u=1,5", "1.5"]),
    ([*RUN, "--input", "u=nowhere.csv"], ["nowhere.csv", "correct the name"]),
    ([*RUN, "--set", "u=1"], ["u of Axis", "set parameters only"]),
    # parameters, effects
    (["fit", "d", *AXIS, "--set", "m"], ["--set m", "write NAME=VALUE"]),
    (["fit", "d", *AXIS, "--set", "m=1,5"], ["--set m=1,5", "1.5"]),
    (["fit", "d", *AXIS, "--set", "mm=1"], ["'mm'", "near it: m"]),
    (["fit", "d", *AXIS, "--bounds", "m=2:1"], ["--bounds m=2:1", "write the lower bound first"]),
    (["fit", "d", *AXIS, "--tie", "a=two*m"], ["--tie a=two*m", "write A=B or A=2.5*B"]),
    (["fit", "d", *AXIS, "--parameters", "nowhere.toml"], ["--parameters", "nowhere.toml"]),
    (["fit", "d", *AXIS, "--parameters", "list.toml"], ["m = [1, 2] is no number", "write NAME = VALUE"]),
    (["compare", "d", *AXIS, "--free", "m"], ["--free", "--refit"]),
    (
        ["diagnose", "d", *AXIS, "--effects", "shaft.frction"],
        ["shaft.frction", "did you mean shaft.friction?"],
    ),
    (["diagnose", "d", *AXIS, "--max-effects", "-1"], ["--max-effects -1", "0 or more"]),
    (["fit", "d", *AXIS, "--profile", "q"], ["--profile q", "choose of m"]),
    (["fit", "d", *AXIS, "--start", "q=1"], ["q has a start", "add it to --free"]),
    (["compare", "d", *AXIS, "--refit", "--free", "mm"], ["Axis has no variable 'mm'", "near it: m"]),
    (["locate", "d", *AXIS, "--bounds", "m=1"], ["--bounds m=1", "write NAME=LOW:HIGH"]),
    (["add", "d", *AXIS], ["--effects"]),
    (["add", "d", *AXIS, "--effects", "shaft.friction"], ["shaft.friction", "no slot of Axis takes it"]),
    (["locate", "d", *AXIS, "--with", "shaft.frction"], ["effect shaft.frction", "did you mean shaft.friction?"]),
    # what has no data set
    (["model", "nowhere.fmu"], ["nowhere.fmu"]),
    (["rig", "step", "--dt", "1"], ["--dt 1", "less than 0.1"]),
    (["cosim", "nowhere.toml"], ["nowhere.toml"]),
    (["cosim", "list.toml", "--stop", "-1"], ["--stop: -1", "positive number"]),
    (["bench", "Axis", "--plan", "bench-01"], ["--output", "--seed"]),
    (["tune", "own", "--numerator", "1;2", "--denominator", "1,1"], ["--numerator 1;2"]),
    (BENCH, ["--output mine", "choose a new folder"]),
    ([*BENCH[:-1], "new", "--truth", "new/truth.json"], ["--truth new/truth.json", "choose a place outside"]),
    (["bench", *BENCH[1:4], "--plan", "bench-99", *BENCH[6:]], ["bench-99", "one of bench-01, thesis"]),
    (["cosim", "list.toml"], ["list.toml: the key 'm' is not known", "use system, members"]),
    (["tune", "own", "--numerator", "1"], ["--denominator", "give both"]),
    (["app", "broken.fmu"], ["broken.fmu", "choose another folder"]),
    (["validate", "table-4-44"], ["table-4-44", "did you mean table-4-4?"]),
    (["app", "--port", "99999"], ["--port 99999", "65535"]),
    (["demo", "--output", "broken.fmu/out"], ["--output broken.fmu/out", "choose another folder"]),
    # results
    (["frf", "d", "--json", "numbers.txt"], ["--json numbers.txt", ".json"]),
    (["frf", "d", "--json", "d/frf.json"], ["d/frf.json", "choose a place outside"]),
    (["frf", "d", "--output", "mine"], ["mine: notes.txt is there", "choose a new folder"]),
    (["compare", "d", *AXIS, "--output", "."], ["--output .", "choose"]),
    (["diagnose", "d", *AXIS, "--records", "r.csv"], ["--records r.csv", ".npz"]),
    (["diagnose", "d", *AXIS, "--output", "d/out"], ["--output d/out", "choose a place outside"]),
    ([*RUN, "--output", "run.txt"], ["run.txt", ".csv, .npz"]),
    (["frf", "d", "--output", "broken.fmu/out"], ["--output broken.fmu/out", "choose another folder"]),
]


@pytest.mark.parametrize(("words", "named"), MISTAKES, ids=lambda value: " ".join(value)[:60])
def test_a_mistake_is_one_sentence(
    place: Path, words: list[str], named: list[str], monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(place)
    before = {path: path.stat().st_mtime_ns for path in place.rglob("*") if path.is_file()}
    assert main(words) == 2
    told = capsys.readouterr()
    *usage, line = told.err.splitlines()
    assert all(re.match(r"usage: |  +", one) for one in usage if not one.startswith(("Building", "pysim: warning")))
    missing = [word for word in named if word not in line]
    assert not missing, f"{line!r} does not say {missing}"
    assert told.out == ""
    assert {path: path.stat().st_mtime_ns for path in place.rglob("*") if path.is_file()} == before


def test_every_command_has_its_mistakes() -> None:
    from pysim.cli.main import registry

    assert {words[0] for words, _ in MISTAKES} - {"diagnos"} == set(registry())
