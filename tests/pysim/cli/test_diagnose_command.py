"""`pysim diagnose` from a data set on disk to the JSON answer, the extended class and its FMU."""

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from fmu_build import build
from pysim.cli import main
from pysim.io import read_model, write_dataset
from pysim.types import Record
from tests.foreign import made_foreign
from tests.pysim.diagnose.toy import CATALOGUE, library, measured

KEYS = {
    "verdict", "added", "ranking", "confusable", "error", "parameters", "where", "missing", "next_test", "seconds",
    "files",
}  # fmt: skip


@pytest.fixture(scope="module")
def data(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("data") / "toy"
    write_dataset(folder, measured(1, "toy.bias", F_b=-0.4))
    return folder


def test_from_a_class_to_the_extended_model(data: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    words = ["--model", "Toy.Mass", "--library", str(library()), "--effects", "toy.bias,toy.hardening"]
    answer, output = tmp_path / "answer.json", tmp_path / "out"
    assert main(["diagnose", str(data), *words, "--json", str(answer), "--output", str(output)]) == 0
    found = json.loads(answer.read_text())
    assert set(found) >= KEYS
    assert found["verdict"] == "toy.bias"
    (added,) = found["added"]
    low, high = added["intervals"]["F_b"]
    assert low < -0.4 < high
    assert added["unit"]["F_b"] == "N"
    assert [row["step"] for row in found["error"]] == ["prior", "refit", "toy.bias"]
    assert found["missing"] == []
    assert found["next_test"] is None
    pump = read_model(answer.parent / found["files"]["fmu"])
    assert pump["force.F_b"].min == -5
    assert "redeclare Toy.Bias force" in (answer.parent / found["files"]["modelica"]).read_text()
    said = capsys.readouterr()
    assert "Verdict: toy.bias" in said.out
    assert "screened 2 effects" in said.err
    report = (output / "report.html").read_text()
    assert "The model lacks an effect: constant force (toy.bias)." in report
    assert "pysim diagnose" in report
    pictures = [path for name, path in found["files"].items() if name.startswith("picture ")]
    assert len(pictures) >= 8
    assert all((answer.parent / path).is_file() for path in found["files"].values())
    assert found["conditions"]["seed"] == "0"


def test_an_fmu_whose_class_is_unknown_is_compared_only(data: Path, tmp_path: Path) -> None:
    fmu = build("Toy.Mass", tmp_path / "mass.fmu", libraries=[library()])
    answer = tmp_path / "answer.json"
    assert main(["diagnose", str(data), "--model", str(fmu), "--json", str(answer)]) == 0
    found = json.loads(answer.read_text())
    assert found["verdict"] == "unknown"
    assert any("no effect can be added" in note for note in found["notes"])
    assert found["where"][0]["error"] > 1.2


def test_an_fmu_of_another_tool_is_compared_and_refitted(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """It has no derivatives, no bounds and no source; the plant rubs, which no refit can hide."""
    write_dataset(tmp_path / "data", measured(1, "toy.friction", F_c=0.4))
    fmu = made_foreign(build("Toy.Mass", libraries=[library()]), tmp_path / "foreign.fmu")
    words = ["diagnose", str(tmp_path / "data"), "--model", str(fmu), "--json", str(tmp_path / "a.json")]
    assert main(words) == 2
    assert "no parameter min, max and nominal" in capsys.readouterr().err
    bounds = [word for text in ("m=0.5:5", "d=0:10", "k=1:100") for word in ("--bounds", text)]
    assert main([*words, "--free", "m,d,k", *bounds]) == 0
    found = json.loads((tmp_path / "a.json").read_text())
    prior, refit = found["error"]
    assert (prior["step"], refit["step"], found["verdict"], found["added"]) == ("prior", "refit", "unknown", [])
    assert 1.5 < refit["fit"] < 0.8 * prior["fit"]
    assert 1.5 < refit["validate"] < prior["validate"]
    assert all(0.5 < found["parameters"][name]["value"] < 100 for name in ("m", "d", "k"))
    assert any("inputs F and the outputs x, v of foreign.fmu, nothing inside it" in note for note in found["notes"])


def test_only_what_the_slots_take_is_a_candidate(
    data: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    words = ["--model", "Toy.Mass", "--library", str(library()), "--json", str(tmp_path / "a.json")]
    assert main(["diagnose", str(data), *words, "--effects", "toy.bias,friction.coulomb"]) == 2
    assert "friction.coulomb: no slot of Toy.Mass takes it; its slots take toy.friction, " in capsys.readouterr().err
    assert main(["diagnose", str(data), *words, "--max-effects", "1"]) == 0
    assert {row["effect"] for row in json.loads((tmp_path / "a.json").read_text())["ranking"]} <= set(CATALOGUE)
    assert f"compiling {len(CATALOGUE)} candidates" in capsys.readouterr().err


def test_an_unknown_effect_is_refused(data: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    words = ["--model", "Toy.Mass", "--library", str(library()), "--effects", "toy.magic"]
    assert main(["diagnose", str(data), *words, "--json", str(tmp_path / "a.json")]) == 2
    assert "toy.magic" in capsys.readouterr().err
    assert not (tmp_path / "a.json").exists()


TOO_SHORT = "has 20 samples to fit for 3 free parameters"
STILL = "the input F is constant in every record to fit"


@pytest.mark.parametrize(("cut", "moves", "message"), [(20, True, TOO_SHORT), (600, False, STILL)])
def test_data_that_cannot_carry_it_are_refused(
    cut: int, moves: bool, message: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    good = measured(1, "toy.bias", F_b=-0.4)
    records = []
    for record in good.records:
        log = record.data
        assert isinstance(log, Record)
        values = log.values[:cut] * (1.0 if moves else np.array([0.0, 1.0]))
        records.append(replace(record, data=replace(log, time=log.time[:cut], values=values)))
    write_dataset(tmp_path / "data", replace(good, records=tuple(records)))
    words = ["--model", "Toy.Mass", "--library", str(library()), "--output", str(tmp_path / "out")]
    assert main(["diagnose", str(tmp_path / "data"), *words]) == 2
    assert message in capsys.readouterr().err
    assert list((tmp_path / "out").iterdir()) == []


def test_what_weakens_the_answer_is_noted(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    good = measured(1, "toy.bias", F_b=-0.4)
    write_dataset(tmp_path / "data", replace(good, records=good.records[:1]))
    broken = tmp_path / "Mine.mo"
    broken.write_text(BROKEN)
    words = ["--model", "Toy.Mass", "--library", str(library()), "--library", str(broken), "--max-effects", "1"]
    words += ["--effects", "toy.bias,mine.broken"]
    assert main(["diagnose", str(tmp_path / "data"), *words]) == 0
    said = capsys.readouterr().out
    assert "Verdict: toy.bias" in said
    assert "Note: no record is held out" in said
    assert "Note: only x was logged" in said
    assert "Note: mine.broken could not be tried: " in said


BROKEN = """
model Broken "Does not compile"
  extends Toy.PartialForce;
  parameter Real c(unit="N", min=0, max=5, nominal=1) = 0;
equation
  f = -c*nowhere;
  annotation(__HydraulicTestBench(effect="mine.broken", slot="force"));
end Broken;
"""


def test_a_place_that_cannot_be_written_is_told_before_the_work(
    data: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "file").write_text("")
    words = ["--model", "Toy.Mass", "--library", str(library()), "--output", str(tmp_path / "file" / "out")]
    assert main(["diagnose", str(data), *words]) == 2
    said = capsys.readouterr()
    assert "cannot write there" in said.err
    assert "comparing" not in said.err


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


def test_a_model_without_slots_is_compared_and_told_so(
    data: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "Mine.mo").write_text(SEALED)
    words = ["--model", "Sealed", "--library", str(tmp_path / "Mine.mo"), "--json", str(tmp_path / "a.json")]
    assert main(["diagnose", str(data), *words]) == 0
    found = json.loads((tmp_path / "a.json").read_text())
    assert (found["verdict"], found["ranking"]) == ("unknown", [])
    assert any("no slot of Sealed takes an effect" in note for note in found["notes"])
    assert "Verdict: unknown" in capsys.readouterr().out


def test_a_class_that_does_not_compile_is_refused(
    data: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "Mine.mo").write_text("model Bad\n  Real x;\nequation\n  der(x) = y;\nend Bad;\n")
    words = ["--model", "Bad", "--library", str(tmp_path / "Mine.mo"), "--json", str(tmp_path / "a.json")]
    assert main(["diagnose", str(data), *words]) == 2
    said = capsys.readouterr().err
    assert said.startswith("pysim diagnose: ")
    assert len(said.splitlines()) == 1
    assert not (tmp_path / "a.json").exists()
