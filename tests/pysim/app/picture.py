"""Draw docs/workbench.png, which leads the README: the page at the moment the error falls, as a browser shows it.

    python3 run.py python -m tests.pysim.app.picture [PROJECT]

Needs playwright and Chromium. PROJECT is made where it is missing: the measurements of an independent plant whose
valve has a dead band are dropped, and the diagnosis is run; that takes minutes. A project that has its answer is only
drawn.
"""

from __future__ import annotations

import re
import sys
import tempfile
from pathlib import Path
from typing import Any

from pysim.io import write_dataset
from tests.pysim.app.browser import server
from tests.pysim.app.chromium import browser
from validation.diagnosis.sets import read_set

PICTURE = Path(__file__).parents[3] / "docs" / "workbench.png"
SET, MODEL = "bench-03", "HydraulicTestBench.Pump.FreeGreyBox"
_PATIENCE, _WORK = 120_000, 40 * 60_000  # ms, for anything on the page, and for the diagnosis


def draw(project: Path) -> None:
    """Run the workbench on a project and keep a picture of its page Add."""
    with server(project) as address, browser() as shown:
        page = shown.new_page()
        page.set_viewport_size({"width": 1280, "height": 800})
        page.set_default_timeout(_PATIENCE)
        page.goto(address)
        if not (project / "data").is_dir():
            _drop(page)
        _show(page)
        page.screenshot(path=PICTURE)


def _drop(page: Any) -> None:
    """Data and model, and the diagnosis. The files must stay until the page has read the last of them."""
    with tempfile.TemporaryDirectory() as folder:
        dropped = Path(folder) / "measurements"
        write_dataset(dropped, read_set(SET))
        page.locator("input[aria-label=folder]").set_input_files(str(dropped))
        page.get_by_text("A data set was taken over").wait_for()
    page.get_by_text(re.compile(r"\d+ records, \d+ not fitted")).wait_for()
    page.get_by_label("Modelica class").fill(MODEL)
    page.get_by_role("button", name="Use this model").click()
    page.get_by_text("effects that fit").wait_for()
    page.get_by_role("button", name="Find what is missing").first.click()


def _show(page: Any) -> None:
    """The page Add, once the diagnosis has its answer."""
    page.get_by_role("link", name=re.compile("Add")).first.click()
    page.get_by_role("button", name=re.compile("Undo")).wait_for(timeout=_WORK)
    page.locator(".chart[data-ready=yes]").first.wait_for()
    page.wait_for_timeout(2000)


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as folder:
        draw(Path(sys.argv[1] if len(sys.argv) > 1 else f"{folder}/project"))
