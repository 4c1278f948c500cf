"""Chromium without a window, for the workbench's pages."""

from __future__ import annotations

import importlib.util
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

_PROGRAMS = ("chromium", "chromium-browser", "google-chrome")


def missing() -> str:
    """What is not there that a page needs, "" where all is."""
    for module, cure in (
        ("nicegui", 'pip install ".[app]"'),
        ("playwright", "pip install playwright"),
        ("axe_playwright_python", "pip install axe-playwright-python"),
    ):
        if importlib.util.find_spec(module) is None:
            return f"{module} is not installed ({cure})"
    return "" if _program() else "there is no Chromium here (Debian: apt-get install chromium)"


@contextmanager
def browser() -> Iterator[Any]:
    """Chromium without a window and with nothing open."""
    from playwright.sync_api import sync_playwright

    with sync_playwright() as play:
        found = play.chromium.launch(executable_path=_program(), args=["--no-sandbox"])
        try:
            yield found
        finally:
            found.close()


def _program() -> str | None:
    return next((found for name in _PROGRAMS if (found := shutil.which(name))), None)
