"""The page Add while a fit runs, in a real browser: the test writes the events of the job, step by step."""

import json
import re
from collections.abc import Iterator
from pathlib import Path

import pytest

from pysim.app.project import Project
from tests.pysim.app.browser import Show, Shown, Tab, artefacts
from tests.pysim.app.made import description
from tests.toy import TEXT

DESCRIPTION = description("a.txt")
_PATIENCE = 150e3  # ms


@pytest.fixture
def project(tmp_path: Path) -> Path:
    """With data and a model."""
    folder = tmp_path / "project"
    (folder / "data").mkdir(parents=True)
    (folder / "model").mkdir()
    (folder / "data/dataset.toml").write_text(DESCRIPTION)
    (folder / "data/a.txt").write_text("\n".join(f"{k / 10} {k % 7} {k % 5}" for k in range(50)))
    (folder / "model/Toy.mo").write_text(TEXT)
    (folder / "project.toml").write_text('model = "Toy.Mass"\nlibraries = ["model/Toy.mo"]\n')
    return folder


def tell(project: Path, error: float, *names: str) -> None:
    """What a job writes when it has tried a point."""
    trial = {"names": names, "error": error, "values": {"k": 40 + error}}
    line = {"seconds": 1.0, "stage": "refitting the model", "text": "", "step": None, "trial": trial}
    with (project / "results/diagnose/events.jsonl").open("a") as file:
        file.write(json.dumps(line) + "\n")


def draw(project: Path, error: float) -> None:
    """What a job draws beside a better point, ahead of telling of it."""
    one = {"names": ["x"], "units": ["m"], "time": [0, 1, 2], "measured": [[0, 1, 2]], "simulated": [[0, error, 2]]}
    text = json.dumps({**one, "left": [[0, 1, 0]], "rms": [1], "error": error})
    (project / "results/diagnose/curves.json").write_text(text)


def shown_points(tab: Tab, count: int) -> None:
    """Wait until the curves have so many points; a page that hangs never has."""
    drawn = "document.querySelector('.chart[aria-label^=Residual]')?.data?.flatMap((one) => one.x).length"
    tab.page.wait_for_function(f"{drawn} === {count}", timeout=_PATIENCE)


@pytest.fixture
def tab(shown: Shown, show: Show, project: Path) -> Iterator[Tab]:
    """The page while a diagnosis runs."""
    found = Tab(shown, show(project, idle=True), artefacts())
    found.go("Add")
    found.page.get_by_role("button", name="Find what is missing", disabled=False).click()
    found.see("Stop")
    yield found
    assert found.errors == []


def test_a_curve_and_its_numbers_move_while_the_search_runs(tab: Tab, project: Path) -> None:
    tab.page.wait_for_function("document.title === '… Add – Workbench'")
    tab.page.get_by_role("button", name="Stop").evaluate("(el) => (el.dataset.mark = 'the same')")
    for count, (error, names) in enumerate(((63.8, ()), (20.3, ()), (0.97, ("toy.friction",))), 1):
        if not names:
            draw(project, error)
        tell(project, error, *names)
        shown_points(tab, count)
        tab.see(f"Best so far: {' + '.join(names) or 'base model'} leaves {error:.3g} times the noise.")
        tab.page.get_by_role("cell", name=f"{40 + error:.4g}", exact=True).wait_for()
        if count == 2:
            beside = tab.page.locator(".chart[aria-label='The log with the best values'][data-ready=yes]")
            assert beside.evaluate("(el) => el.data[1].y") == [0, 20300, 2000]  # mm
    beside.wait_for(state="detached")  # the best model is another one now
    assert tab.page.locator(".table tbody").first.inner_text().startswith("toy.friction")
    assert tab.page.locator(".chart .main-svg").count() == 3  # one figure: below, above, and what hovers
    tab.page.locator(".job .time", has_text=re.compile("0:0[1-9]|0:[1-5]|[1-9]:")).wait_for()
    tab.page.locator(".job button[data-mark='the same']").wait_for()  # a button that is made anew loses presses
    tab.shot("running")


def test_a_stop_keeps_the_best_and_undo_takes_it_back(tab: Tab, project: Path) -> None:
    for error in (63.8, 20.3, 20.3):
        tell(project, error)
    tell(project, 0.97, "toy.friction")
    tab.page.reload()  # in the middle
    shown_points(tab, 4)
    tab.press("Stop")
    tab.see("was stopped; what it had found is kept")
    tab.page.reload()
    shown_points(tab, 4)
    tab.press("Keep its best values (20.3 × noise)")
    tab.page.get_by_text("was stopped").wait_for(state="detached")
    assert Project(project).values() == {"k": 60.3}
    tab.page.keyboard.press("Control+z")
    tab.see("was stopped; what it had found is kept")
    assert Project(project).values() == {}
    tab.press("Go on")
    tab.page.get_by_role("button", name="Stop").wait_for()  # what was told before is gone by then
    tell(project, 55.5)
    shown_points(tab, 1)


def test_a_result_of_another_version_says_what_to_do(shown: Shown, show: Show, project: Path) -> None:
    folder = project / "results" / "diagnose"
    folder.mkdir(parents=True)
    work = {"name": "diagnose", "title": "Find what is missing", "words": ["diagnose"], "effects": []}
    head = {"work": work, "state": "done", "begun": 1.0, "ended": 2.0, "message": ""}
    (folder / "job.json").write_text(json.dumps({**head, "fingerprint": Project.at(project).fingerprint()}))
    (folder / "answer.json").write_text('{"verdict": "none", "ledger": []}')
    tab = Tab(shown, show(project, idle=True), artefacts())
    tab.go("Add")
    tab.see("its result cannot be read here; run it again")
    assert tab.errors == []


def test_a_figure_follows_the_look_and_the_window(tab: Tab, project: Path) -> None:
    tell(project, 63.8)
    shown_points(tab, 1)
    _follows_the_look(tab)
    _follows_the_window(tab)


def _follows_the_look(tab: Tab) -> None:
    """Drawn again in the other colours, more than once."""
    colour = "getComputedStyle(document.querySelector('.chart .ytick text')).fill"
    for ink, scheme in (("rgb(231, 237, 243)", "dark"), ("rgb(23, 33, 43)", "light"), ("rgb(231, 237, 243)", "dark")):
        tab.page.emulate_media(color_scheme=scheme)
        tab.page.wait_for_function(f"{colour} === '{ink}'", timeout=_PATIENCE)
    tab.shot("running-dark")


def _follows_the_window(tab: Tab) -> None:
    """As wide as its place."""
    for width in (900, 1280):
        tab.page.set_viewport_size({"width": width, "height": 800})
        same = "(() => { const c = document.querySelector('.chart'); return "
        same += "Math.abs(c.querySelector('.main-svg').clientWidth - c.clientWidth) < 2 && c.clientWidth > 400; })()"
        tab.page.wait_for_function(same, timeout=_PATIENCE)
