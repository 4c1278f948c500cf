"""Logs are made ready on the page: stretches, steps in a list, cures as buttons; all of it in dataset.toml."""

import tomllib
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from pysim.app.description import moved, put_steps
from pysim.app.project import Project, Settings
from pysim.app.records import measured_overlay, raw_of
from pysim.io import read_dataset, read_described, write_dataset
from pysim.io.prepare import prepared
from pysim.types import Record
from tests.pysim.app.browser import Show, Shown, Tab, artefacts
from tests.pysim.app.made import description
from tests.toy import TEXT, measured

DESCRIPTION = description("a.csv")


@pytest.fixture
def project(tmp_path: Path) -> Project:
    """A log with an empty cell of the force and an outlier."""
    one = Project.at(tmp_path / "project")
    one.data.mkdir()
    (one.data / "dataset.toml").write_text(DESCRIPTION)
    t = np.arange(400) / 100
    x = np.sin(2 * np.pi * t) + 0.01 * np.random.default_rng(1).standard_normal(t.size)
    x[200] = 9.0
    rows = [f"{a:.2f},{b:.4f},{c:.5f}" for a, b, c in zip(t, np.cos(2 * np.pi * t), x, strict=True)]
    rows[100] = f"{t[100]:.2f},,{x[100]:.5f}"
    (one.data / "a.csv").write_text("\n".join(rows) + "\n")
    one.save(Settings())
    return one


def press(tab: Tab, project: Project, keys: str) -> None:
    """Keys that change the data set's description, and wait until it has changed."""
    before = project.description.read_bytes()
    tab.page.keyboard.press(keys)
    tab.until(lambda: project.description.read_bytes() != before)


def chain(project: Project) -> list[dict[str, Any]]:
    found: list[dict[str, Any]] = tomllib.loads(project.description.read_text())["dataset"].get("preparation", [])
    return found


def test_a_step_is_moved_and_removed() -> None:
    steps = [{"step": word} for word in "abc"]
    assert [one["step"] for one in moved(steps, 0, 1)] == ["b", "a", "c"]
    assert [one["step"] for one in moved(steps, 2, -1)] == ["a", "c", "b"]
    assert [one["step"] for one in moved(steps, 1, 0)] == ["a", "c"]
    content: dict[str, Any] = {"dataset": {"name": "toy"}}
    put_steps(content, steps[:1])
    assert content["dataset"]["preparation"] == [{"step": "a"}]
    put_steps(content, [])
    assert content == {"dataset": {"name": "toy"}}


def test_what_was_logged_lies_behind_what_steps_make_of_it(project: Project) -> None:
    found = read_described(project.data, partly=True)
    steps = [*found.steps]
    given = (
        '{step = "fill_gaps", longest = 0.1}, {step = "exclude", log = "a", start = 1.0, stop = 2.0}, '
        '{step = "flip", signals = ["x"], off = true}'
    )
    project.description.write_text(DESCRIPTION.replace('"toy"', f'"toy"\npreparation = [{given}]'))
    found = read_described(project.data, partly=True)
    assert len(found.steps) == len(steps) + 2  # one is off
    first, second = prepared(found.raw, found.steps).logs()
    for part in (first, second):
        raw = raw_of(found.raw, part)
        assert isinstance(raw, Record)
        lines = [line for line in measured_overlay(part, raw).lines if line.panel == 2]
        assert [line.key for line in lines] == ["raw", "measured"]
        assert lines[0].time.size == 400 > lines[1].time.size
        assert measured_overlay(part, raw).span == (0.0, 3.99)


