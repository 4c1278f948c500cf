"""The workbench in a process of its own, and Debian's Chromium in front of it."""

import http.client
import os
import re
import subprocess
import sys
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any
from urllib.parse import urlsplit

import pytest

from tests.pysim.app import chromium

ROOT = Path(__file__).parents[3]
SIZE: Any = {"width": 1280, "height": 800}
Show = Callable[..., str]  # from a project to the address of the workbench that shows it
# Answers of the server wait until they are let in, one by one; it says how many still wait.
HOLD = """() => {
  const heard = window.socket.onevent.bind(window.socket), held = [];
  window.socket.onevent = (packet) => held.push(packet);
  window.waiting = () => JSON.stringify(held);
  window.letIn = () => (held.length ? heard(held.shift()) : null, held.length);
}"""
_STARTED = 300.0  # s, on a machine that does other things too


@contextmanager
def server(folder: Path, *words: str, program: Sequence[str] = ("-m", "pysim")) -> Iterator[str]:
    """The address of `pysim app` on a project, with its token; ended afterwards."""
    log = folder.parent / f"{folder.name}.log"
    command = [sys.executable, *program, "app", str(folder), "--no-browser", *words]
    own = {k: v for k, v in os.environ.items() if not k.startswith("PYTEST")}  # by which NiceGUI knows its own tests
    environment = {**own, "PYTHONPATH": str(ROOT), "OPENBLAS_NUM_THREADS": "1"}
    with log.open("wb") as output:
        process = subprocess.Popen(command, cwd=ROOT, env=environment, stdout=output, stderr=subprocess.STDOUT)
    try:
        yield _address(log, process)
    finally:
        process.terminate()
        process.wait(30)


def _address(log: Path, process: "subprocess.Popen[bytes]") -> str:
    begun = time.monotonic()
    while time.monotonic() - begun < _STARTED and process.poll() is None:
        found = re.search(r"^Workbench: (\S+)$", log.read_text(encoding="utf-8"), re.M)
        if found:
            return found[1]
        time.sleep(0.05)
    raise AssertionError(f"the workbench did not start: {log.read_text(encoding='utf-8')}")


def asked(address: str, method: str, path: str, body: bytes = b"") -> tuple[int, str]:
    """Status and text of what is not a page."""
    parts = urlsplit(address)
    connection = http.client.HTTPConnection(parts.hostname or "", parts.port, timeout=60)
    cookie = f"pysim_app_{parts.port}={address.partition('token=')[2]}"
    connection.request(method, path, body, {"Cookie": cookie})
    answer = connection.getresponse()
    return answer.status, answer.read().decode()


def base(address: str) -> str:
    """Without path and token."""
    return address.partition("/?")[0]


class Shown:
    """A browser without a window. Its first tab is kept from test to test, since a new one reads, compiles and draws
    all of the page's scripts anew: 2 s of computing each; every further tab has a context of its own.

    Args:
        found: Chromium with nothing open.
    """

    def __init__(self, found: Any) -> None:
        self._browser = found
        self._kept = self._tab()
        self._begun = 0
        self._heard: list[tuple[str, Callable[[Any], object]]] = []

    def page(self) -> Any:
        """A tab that shows nothing."""
        self._begun += 1
        return self._kept if self._begun == 1 else self._tab()

    def listen(self, page: Any, event: str, heard: Callable[[Any], object]) -> None:
        """Tell what happens on a page, until the end of the test."""
        page.on(event, heard)
        if page is self._kept:
            self._heard.append((event, heard))

    def end(self) -> None:
        """Close all tabs but the first, which shows nothing and has the first look again."""
        self._begun = 0
        for context in self._browser.contexts:
            if context is not self._kept.context:
                context.close()
        for event, heard in self._heard:
            self._kept.remove_listener(event, heard)
        self._heard.clear()
        self._kept.goto("about:blank")
        self._kept.emulate_media(color_scheme="light")
        self._kept.set_viewport_size(SIZE)

    def _tab(self) -> Any:
        return self._browser.new_context(viewport=SIZE, accept_downloads=True).new_page()


@contextmanager
def browser() -> Iterator[Shown]:
    """A browser; the test is skipped where there is none."""
    if why := chromium.missing():
        pytest.skip(why)
    with chromium.browser() as found:
        yield Shown(found)


