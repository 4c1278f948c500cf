"""The page of parameters: every curve follows a slider, the last move wins, and where it is let go is kept."""

import json
from pathlib import Path

import numpy as np
import pytest

from pysim import present
from pysim.app.followed import Followed
from pysim.app.jobs import ANSWER, RECORDS, Job, _write_job, works
from pysim.app.project import Project
from pysim.io import in_model_units, write_stages
from pysim.types import BadInput
from pysim.workflow import data_of, model_of
from tests.pysim.app.browser import HOLD, Show, Shown, Tab, artefacts
from tests.pysim.app.made import rubbing
from tests.pysim.diagnosis_answer import found_offset

MOVES = 20


@pytest.fixture
def project(tmp_path: Path) -> Project:
    return rubbing(tmp_path / "project")


def test_curves_are_those_of_the_model_with_these_values(project: Project) -> None:
    model = model_of("Toy.Mass", [project.models / "Toy.mo"])
    data = in_model_units(data_of(project.data), model)
    followed = Followed.of(model, data, 0, {})
    soft, stiff = (followed.curves({"k": k}) for k in (20.0, 80.0))
    assert soft["names"] == ("x",)
    assert np.array_equal(soft["measured"], stiff["measured"])
    assert soft["left"] == pytest.approx((soft["measured"] - soft["simulated"]) / 0.001, rel=1e-6)
    assert np.std(soft["simulated"]) > 1.5 * np.std(stiff["simulated"])  # a softer spring gives way
    with pytest.raises(BadInput, match="there is no such log; choose another one"):
        Followed.of(model, data, 9, {})


def test_every_curve_follows_a_slider_and_what_is_let_go_is_kept(shown: Shown, show: Show, project: Project) -> None:
    tab = Tab(shown, show(project.folder), artefacts())
    tab.see("effects that fit")
    tab.go("Model")
    chart = tab.page.locator(".chart[aria-label='Measured and simulated'][data-ready=yes]")
    chart.wait_for()
    curve = "(el) => el.data[1].y.filter((_, k) => k % 50 === 0)"
    before = chart.evaluate(curve)
    slider = tab.page.get_by_label("slider of k")
    slid = f"""async (slider) => {{
        for (let k = 1; k <= {MOVES}; k++) {{
            slider.value = 1000 * k / {MOVES};
            slider.dispatchEvent(new Event("input"));
            await new Promise((done) => setTimeout(done, 5));
        }}
        slider.dispatchEvent(new Event("change"));
    }}"""
    slider.evaluate(slid)
    tab.page.wait_for_function(f"Number(document.querySelector('.chart').dataset.move) > {MOVES + 1}")  # the last one
    assert chart.evaluate(curve) != before
    tab.shot("model")
    assert project.values() == {"k": 100.0}  # its max
    assert tab.page.get_by_label("value of k").input_value() == "100"
    tab.page.keyboard.press("Control+z")
    tab.page.wait_for_function(f"Number(document.querySelector('.chart').dataset.move) > {MOVES + 2}")
    assert project.values() == {}
    assert chart.evaluate(curve) == pytest.approx(before)
    tab.page.keyboard.press("Control+y")
    tab.page.wait_for_function(f"Number(document.querySelector('.chart').dataset.move) > {MOVES + 3}")
    assert project.values() == {"k": 100.0}
    tab.page.get_by_label("fit k").uncheck()
    tab.until(lambda: "k" not in project.settings().free)
    tab.page.get_by_label("fit k").check()
    tab.until(lambda: set(project.settings().free) == {"m", "d", "k"})  # k is set, and a fit moves it from there
    words = works(project)["compare"].words
    assert "k" in words[words.index("--free") + 1].split(",")
    tab.page.get_by_label("max of k").fill("300")
    tab.page.get_by_label("max of k").press("Tab")
    tab.until(lambda: project.settings().ranges == {"k": (1.0, 300.0)})
    tab.until(lambda: 100 < int(tab.page.get_by_label("slider of k").input_value()) < 900)  # 100 is no longer its max
    assert "--bounds k=1.0:300.0" in " ".join(works(project)["compare"].words)
    tab.page.get_by_label("how the logs begin").select_option("as the model says")
    tab.until(lambda: {record.initial for record in data_of(project.data).records} == {"model"})
    tab.see("at the start values that the model gives its states")
    tab.page.keyboard.press("Control+z")
    tab.until(lambda: {record.initial for record in data_of(project.data).records} == {None})
    tab.page.get_by_label("how the logs begin").select_option("anywhere, estimated")
    tab.until(lambda: {record.initial for record in data_of(project.data).records} == {"estimate"})
    tab.page.keyboard.press("Control+z")
    tab.until(lambda: {record.initial for record in data_of(project.data).records} == {None})
    tab.until(lambda: tab.page.get_by_label("how the logs begin").input_value() == "near rest")
    low = tab.page.get_by_label("min of k")
    low.press_sequentially("400")  # the page is drawn anew meanwhile, since the logs were read again
    low.press("Tab")
    tab.see("is no range; give a smaller min, or a larger max")
    tab.press("All as the model has them")
    tab.page.wait_for_function(f"Number(document.querySelector('.chart').dataset.move) > {MOVES + 4}")
    assert chart.evaluate(curve) == pytest.approx(before)
    assert project.values() == {}
    assert tab.errors == []


