"""A page that is drawn anew without end loses no click, no choice and nothing that is typed."""

import re
import tomllib
from pathlib import Path
from typing import Any

import pytest

from pysim.app.project import Project, Settings
from tests.pysim.app.browser import HOLD, Show, Shown, Tab
from tests.pysim.app.made import description, rubbing


@pytest.fixture
def project(tmp_path: Path) -> Project:
    one = Project.at(tmp_path / "project")
    one.data.mkdir()
    one.description.write_text(description("a.csv"))
    (one.data / "a.csv").write_text("\n".join(f"{k / 100},{k % 7},{k % 5}" for k in range(400)) + "\n")
    one.save(Settings())
    return one


def signal(project: Project) -> dict[str, Any]:
    found: dict[str, Any] = tomllib.loads(project.description.read_text())["signals"]["x"]
    return found


def steps(project: Project) -> list[dict[str, Any]]:
    found: list[dict[str, Any]] = tomllib.loads(project.description.read_text())["dataset"].get("preparation", [])
    return found


def test_no_choice_and_no_letter_is_lost(shown: Shown, show: Show, project: Project) -> None:
    tab = Tab(shown, show(project.folder, idle=True, restless=True))
    field, unit = tab.page.get_by_label("noise of x"), tab.page.get_by_label("unit of x")
    for k in range(1, 9):
        words = "mm" if k % 2 else "m"
        unit.select_option(words)
        field.fill("")
        field.press_sequentially(f"0.{k}", delay=30)
        tab.page.wait_for_timeout(300)  # a user who thinks
        tab.page.keyboard.type("5")
        tab.page.keyboard.press("Tab")
        tab.until(lambda words=words: signal(project)["unit"] == words)
        tab.until(lambda k=k: signal(project).get("noise") == float(f"0.{k}5"))
        assert (unit.input_value(), field.input_value()) == (words, f"0.{k}5")
    assert tab.errors == []


def test_no_press_is_lost(shown: Shown, show: Show, project: Project) -> None:
    """Also where a mouse goes down before a part is drawn anew, and up afterwards."""
    tab = Tab(shown, show(project.folder, idle=True, restless=True))
    tab.go("Prepare")
    tab.page.get_by_label("kind of step").select_option("take off the mean")
    for k in range(1, 5):
        tab.page.get_by_role("button", name="Add", exact=True).click(delay=200)
        tab.until(lambda k=k: len(steps(project)) == k)
    box = tab.page.get_by_label("step 2 is done")
    for on in (False, True, False):
        box.click(delay=200)
        tab.until(lambda on=on: bool(steps(project)[1].get("off")) is not on)
        tab.until(lambda on=on: box.is_checked() is on)
    for k in range(3, -1, -1):
        tab.page.get_by_label("remove step 1").click(delay=200)
        tab.until(lambda k=k: len(steps(project)) == k)
    assert tab.errors == []


def test_late_answers_show_nothing_that_stood_there_before(shown: Shown, show: Show, project: Project) -> None:
    tab = Tab(shown, show(project.folder, idle=True))
    field, unit = tab.page.get_by_label("noise of x"), tab.page.get_by_label("unit of x")
    field.wait_for()
    tab.page.evaluate(HOLD)
    for words, noise in (("mm", 0.125), ("m", 0.375)):
        unit.select_option(words)
        field.fill(str(noise))
        field.press("Tab")
        tab.until(
            lambda words=words, noise=noise: (signal(project)["unit"], signal(project).get("noise")) == (words, noise)
        )
        tab.until(lambda noise=noise: str(noise) in tab.page.evaluate("window.waiting()"))
    left = 1
    while left:
        left = tab.page.evaluate("window.letIn()")
        assert (unit.input_value(), field.input_value()) == ("m", "0.375")
    assert tab.errors == []


def test_a_button_that_moves_below_the_mouse_is_pressed(shown: Shown, show: Show, project: Project) -> None:
    tab = Tab(shown, show(project.folder, idle=True))
    tab.go("Prepare")
    add, logs = tab.page.get_by_role("button", name="Add", exact=True), tab.page.get_by_label("logs of the step")
    move = "(by) => { document.querySelector('.page').style.transform = `translateY(${by}px)`; }"

    def press(kind: str, *, page: float = 0.0, mouse: float = 0.0) -> None:
        """Both move by so many px while the mouse is down."""
        tab.page.get_by_label("kind of step").select_option(kind)
        tab.page.locator(".chart[data-ready=yes]").wait_for()  # until then the page moves by itself
        tab.until(lambda: logs.count() == (kind == "turn the sign"))
        tab.page.evaluate(move, 0)
        add.hover()
        place = add.bounding_box()
        tab.page.mouse.down()
        tab.page.evaluate(move, page)
        tab.page.mouse.move(place["x"] + place["width"] / 2, place["y"] + place["height"] / 2 + mouse)
        tab.page.mouse.up()

    press("take off the mean", page=-100)
    tab.until(lambda: len(steps(project)) == 1)
    tab.page.locator(".rail").get_by_text("1 step", exact=True).wait_for()
    press("turn the sign", mouse=-100)  # who moves away has thought otherwise
    press("take off the mean")
    tab.until(lambda: len(steps(project)) == 2)
    assert [step["step"] for step in steps(project)] == ["detrend", "detrend"]
    assert tab.errors == []


def test_what_was_refused_is_shown_no_more(shown: Shown, show: Show, project: Project) -> None:
    tab = Tab(shown, show(project.folder, idle=True, restless=True))
    unit = tab.page.get_by_label("unit of x")
    before = project.description.read_bytes()
    factor = tab.page.get_by_label("factor of x")
    factor.fill("0")
    factor.press("Tab")
    tab.until(lambda: factor.input_value() == "")
    assert unit.input_value() == "m"
    assert project.description.read_bytes() == before


@pytest.mark.slow
def test_a_bound_and_a_law_that_are_typed_stay(shown: Shown, show: Show, tmp_path: Path) -> None:
    project = rubbing(tmp_path / "project")
    tab = Tab(shown, show(project.folder, restless=True))
    tab.see("effects that fit")
    tab.go("Model")
    tab.page.locator(".chart[aria-label='Measured and simulated'][data-ready=yes]").wait_for()
    high = tab.page.get_by_label("max of k")
    high.fill("3")
    tab.page.wait_for_timeout(300)
    high.press_sequentially("00", delay=50)
    tab.page.get_by_label("min of k").focus()
    tab.until(lambda: project.settings().ranges == {"k": (1.0, 300.0)})
    tab.go("Locate")
    tab.page.get_by_role("button", name=re.compile("^force")).click()
    law = tab.page.get_by_label("law for force")
    law.press_sequentially("-F*tanh(", delay=20)
    tab.page.wait_for_timeout(300)
    law.press_sequentially("v/v_0)", delay=20)
    tab.page.get_by_label("usual of v_0").fill("0.02")
    tab.page.get_by_label("usual of F").fill("0.4")
    tab.page.get_by_label("unit of F").focus()
    tab.page.wait_for_timeout(300)
    assert law.input_value() == "-F*tanh(v/v_0)"
    assert [tab.page.get_by_label(f"usual of {name}").input_value() for name in ("v_0", "F")] == ["0.02", "0.4"]
    assert tab.errors == []
