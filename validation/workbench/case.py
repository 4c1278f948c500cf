"""How long the page lets its user wait for the first thing to see."""

from __future__ import annotations

import statistics
import tempfile
from collections.abc import Iterator
from pathlib import Path

from validation.findings import Cost, Finding
from validation.workbench.served import browser, missing, served

_LIMIT = 1.5  # s, on 2 cores
_TIMES = 5
_CLAIM = f"first paint of the page, the median of {_TIMES}"
_PAINTED = "performance.getEntriesByName('first-contentful-paint')[0].startTime"


def run() -> Iterator[Finding]:
    """One finding; skipped where there is no browser."""
    if why := missing():
        yield Finding(_CLAIM, float("nan"), _LIMIT, "s", why)
        return
    with tempfile.TemporaryDirectory() as folder, served(Path(folder) / "project") as address, browser() as shown:
        found = statistics.median(_paint(shown, address) for _ in range(_TIMES))
    yield Finding(_CLAIM, found, _LIMIT, "s", cost=Cost("first paint of the workbench", found, "s"))


def _paint(shown: object, address: str) -> float:
    """Of a page that has nothing in its cache, s."""
    page = shown.new_page()  # type: ignore[attr-defined]
    page.goto(address)
    page.wait_for_selector(".page h1")
    found = float(page.evaluate(_PAINTED)) / 1000
    page.close()
    return found