def test_a_late_answer_moves_no_slider_back(shown: Shown, show: Show, project: Project) -> None:
    tab = Tab(shown, show(project.folder), artefacts())
    tab.see("effects that fit")
    tab.go("Model")
    value, tick = tab.page.get_by_label("value of k"), tab.page.get_by_label("fit d")
    value.wait_for()
    tab.page.evaluate(HOLD)
    tick.uncheck()
    tab.until(lambda: "d" not in project.settings().free)
    value.fill("75")
    value.press("Tab")
    tab.until(lambda: project.values() == {"k": 75.0})
    tab.until(lambda: '"heard":2' in tab.page.evaluate("window.waiting()").replace("\\", ""))
    left = 1
    while left:
        left = tab.page.evaluate("window.letIn()")
        assert (value.input_value(), tick.is_checked()) == ("75", False)
    assert tab.errors == []


def test_a_slider_stays_under_the_hand_whatever_the_server_says(shown: Shown, show: Show, project: Project) -> None:
    tab = Tab(shown, show(project.folder), artefacts())
    tab.see("effects that fit")
    tab.go("Model")
    slider = tab.page.get_by_label("slider of k")
    slider.evaluate("(el) => { el.value = 900; el.dispatchEvent(new Event('input')); }")
    tab.page.get_by_label("fit d").uncheck()
    tab.until(lambda: "d" not in project.settings().free)
    tab.page.wait_for_timeout(300)  # the answer comes
    assert slider.input_value() == "900"
    slider.evaluate("(el) => el.dispatchEvent(new Event('change'))")
    tab.until(lambda: project.values() == {"k": pytest.approx(90.1)})  # from 1 to 100
    assert tab.errors == []


@pytest.mark.slow
def test_fitted_values_stand_beside_those_where_fits_begin_and_are_taken_over(
    shown: Shown, show: Show, project: Project
) -> None:
    """The toy's diagnosis as if the project had run it: refitted, then with an offset."""
    folder = project.results("diagnose")
    folder.mkdir(parents=True)
    (folder / ANSWER).write_text(json.dumps(present.data(found_offset())))
    write_stages(folder / RECORDS, found_offset().history)
    project.change(added=("toy.offset",))
    _write_job(Job(works(project)["diagnose"], "done", 1.0, 2.0, project.fingerprint()), folder)
    tab = Tab(shown, show(project.folder), artefacts())
    tab.see("effects that fit")
    tab.go("Model")
    tab.see("Fitted values are those of the model with toy.offset: F_o = 0.4.")
    fitted = """() => [...document.querySelectorAll(".sliders tbody tr")].map((row) =>
        [row.querySelector("b").textContent, row.querySelector("td.number").textContent])"""
    assert dict(tab.page.evaluate(fitted)) == {"m": "1", "d": "1.5", "k": "0.75"}
    assert tab.page.get_by_label("value of k").input_value() == "20"
    tab.shot("model-fitted")
    project.change(added=())  # undone: those of the refitted model
    tab.page.reload()
    tab.see("Fitted values are those of the refitted model.")
    assert dict(tab.page.evaluate(fitted)) == {"m": "2", "d": "1", "k": "3"}
    tab.page.locator(".chart[data-ready=yes]").wait_for()
    tab.press("Take over the fitted values")
    tab.until(lambda: project.values() == {"m": 2.0, "d": 1.0, "k": 3.0})
    tab.until(lambda: tab.page.get_by_label("value of k").input_value() == "3")
    told = "The results belonged to what was chosen before. Changed: what is fitted, m, k and d. Undo brings them back."
    tab.page.locator(".q-notification", has_text=told).wait_for(timeout=20_000)
    aside = tab.page.locator(".note", has_text=told)
    for page in ("Add", "Compare", "Take away"):
        tab.go(page)
        aside.wait_for(timeout=20_000)
        assert tab.page.get_by_text("Nothing was fitted yet").count() == 0
    tab.shot("model-aside")
    tab.press("↶ Undo")
    tab.see("Undone: what is fitted, m, k and d")
    aside.wait_for(state="detached", timeout=20_000)
    tab.press("↷ Redo")
    tab.see("Redone: what is fitted, m, k and d")
    tab.press("Fit it again")
    tab.see("Done after", timeout=40)  # values that were set would be fitted no more
    assert aside.count() == 0
    tab.go("Model")
    tab.page.locator(".chart[data-ready=yes]").wait_for()
    most = tab.page.get_by_label("max of k")
    for typed, seen in (("300000000", "3e8"), ("1234567", "1234567")):  # all of it is seen
        most.fill(typed)
        most.blur()
        tab.until(lambda typed=typed: project.settings().ranges.get("k") == (1.0, float(typed)))
        tab.until(lambda seen=seen: most.input_value() == seen)
        assert most.evaluate("(el) => el.scrollWidth <= el.clientWidth")
    tab.press("↶ Undo")
    tab.press("↶ Undo")
    tab.until(lambda: project.settings().ranges == {})
    tab.page.get_by_label("how the logs begin").select_option("at rest")
    tab.see("Changed: how the logs begin. Undo", timeout=20)
    tab.page.get_by_text("Done after").wait_for(state="detached", timeout=20_000)  # that was of the choices before
    assert tab.errors == []
