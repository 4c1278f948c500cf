"""`pysim model`: what a model holds, for people and for programs."""

import json
from pathlib import Path

import pytest

from fmu_build import build
from pysim.cli import main
from tests.pysim.diagnose.toy import library


def test_a_class_tells_its_slots_and_what_they_take(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    answer = tmp_path / "a.json"
    assert main(["model", "Toy.Mass", "--library", str(library()), "--json", str(answer)]) == 0
    said = capsys.readouterr().out
    assert "slot force: toy.friction, toy.falling, toy.twin, toy.hardening, toy.bias" in said
    assert "  m = 1, 0.5 to 5, nominal 1 [kg]\n" in said
    found = json.loads(answer.read_text())
    assert {p["name"]: p["nominal"] for p in found["parameters"]} == {"m": 1, "d": 1, "k": 10}
    assert ["F", "input", "N", ""] in found["variables"]
    assert found["slots"] == [{"name": "force", "about": "", "sees": ["x", "v"], "gives": ["f"]}]
    friction = found["effects"][0]
    assert (friction["law"], friction["parameters"][0]["nominal"]) == ("f = -F_c*tanh(v/0.02);", 0.3)


def test_an_fmu_of_unknown_origin_has_variables_and_no_slots(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    fmu = build("Toy.Mass", tmp_path / "mass.fmu", libraries=[library()])
    assert main(["model", str(fmu)]) == 0
    assert "slot" not in capsys.readouterr().out


def test_what_is_no_model_is_said(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "a.fmu").write_bytes(b"nothing")
    assert main(["model", str(tmp_path / "a.fmu")]) == 2
    assert "a.fmu" in capsys.readouterr().err
