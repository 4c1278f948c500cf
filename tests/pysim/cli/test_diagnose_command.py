"""`pysim diagnose` from a data set on disk to the JSON answer, the extended class and its FMU."""

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from pysim.cli import main
from pysim.cli.steps import read_parts
from pysim.io import read_model, write_dataset
from pysim.present.report import MARKER
from pysim.types import NoteCode, Record
from pysim.workflow import SessionParts
from tests.pysim.cli.ran import Ran, parsed, refused
from tests.pysim.types.test_answer import KEYS
from tests.toy import CATALOGUE, measured


def test_the_answer_names_the_effect_and_its_size(diagnosed: Ran) -> None:
    found = diagnosed.answer
    assert diagnosed.code == 0
    assert set(found) >= KEYS
    assert (found["verdict"], found["missing"], found["next_test"]) == ("toy.friction", [], None)
    (added,) = found["added"]
    low, high = added["intervals"]["F_c"]
    assert abs(0.4 - (low + high) / 2) < 3.3 / 1.96 * (high - low) / 2  # 99.9 percent: it is one seed
    assert added["unit"]["F_c"] == "N"
    prior, refit, friction = found["error"]
    assert [row["step"] for row in found["error"]] == ["prior", "refit", "toy.friction"]
    assert prior["fit"] > refit["fit"] > 1.5
    assert friction["fit"] == pytest.approx(1.0, abs=0.1)
    assert friction["validate"] < 1.1 < refit["validate"]


def test_the_folder_holds_the_extended_model_and_every_file_of_the_answer(diagnosed: Ran) -> None:
    home = diagnosed.output.parent
    files = {name: home / path for name, path in diagnosed.answer["files"].items()}
    assert all(path.is_file() for path in files.values())
    assert {f"picture {name}" for name in ("error", "record_1", "map", "candidates", "parameters")} <= set(files)
    assert "redeclare Toy.Rubbing force" in files["modelica"].read_text()
    model, (added,) = read_model(files["fmu"]), diagnosed.answer["added"]
    assert model[f"{added['place']}.F_c"].start == added["parameters"]["F_c"]
    assert (model["m"].min, model["m"].max) == (0.5, 5)
    own = {path.name for path in files.values()} | {path.with_suffix(".svg").name for path in files.values()}
    assert {path.name for path in diagnosed.output.iterdir()} <= own | {MARKER}


def test_the_answer_says_how_to_have_it_again(diagnosed: Ran) -> None:
    conditions = diagnosed.answer["conditions"]
    assert " ".join(diagnosed.words) in conditions["command"]
    assert conditions["model"] == "Toy.Mass"  # the identifier of its FMU is called one, and stands apart


BROKEN = """
model Broken "Does not compile"
  extends Toy.PartialForce;
  parameter Real c(unit="N", min=0, max=5, nominal=1) = 0;
equation
  f = -c*nowhere;
  annotation(__HydraulicTestBench(effect="mine.broken", slot="force"));
end Broken;
"""


def test_ranking_tells_what_each_gains_and_decides_nothing(rubbing: Path, toy: list[str], tmp_path: Path) -> None:
    """An effect that does not compile is noted and left out."""
    (tmp_path / "Mine.mo").write_text(BROKEN)
    words = ["diagnose", str(rubbing), *toy, "--library", str(tmp_path / "Mine.mo"), "--max-effects", "0"]
    words += ["--effects", "toy.friction,toy.bias,mine.broken", "--json", str(tmp_path / "a.json")]
    assert main(words) == 0
    found = json.loads((tmp_path / "a.json").read_text())
    effects = [row["effect"] for row in found["ranking"] if not row["effect"].startswith("sensor.")]
    assert effects == ["toy.friction", "toy.bias"]
    assert found["ranking"][0]["explained"] > 0.9
    assert found["added"] == []
    assert [row["step"] for row in found["error"]] == ["prior", "refit"]
    assert any("mine.broken" in note["text"] for note in found["notes"])


@pytest.mark.slow
def test_an_unknown_comes_with_its_shape(rubbing: Path, toy: list[str], tmp_path: Path) -> None:
    words = ["diagnose", str(rubbing), *toy, "--effects", "toy.bias", "--json", str(tmp_path / "a.json")]
    assert main(words) == 0
    found = json.loads((tmp_path / "a.json").read_text())
    assert found["verdict"] == "unknown"
    assert found["missing"][0]["depends_on"] == "force.v"


def test_an_fmu_of_another_tool_is_compared_and_refitted(rubbing: Path, foreign: Path, tmp_path: Path) -> None:
    """It has no derivatives, no bounds and no source; the plant rubs, which no refit can hide."""
    words = ["diagnose", str(rubbing), "--model", str(foreign), "--json", str(tmp_path / "a.json")]
    bounds = [word for text in ("m=0.5:5", "d=0:10", "k=1:100") for word in ("--bounds", text)]
    assert main([*words, "--free", "m,d,k", *bounds]) == 0
    found = json.loads((tmp_path / "a.json").read_text())
    prior, refit = found["error"]
    assert (prior["step"], refit["step"], found["verdict"], found["added"]) == ("prior", "refit", "unknown", [])
    assert 1.5 < refit["fit"] < 0.8 * prior["fit"]
    assert 1.5 < refit["validate"] < prior["validate"]
    assert all(0.5 < found["parameters"][name]["value"] < 100 for name in ("m", "d", "k"))


