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
    ticks = "document.querySelector(\".chart[aria-label^='Error over noise of 2']\")?.layout?.xaxis.ticktext.join()"
    tab.page.wait_for_function(f"{ticks} === 'refitted,+ toy.friction,+ toy.hardening'")
    tab.page.get_by_label("name of branch A").fill("dry spindle")
    tab.page.get_by_label("name of branch A").press("Tab")
    tab.page.wait_for_function(f"{ticks} === 'refitted,+ dry spindle,+ toy.hardening'")
    assert project.settings().named == {"toy.friction": "dry spindle"}
    tab.shot("branches")
    _paper_has_all_of_it(tab)
    tab.press("show toy.friction")
    tab.see("Undo toy.friction")
    tab.page.keyboard.press("Control+z")
    tab.page.get_by_role("button", name="Undo toy.friction").wait_for(state="detached")
    gone = tab.page.get_by_role("button", name="delete toy.hardening")
    tab.press("delete toy.hardening")
    gone.wait_for(state="detached")
    tab.see("Branches")  # the other one is not shown, and can be
    tab.page.keyboard.press("Control+z")
    gone.wait_for()
    tab.page.keyboard.press("Control+y")
    gone.wait_for(state="detached")
    assert tab.errors == []
    for folder in (tmp_path / "other", project.folder):
        show(folder)  # a server that comes anew removes what was deleted
    assert [path.name.split("-")[1] for path in (project.folder / "results").glob("add-*")] == ["toy.friction"]
    assert project.settings().deleted == ()


def _paper_has_all_of_it(tab: Tab) -> None:
    """Nothing is cut where a page scrolls, and rail and buttons stay on the screen."""
    tab.page.emulate_media(media="print")
    parts = "[...document.querySelectorAll('.card, .chart, .table-scroll')]"
    assert tab.page.evaluate(f"{parts}.filter((e) => e.scrollHeight > e.clientHeight + 2).length") == 0
    last = f"Math.max(...{parts}.map((e) => e.getBoundingClientRect().bottom)) + scrollY"
    assert tab.page.evaluate(f"document.documentElement.scrollHeight - ({last})") >= -1
    assert tab.page.evaluate("getComputedStyle(document.querySelector('#page')).overflowY") == "visible"
    assert not tab.page.locator(".rail").is_visible()
    tab.print("branches")
    tab.page.emulate_media(media="screen")
