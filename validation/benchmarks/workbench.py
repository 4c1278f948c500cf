"""What a press and a move take on the workbench, by the clock, beside Python that does the same work.

The page runs in Chromium without a window. A press lasts from the click until the page shows that its job is done.
"""

from __future__ import annotations

import importlib.util
import re
import shutil
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from pysim.diagnosis import Session, compare, diagnose
from pysim.identify.greybox import Simulation
from pysim.identify.greybox.comparison import compared
from pysim.identify.greybox.parameters import ParameterSpace
from pysim.workflow import data_of, fit_problem, open_session
from validation.benchmarks.measurement import Measurement

MOVES = 50
_PATIENCE = 300_000  # ms
_PROGRAMS = ("chromium", "chromium-browser", "google-chrome")
_MACHINES = {
    "drive": ("Open the positioning drive", "Drive.Axis", {"slider": 0.1, "compare": 1.0, "find": 15.0}),
    "pump": ("Open the pump", "HydraulicTestBench.Pump.FreeGreyBox", {"compare": 3.0}),
}  # button, class, and what each may take, s
_PAINTED = 1.5  # s until anything is seen
_FIRST_PAINT = "window.did_handshake && performance.getEntriesByName('first-contentful-paint')[0]?.startTime"  # ms
_MOVED = """async ([slider, chart, moves]) => {
    const low = Number(slider.min), high = Number(slider.max), times = [];
    for (let k = 0; k < moves; k++) {
        const before = chart.dataset.move, begun = performance.now();
        slider.value = low + (high - low) * (0.3 + 0.4 * k / moves);
        slider.dispatchEvent(new Event("input"));
        while (chart.dataset.move === before) await new Promise((done) => setTimeout(done, 1));
        times.push((performance.now() - begun) / 1000);
    }
    return times;
}"""


def measure(_pairs: int) -> Iterator[Measurement]:
    """Of the example of the drive, then of the pump; every number once."""
    why = _missing()
    if why:
        yield Measurement("presses and moves of the workbench", float("nan"), _PAINTED, "s", why)
        return
    from playwright.sync_api import sync_playwright

    with sync_playwright() as play:
        program = next(filter(None, map(shutil.which, _PROGRAMS)))
        browser = play.chromium.launch(executable_path=program, args=["--no-sandbox"])
        for name in _MACHINES:
            with tempfile.TemporaryDirectory() as folder, _server(Path(folder) / "project") as address:
                page = browser.new_context().new_page()
                page.set_default_timeout(_PATIENCE)
                yield from _of_machine(name, page, address, Path(folder) / "project")
        browser.close()


def _missing() -> str:
    modules = [name for name in ("nicegui", "playwright") if importlib.util.find_spec(name) is None]
    if modules:
        return f"{modules[0]} is not installed: python3 run.py python -m pip install {modules[0]}"
    return "" if any(map(shutil.which, _PROGRAMS)) else "there is no Chromium here"


@contextmanager
def _server(folder: Path) -> Iterator[str]:
    """The address of the workbench on a new project."""
    command = [sys.executable, "-m", "pysim", "app", str(folder), "--no-browser"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout is not None
        try:
            lines = (re.match(r"Workbench: (\S+)", line) for line in process.stdout)
            yield next(found[1] for found in lines if found)
        finally:
            process.terminate()


def _of_machine(name: str, page: Any, address: str, project: Path) -> Iterator[Measurement]:
    button, class_name, aims = _MACHINES[name]
    page.goto(address)
    page.wait_for_selector(".page h1")
    page.reload()  # as it is opened every day: scripts are in the cache
    page.wait_for_selector(".page h1")
    seen = page.wait_for_function(_FIRST_PAINT).json_value() / 1000
    yield Measurement(f"{name}: until anything is seen", seen, _PAINTED, "s")
    page.get_by_role("button", name=button).click()
    page.get_by_text("Done after").first.wait_for()
    opened = open_session(class_name, data_of(project / "data"), library=sorted((project / "model").glob("*.mo")))
    yield from _pressed(name, page, "Compare", "Compare and refit", "compare", aims, lambda: compare(opened))
    if "find" in aims:
        yield from _pressed(name, page, "Data", "Find what is missing", "find", aims, lambda: diagnose(opened))
    if "slider" in aims:
        yield from _slid(name, page, opened, aims["slider"])


def _pressed(
    name: str, page: Any, where: str, button: str, what: str, aims: dict[str, float], alone: Callable[[], object]
) -> Iterator[Measurement]:
    """A press, and the same call, both for the second time: what they need is compiled."""
    _go(page, where)
    press = page.get_by_role("button", name=button, exact=True).first
    for _ in range(2):
        press.wait_for()
        begun = time.perf_counter()
        press.click()
        page.locator(".job").wait_for()
        page.locator(".job").wait_for(state="detached")
        taken = time.perf_counter() - begun
        _go(page, where)
    yield Measurement(f"{name}: {button}", taken, aims[what], "s")
    alone()
    begun = time.perf_counter()
    alone()
    yield Measurement(f"{name}: the same call in Python", time.perf_counter() - begun, unit="s")


def _slid(name: str, page: Any, opened: Session, aim: float) -> Iterator[Measurement]:
    """Moves of a slider until every curve has followed, and the same runs in a loop."""
    _go(page, "Model")
    page.locator(".chart[aria-label='Measured and simulated'][data-ready=yes]").wait_for()
    sliders, charts = page.locator("input[type=range]"), page.locator(".chart")
    parameter = sliders.first.get_attribute("aria-label").removeprefix("slider of ")
    page.wait_for_timeout(1000)  # what was drawn when the page opened is done
    moves = page.evaluate(_MOVED, [sliders.first.element_handle(), charts.first.element_handle(), MOVES])
    yield Measurement(f"{name}: 95 of 100 moves of a slider", float(np.percentile(moves, 95)), aim, "s")
    yield Measurement(
        f"{name}: 95 of 100 runs in a loop", float(np.percentile(_looped(opened, parameter), 95)), unit="s"
    )


def _looped(opened: Session, parameter: str) -> list[float]:
    log = replace(opened.dataset.logs()[0], use="fit")
    problem = fit_problem(opened.model, [replace(opened.dataset, records=(log,))], values={}, nothing_free=True)
    states = compared(problem, np.zeros(0), Simulation()).states  # where the log begins, found once, as on the page
    variable, times = opened.model[parameter], list[float]()
    assert variable.min is not None
    assert variable.max is not None
    for k in range(MOVES):
        value = variable.min + (variable.max - variable.min) * (0.3 + 0.4 * k / MOVES)
        begun = time.perf_counter()
        compared(replace(problem, space=ParameterSpace.held({parameter: value})), np.zeros(0), Simulation(), states)
        times.append(time.perf_counter() - begun)
    return times


def _go(page: Any, name: str) -> None:
    page.get_by_role("link", name=re.compile(name)).first.click()
    page.wait_for_selector(f".rail a[aria-current=page]:has-text('{name}')")