class Tab:
    """One tab, with what went wrong in it and every address that it asked.

    Args:
        shown: a browser.
        address: with the token.
        artefacts: where screenshots are kept; none where None.
        media: what the page is told of the system, such as color_scheme.
    """

    def __init__(self, shown: Shown, address: str, artefacts: Path | None = None, **media: Any) -> None:
        self.page = shown.page()
        self.page.emulate_media(**media)
        self.page.set_default_timeout(150_000)
        self.errors: list[str] = []
        self.asked: list[str] = []
        shown.listen(self.page, "pageerror", lambda error: self.errors.append(str(error)))
        shown.listen(self.page, "console", lambda m: self.errors.append(m.text) if m.type == "error" else None)
        shown.listen(self.page, "request", lambda request: self.asked.append(request.url))
        shown.listen(self.page, "dialog", lambda dialog: self.errors.append(f"dialog {dialog.message}"))
        self._base, self._artefacts = base(address), artefacts
        self.page.goto(address)
        self.page.wait_for_selector(".page h1")
        # what is pressed before waits, and is lost where a link is followed meanwhile
        self.page.wait_for_function("window.did_handshake")

    def go(self, name: str) -> None:
        """To a page, by its link."""
        self.page.get_by_role("link", name=re.compile(name)).first.click()
        self.page.wait_for_selector(f".rail a[aria-current=page]:has-text('{name}')")

    def press(self, name: str) -> None:
        """A button."""
        self.page.get_by_role("button", name=name, exact=True).first.click()

    def pick(self, chart: str, across: float, down: float) -> None:
        """Click inside the axes of the first chart of a name, at these shares of width and height.

        The mouse waits until the page has stopped scrolling: a place read before is another place afterwards.
        """
        axes = self.page.locator(f".chart[aria-label^='{chart}'][data-ready=yes] .nsewdrag").first
        axes.scroll_into_view_if_needed()
        box = axes.bounding_box()
        axes.click(position={"x": across * box["width"], "y": down * box["height"]})

    def see(self, words: str, *, timeout: float = 150.0) -> None:
        """Wait until some words are to be seen."""
        self.page.get_by_text(words).first.wait_for(timeout=1000 * timeout)

    def until(self, true: Callable[[], bool], *, timeout: float = 20.0) -> None:
        """Wait until the server has done what was asked, however busy the machine is."""
        begun = time.monotonic()
        while not true() and time.monotonic() - begun < timeout:
            self.page.wait_for_timeout(100)
        assert true()

    def drop(self, kind: str, *paths: Path) -> None:
        """Choose files or a folder for the drop; kind is "files" or "folder"."""
        self.page.locator(f"input[aria-label={kind}]").set_input_files([str(path) for path in paths])

    def idle(self, *, timeout: float = 120.0) -> None:
        """Wait until nothing runs."""
        self.page.locator(".job").wait_for(state="detached", timeout=1000 * timeout)

    def accessible(self, *, timeout: float = 10.0) -> None:
        """Wait until axe-core finds nothing that some could not see, reach or hear."""
        from axe_playwright_python.sync_playwright import Axe

        begun, found = time.monotonic(), ["nothing looked at"]
        while found and time.monotonic() - begun < timeout:  # a drawing that is not done yet is no finding
            rules = Axe().run(self.page).response["violations"]
            found = [f"{rule['id']}: {node['html']}" for rule in rules for node in rule["nodes"]]
        assert not found, found

    def shot(self, name: str) -> None:
        """Keep a screenshot as an artefact."""
        if self._artefacts is not None:
            self._artefacts.mkdir(parents=True, exist_ok=True)
            self.page.wait_for_timeout(700)
            self.page.screenshot(path=self._artefacts / f"{name}.png")

    def print(self, name: str) -> None:
        """Keep what paper shows as an artefact."""
        if self._artefacts is not None:
            self.page.pdf(path=self._artefacts / f"{name}.pdf", prefer_css_page_size=True)

    def foreign(self) -> list[str]:
        """Addresses that were asked of anybody else."""
        own = (self._base, self._base.replace("http", "ws"), "data:", "blob:")
        return [url for url in self.asked if not url.startswith(own)]


def artefacts() -> Path | None:
    """Where screenshots go: the folder that PYSIM_ARTEFACTS names."""
    folder = os.environ.get("PYSIM_ARTEFACTS")
    return Path(folder) if folder else None
