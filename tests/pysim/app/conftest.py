"""One browser and one server for the pages of all test files; a test has a project and tabs of its own."""

import asyncio
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from tests.pysim.app.browser import Show, Shown, asked, browser, server


@pytest.fixture(scope="session")
def _chromium() -> Iterator[tuple[Shown, Any]]:
    """With the event loop in which Playwright runs. It counts as running until the end, in this thread; between the
    tests of pages it is hidden, so that other tests can run loops of their own."""
    with browser() as found:
        loop = asyncio._get_running_loop()
        asyncio._set_running_loop(None)
        yield found, loop
        asyncio._set_running_loop(loop)


@pytest.fixture
def shown(_chromium: tuple[Shown, Any]) -> Iterator[Shown]:
    """A browser without a window and with nothing open, before and after a test."""
    found, loop = _chromium
    asyncio._set_running_loop(loop)
    try:
        yield found
        found.end()
    finally:
        asyncio._set_running_loop(None)


@pytest.fixture(scope="session")
def _address(tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    folder = tmp_path_factory.mktemp("workbench") / "none"
    with server(folder, program=("-m", "tests.pysim.app.one_server")) as address:
        yield address


@pytest.fixture
def show(_address: str) -> Show:
    """From a project's folder, made where it is missing, to the address of the workbench that shows it from then on."""

    def shows(folder: Path, *, idle: bool = False, size: int = 256 * 2**20, restless: bool = False) -> str:
        query = f"folder={folder}&idle={int(idle)}&size={size}&restless={int(restless)}"
        assert asked(_address, "POST", f"/tests/show?{query}")[0] == 200
        return _address

    return shows