def given(*words: str) -> SessionParts:
    """What a command line of `diagnose` names."""
    return read_parts(parsed(["diagnose", *words]))


def test_all_that_the_slots_take_is_a_candidate_and_nothing_else(rubbing: Path, toy: list[str]) -> None:
    assert {effect.name for effect in given(str(rubbing), *toy).catalogue} == set(CATALOGUE)


SEALED = """
model Sealed "The toy's mass, nothing in it replaceable"
  parameter Real m(unit="kg", min=0.5, max=5, nominal=1) = 1;
  parameter Real d(unit="N.s/m", min=0, max=10, nominal=1) = 0.8;
  parameter Real k(unit="N/m", min=1, max=100, nominal=10) = 20;
  input Real F(unit="N", start=0);
  output Real x(unit="m", start=0, fixed=true);
  output Real v(unit="m/s", start=0, fixed=true);
equation
  der(x) = v;
  m*der(v) = F - d*v - k*x;
end Sealed;
"""


def test_a_model_without_slots_has_no_candidates(rubbing: Path, tmp_path: Path) -> None:
    (tmp_path / "Mine.mo").write_text(SEALED)
    found = given(str(rubbing), "--model", "Sealed", "--library", str(tmp_path / "Mine.mo"))
    assert found.catalogue == ()
    assert [note.code for note in found.notes] == [NoteCode.NO_EFFECT_FITS]


@pytest.mark.parametrize(
    ("words", "named"),
    [
        ([], ["--model"]),
        (["--model", "Toy.Nothing"], ["Toy.Nothing"]),
        (["--model", "none.fmu"], ["none.fmu"]),
        (["--effects", "toy.magic"], ["effect toy.magic", "it has "]),
        (["--effects", "friction.coulomb"], ["effect friction.coulomb", "its slots take toy.friction"]),
        (["--max-effects", "-1"], ["--max-effects -1", "0 or more"]),
        (["--free", "mm"], ["mm", "near it: m"]),
        (["--bounds", "m=2:1"], ["--bounds m=2:1", "write the lower bound first"]),
        (["--bounds", "m=2"], ["--bounds m=2", "write NAME=LOW:HIGH"]),
        (["--output", "{here}/file/out"], ["--output", "choose another folder"]),
        (["--output", "{here}"], ["--output", "choose a new folder"]),
        (["--parameters", "{here}/own/p.toml", "--output", "{here}/own"], ["p.toml is read", "choose another folder"]),
        (["--events", "s.txt"], ["--events s.txt", "write one of .jsonl"]),
    ],
)
def test_mistakes_are_one_line_before_the_work(
    rubbing: Path, toy: list[str], words: list[str], named: list[str], tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
) -> None:  # fmt: skip
    (tmp_path / "file").write_text("")
    (tmp_path / "own").mkdir()
    (tmp_path / "own" / "p.toml").write_text("m = 1.1\n")
    before = sorted(tmp_path.rglob("*"))
    model = toy if words and "--model" not in words else []
    filled = [word.format(here=tmp_path) for word in words]
    refused(["diagnose", str(rubbing), *model, *filled, "--json", str(tmp_path / "a.json")], capsys, *named)
    assert sorted(tmp_path.rglob("*")) == before


@pytest.mark.parametrize(
    ("cut", "moves", "named"),
    [(20, True, ["20 samples", "3 free parameters"]), (600, False, ["the input F is constant in every record to fit"])],
)
def test_data_that_cannot_carry_it_are_refused(
    cut: int, moves: bool, named: list[str], toy: list[str], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    good = measured(1, "toy.friction", F_c=0.4)
    records = []
    for record in good.records:
        log = record.data
        assert isinstance(log, Record)
        values = log.values[:cut] * (1.0 if moves else np.array([0.0, 1.0]))
        records.append(replace(record, data=replace(log, time=log.time[:cut], values=values)))
    write_dataset(tmp_path / "data", replace(good, records=tuple(records)))
    refused(["diagnose", str(tmp_path / "data"), *toy, "--output", str(tmp_path / "out")], capsys, *named)
    assert not (tmp_path / "out").exists()


def test_a_class_that_does_not_compile_is_refused(
    rubbing: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "Mine.mo").write_text("model Bad\n  Real x;\nequation\n  der(x) = y;\nend Bad;\n")
    words = ["--model", "Bad", "--library", str(tmp_path / "Mine.mo"), "--json", str(tmp_path / "a.json")]
    refused(["diagnose", str(rubbing), *words], capsys, "pysim diagnose: ")
    assert not (tmp_path / "a.json").exists()