def test_a_log_is_made_ready_by_clicks_and_every_click_can_be_taken_back(
    shown: Shown, show: Show, project: Project
) -> None:
    tab = Tab(shown, show(project.folder, idle=True), artefacts())
    tab.go("Prepare")
    tab.see("F lacks 1 sample, the first at 1 s")
    tab.shot("prepare-before")
    tab.page.get_by_role("button", name="fill_gaps").first.click()
    tab.see("1. fill_gaps(")
    assert read_dataset(project.data).logs()
    tab.page.get_by_role("button", name="drop_outliers").first.click()
    tab.see("2. drop_outliers(")
    tab.see("✓ ready")
    plot = tab.page.locator(".chart[aria-label^='a.csv as it was logged'][data-ready=yes] .nsewdrag").first
    plot.scroll_into_view_if_needed()
    box = plot.bounding_box()
    assert box is not None
    y = box["y"] + box["height"] / 2
    tab.page.mouse.move(box["x"] + box["width"] / 4, y)
    tab.page.mouse.down()
    tab.page.mouse.move(box["x"] + box["width"] / 2, y, steps=5)
    tab.page.mouse.up()
    tab.page.wait_for_function("document.querySelector('.page').innerText.match(/[0-9.]+ to [0-9.]+ s/)")
    tab.press("Keep this stretch")
    tab.see("3. trim(")
    assert 0.9 < chain(project)[2]["start"] < 1.1 < 1.9 < chain(project)[2]["stop"] < 2.1
    tab.page.get_by_label("kind of step").select_option("low pass")
    tab.page.get_by_label("signal of the step").select_option("F")  # the other lacks the sample that was an outlier
    tab.page.get_by_label("number of the step").fill("20")
    tab.page.get_by_label("number of the step").press("Tab")
    tab.page.get_by_role("button", name="Add", exact=True).click()
    tab.see("4. lowpass(20")
    tab.shot("prepare")
    tab.page.get_by_label("step 3 is done").uncheck()
    tab.page.wait_for_function("document.querySelectorAll('.step .dim').length === 1")
    assert read_dataset(project.data).logs()[0].data.time.size == 400  # type: ignore[union-attr]
    tab.page.get_by_label("move step 4 up").click()
    tab.see("3. lowpass(20")
    tab.page.get_by_label("remove step 3").click()
    tab.see("3. trim(")
    assert [one["step"] for one in chain(project)] == ["fill_gaps", "drop_outliers", "trim"]
    before = project.description.read_bytes()
    for _ in range(3):
        press(tab, project, "Control+z")
    assert [one["step"] for one in chain(project)] == ["fill_gaps", "drop_outliers", "trim", "lowpass"]
    for _ in range(3):
        press(tab, project, "Control+y")
    assert project.description.read_bytes() == before
    assert tab.errors == []


@pytest.mark.slow
def test_a_turned_sign_is_found_with_the_model_and_turned_by_a_click(
    shown: Shown, show: Show, project: Project
) -> None:
    plant = measured(1)
    write_dataset(project.folder / "turned", plant)
    project.replace_data(project.folder / "turned")
    put = project.description.read_text().replace("[signals.x]", "[signals.x]\nfactor = -1.0")
    project.description.write_text(put)
    project.models.mkdir()
    (project.models / "Toy.mo").write_text(TEXT)
    project.save(Settings(model="Toy.Mass", libraries=("model/Toy.mo",)))
    tab = Tab(shown, show(project.folder), artefacts())
    tab.see("effects that fit")
    tab.go("Prepare")
    tab.see("✓ ready")
    tab.press("Check signs and units with the model")
    tab.see("x moves against the model's answer")
    tab.shot("prepare-sign")
    tab.page.get_by_role("button", name='flip("x")').first.click()
    tab.see('1. flip("x")')
    tab.press("Check signs and units with the model")
    tab.page.get_by_text("moves against").wait_for(state="detached")
    told = tab.page.locator("main").get_by_text("Checked: signs and units fit the model")  # it stays in the page
    told.wait_for()
    assert (
        np.sign(read_dataset(project.data).logs()[0].data["x"][5:50])
        == pytest.approx(  # type: ignore[index]
            np.sign(plant.logs()[0].data["x"][5:50])  # type: ignore[index]
        )
    )
    tab.page.get_by_role("button", name="remove step 1").click()
    told.wait_for(state="detached")  # it was of other data
    tab.page.get_by_label("signal of the step").select_option("x")
    tab.page.get_by_label("logs of the step").select_option("b.txt")
    tab.page.get_by_role("button", name="Add", exact=True).click()
    tab.see('1. flip("x", logs=["b')
    assert [(one["signals"], one["logs"]) for one in chain(project)] == [(["x"], ["b.txt"])]
    assert tab.errors == []
