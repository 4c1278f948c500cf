"""Draw workbench.png: the page at the moment the error falls, as a browser shows it.

    python3 -m validation.workbench.picture [PROJECT]

Needs the extra `app`, playwright and Chromium. PROJECT is made where it is missing: the measurements of an independent
plant with a hidden effect are dropped, and the diagnosis is run; that takes minutes. A project that has its answer is
only drawn.
"""

from __future__ import annotations

import re
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from pysim.io import write_dataset
from pysim.types import Dataset
from validation.workbench.served import browser, served

HERE = Path(__file__).parent
_PATIENCE, _WORK = 120_000, 40 * 60_000  # ms, for anything on the page, and for the diagnosis


@dataclass(frozen=True)
class Story:
    """What is dropped on a project that has no data yet.

    Args:
        dataset: measurements.
        model: class of the model.
        library: of the model, where it is none of ours.
    """

    dataset: Dataset
    model: str
    library: Path | None = None


def draw(project: Path, target: Path, story: Story) -> None:
    """Run the workbench on a project and keep a picture of its page Add."""
    with served(project) as address, browser() as shown:
        page = shown.new_page()
        page.set_viewport_size({"width": 1280, "height": 800})
        page.set_default_timeout(_PATIENCE)
        page.goto(address)
        if not (project / "data").is_dir():
            _drop(page, story)
        _show(page)
        page.screenshot(path=target)


def _drop(page: Any, story: Story) -> None:
    """Data and model, and the diagnosis. The files must stay until the page has read the last of them."""
    with tempfile.TemporaryDirectory() as folder:
        dropped = Path(folder) / "measurements"
        write_dataset(dropped, story.dataset)
        page.locator("input[aria-label=folder]").set_input_files(str(dropped))
        page.get_by_text("A data set was taken over").wait_for()
    page.get_by_text(re.compile(r"\d+ records, \d+ held out")).wait_for()
    if story.library is not None:
        page.locator("input[aria-label=files]").set_input_files(str(story.library))
        page.get_by_text("Libraries of yours").wait_for()
    page.get_by_label("Modelica class").fill(story.model)
    page.get_by_role("button", name="Use this model").click()
    page.get_by_text("effects that fit").wait_for()
    page.get_by_role("button", name="Find what is missing").first.click()


def _show(page: Any) -> None:
    """The page Add, once the diagnosis has its answer."""
    page.get_by_role("link", name=re.compile("Add")).first.click()
    page.get_by_role("button", name=re.compile("Undo")).wait_for(timeout=_WORK)
    page.locator(".chart[data-ready=yes]").first.wait_for()
    page.wait_for_timeout(2000)


def _bench() -> Story:
    """A plant whose valve's edges overlap."""
    from validation.diagnosis.sets import read_set

    return Story(read_set("bench-03"), "HydraulicTestBench.Pump.FreeGreyBox")


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as folder:
        draw(Path(sys.argv[1] if len(sys.argv) > 1 else f"{folder}/project"), HERE / "workbench.png", _bench())
