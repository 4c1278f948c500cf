"""Draw workbench.png: the page at the moment the error falls, as a browser shows it.

    python3 -m validation.workbench.picture [PROJECT]

Needs the extra `app`, playwright and Chromium. PROJECT is made where it is missing: the measurements of an independent
plant with a hidden effect are dropped, and the diagnosis is run; that takes minutes. A project that has its answer is
only drawn.
"""

from __future__ import annotations

import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any

from pysim.io import write_dataset
from validation.diagnosis.sets import read_set

HERE = Path(__file__).parent
MODEL, DATA = "HydraulicTestBench.Pump.FreeGreyBox", "bench-03"  # of a plant whose valve's edges overlap
_PATIENCE = 30 * 60_000  # ms


def draw(project: Path, target: Path) -> None:
    """Run the workbench on a project and keep a picture of its page Add."""
    from playwright.sync_api import sync_playwright

    words = [sys.executable, "-m", "pysim", "app", str(project), "--no-browser"]
    browser = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")
    with subprocess.Popen(words, cwd=HERE.parents[1], stdout=subprocess.PIPE, text=True) as server:
        try:
            assert server.stdout is not None
            address = re.sub(r"^Workbench: ", "", server.stdout.readline().strip())
            with sync_playwright() as play:
                page = play.chromium.launch(executable_path=browser, args=["--no-sandbox"]).new_page()
                page.set_viewport_size({"width": 1280, "height": 800})
                page.set_default_timeout(_PATIENCE)
                page.goto(address)
                _show(page)
                page.screenshot(path=target)
        finally:
            server.terminate()


def _show(page: Any) -> None:
    """Data and model, the diagnosis where it was not run yet, and the page Add."""
    page.get_by_text("Drop a data set here").wait_for()
    page.wait_for_timeout(5000)
    if page.get_by_text("no data set yet").count():
        with tempfile.TemporaryDirectory() as folder:
            write_dataset(Path(folder) / DATA, read_set(DATA))
            page.locator("input[aria-label=folder]").set_input_files(f"{folder}/{DATA}")
            page.get_by_text(DATA).first.wait_for()
        page.get_by_text("records, ").first.wait_for()
        page.get_by_label("Modelica class").fill(MODEL)
        page.get_by_role("button", name="Use this model").click()
        page.get_by_text("effects that fit").wait_for()
        page.get_by_role("button", name="Find what is missing").first.click()
    page.get_by_role("link", name=re.compile("Add")).first.click()
    page.get_by_role("button", name=re.compile("Undo")).wait_for()
    page.locator(".chart[data-ready=yes]").first.wait_for()
    page.wait_for_timeout(2000)


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as folder:
        draw(Path(sys.argv[1] if len(sys.argv) > 1 else f"{folder}/project"), HERE / "workbench.png")
