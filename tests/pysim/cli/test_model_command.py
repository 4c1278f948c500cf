"""`pysim model`: what a model holds, for people and for programs."""

import json
from pathlib import Path

import pytest

from pysim.cli import main
from tests.pysim.cli.ran import refused
from tests.toy import library


def test_a_class_tells_its_slots_and_what_they_take(tmp_path: Path) -> None:
    answer = tmp_path / "a.json"
    assert main(["model", "Toy.Mass", "--library", str(library()), "--json", str(answer)]) == 0
    found = json.loads(answer.read_text())
    assert {p["name"]: p["nominal"] for p in found["parameters"]} == {"m": 1, "d": 1, "k": 10}
    assert ["F", "input", "N", ""] in found["variables"]
    assert found["slots"] == [{"name": "force", "about": "", "sees": ["x", "v"], "gives": ["f"]}]
    assert ["force"] in found["pairs"]
    friction = found["effects"][0]
    assert (friction["law"], friction["parameters"][0]["nominal"]) == ("f = -F_c*tanh(v/0.02);", 0.3)


def test_an_fmu_of_unknown_origin_has_variables_and_no_slots(foreign: Path, tmp_path: Path) -> None:
    assert main(["model", str(foreign), "--json", str(tmp_path / "a.json")]) == 0
    found = json.loads((tmp_path / "a.json").read_text())
    assert (found["slots"], found["effects"], found["structure"]) == ([], [], None)
    assert ["F", "input", "N", ""] in found["variables"]


def test_what_is_no_model_is_said(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "a.fmu").write_bytes(b"nothing")
    refused(["model", str(tmp_path / "a.fmu")], capsys, "a.fmu")
