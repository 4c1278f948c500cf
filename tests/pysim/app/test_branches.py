"""Two effects are tried one beside the other: both models stand side by side, and one is deleted."""

from pathlib import Path

import pytest

from pysim.app.project import Project, Settings
from pysim.io import write_dataset
from tests.pysim.app.browser import Show, Shown, Tab, artefacts
from tests.toy import TEXT, measured

PATIENCE = 100.0  # s, on a machine that does other things too


@pytest.mark.slow
def test_branches_stand_side_by_side_and_one_is_deleted(shown: Shown, show: Show, tmp_path: Path) -> None:
    project = Project.at(tmp_path / "project")
    write_dataset(project.data, measured(1, "toy.friction", F_c=0.4))
    project.models.mkdir()
    (project.models / "Toy.mo").write_text(TEXT)
    project.save(Settings(model="Toy.Mass", libraries=("model/Toy.mo",)))
    tab = Tab(shown, show(project.folder), artefacts())
    tab.see("effects that fit")
    for name in ("toy.hardening", "toy.friction"):
        tab.go("Candidates")
        tab.page.locator(".candidate", has_text=name).get_by_role("button", name="Try", disabled=False).click()
        tab.see(f"Undo {name}", timeout=PATIENCE)
        tab.press(f"Undo {name}")
        tab.page.get_by_role("button", name=f"Undo {name}").wait_for(state="detached")
    tab.see("Branches")
    names = tab.page.locator(".chart[aria-label^='Error over noise of 2']").evaluate("(el) => el.layout.xaxis.ticktext")
    assert names == ["refitted", "+ toy.friction", "+ toy.hardening"]
    tab.shot("branches")
    tab.press("show toy.friction")
    tab.see("Undo toy.friction")
    tab.page.keyboard.press("Control+z")
    tab.page.get_by_role("button", name="Undo toy.friction").wait_for(state="detached")
    tab.press("delete toy.hardening")
    tab.page.get_by_text("Branches").wait_for(state="detached")
    assert [path.name.split("-")[1] for path in (project.folder / "results").glob("add-*")] == ["toy.friction"]
    assert tab.errors == []
