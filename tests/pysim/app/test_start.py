"""The page where one begins: an example is one click, projects are found again, and help opens beside."""

from pathlib import Path

import pytest

from pysim.app import recent
from tests.pysim.app.browser import Show, Shown, Tab, artefacts


@pytest.mark.slow
@pytest.mark.parametrize("title", ["drive", "heater", "pump"])
def test_an_example_is_one_click_from_the_answer(title: str, shown: Shown, show: Show, tmp_path: Path) -> None:
    tab = Tab(shown, show(tmp_path / "project"), artefacts())
    tab.shot("start")
    tab.page.get_by_role("button", name=f"{title}").first.click()
    tab.see("Where the error is")
    tab.idle()
    tab.see("third.csv")
    tab.shot(f"example-{title}")
    tab.page.get_by_role("link", name="Workbench").click()  # a second one has a project of its own
    tab.page.get_by_role("button", name="Open the heater").click()
    tab.see("Where the error is")
    assert (tmp_path / "heater-example/data/dataset.toml").is_file()
    tab.page.get_by_role("link", name="Workbench").click()
    tab.page.get_by_role("button", name="project", exact=True).first.click()
    tab.see("3 records")
    assert tab.errors == []


def test_help_opens_at_the_right_side_by_button_and_by_key(shown: Shown, show: Show, tmp_path: Path) -> None:
    tab = Tab(shown, show(tmp_path / "project"), artefacts())
    aside = tab.page.get_by_role("complementary", name="Help")
    tab.press("? Help")
    tab.see("Held-out logs show how well the answer predicts.")
    tab.go("Candidates")
    tab.see("Try adds an effect and refits the model.")
    tab.shot("help")
    assert aside.bounding_box()["x"] > 900
    for key in ("Escape", "?"):
        tab.page.keyboard.press(key)
        aside.wait_for(state="detached")
        tab.page.keyboard.press("Escape")  # where there is no help, it opens none
        tab.page.keyboard.press("?")
        aside.wait_for()
    assert tab.errors == []


def test_only_projects_that_are_still_there_are_recent(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("HTB_CACHE", str(tmp_path / "cache"))
    for name in ("a", "b", "c", "a"):
        (tmp_path / name).mkdir(exist_ok=True)
        (tmp_path / name / "project.toml").touch()
        recent.remember(tmp_path / name)
    (tmp_path / "b/project.toml").unlink()
    assert [one.name for one in recent.recent()] == ["a", "c"]
    (tmp_path / "cache/workbench/recent.json").write_text("broken")
    assert recent.recent() == []
