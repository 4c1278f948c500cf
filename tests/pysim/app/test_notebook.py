"""The notebook does in Python what was done on the page."""

import json
from pathlib import Path

import pytest

from pysim.app.notebook import notebook
from pysim.app.project import Project, Settings
from tests.pysim.app.made import rubbing


@pytest.fixture
def project(tmp_path: Path) -> Project:
    return rubbing(tmp_path / "project")


def code(project: Project) -> list[str]:
    found = json.loads(notebook(project))
    assert (found["nbformat"], [cell["cell_type"] for cell in found["cells"][:2]]) == (4, ["markdown", "code"])
    return [cell["source"] for cell in found["cells"] if cell["cell_type"] == "code"]


def test_every_choice_has_its_line(project: Project) -> None:
    project.save(Settings(model="Toy.Mass", libraries=("model/Toy.mo",)))
    assert "model.set" not in "".join(code(project))
    assert code(project)[-2:] == ["why = pysim.diagnose(model, data)\nwhy", 'fit.model.export("taken")']
    project.set_values({"k": 50.0})
    project.change(free=("k", "d"), bounds=("d=0.1:9.0",), added=("toy.friction",))
    lines = "\n".join(code(project)).splitlines()
    assert "model = pysim.model('Toy.Mass', library=['model/Toy.mo'])" in lines
    assert "model = model.set(**{'k': 50.0})" in lines
    assert "model = model.free('k', **{'d': (0.1, 9.0)})" in lines
    assert "fit = pysim.fit(model.with_effects('toy.friction'), data)" in lines


def test_it_runs(project: Project, monkeypatch: pytest.MonkeyPatch) -> None:
    project.save(Settings(model="Toy.Mass", libraries=("model/Toy.mo",)))
    project.change(bounds=("d=0.1:9.0",), added=("toy.friction",))
    monkeypatch.chdir(project.folder)
    space: dict[str, object] = {}
    for one in code(project):
        exec(one, space)
    fit = space["fit"]
    assert abs(fit.values["force.F_c"] - 0.4) < 0.02  # type: ignore[attr-defined]
    assert [*(project.folder / "taken").glob("*.fmu")]
