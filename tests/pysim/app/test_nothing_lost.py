"""The worker is killed, the server is killed, a tab is loaded anew or opened beside it: nothing chosen is lost."""

import json
import os
import signal
from pathlib import Path

import pytest

from pysim.app.jobs import DONE, read_job
from pysim.app.project import Project
from tests.pysim.app.browser import Shown, Tab, server
from tests.pysim.app.made import rubbing

pytestmark = pytest.mark.slow
PATIENCE = 100.0  # s, on a machine that does other things too


def test_a_killed_worker_and_a_killed_server_lose_nothing(shown: Shown, tmp_path: Path) -> None:
    project = rubbing(tmp_path / "project")
    with server(project.folder) as address:
        tab = Tab(shown, address)
        tab.see("effects that fit", timeout=PATIENCE)
        tab.page.get_by_label("noise of x").fill("0.0012")
        tab.page.get_by_label("noise of x").press("Tab")
        tab.until(lambda: b"0.0012" in project.description.read_bytes())
        chosen = _choose_a_value(tab, project)
        other = Tab(shown, address)
        _kill_the_worker(tab, project)
        other.see("Find what is missing failed")  # two tabs agree
        tab.page.reload()
        tab.see("Find what is missing failed")
        assert _bytes(project) == chosen
        tab.press("Find what is missing")  # goes on in a new worker
        tab.see("Stop")
        tab.until(lambda: (project.results("diagnose") / "report/checkpoint.jsonl").is_file(), timeout=PATIENCE)
        lock = json.loads((project.folder / "server.lock").read_text())
        os.kill(lock["pid"], signal.SIGKILL)
        job = read_job(project.results("diagnose"))
        assert job is not None
        tab.until(lambda: not job.lives)  # its worker ends with it
    assert _bytes(project) == chosen
    with server(project.folder) as address:
        tab = Tab(shown, address)
        tab.see("was stopped; what it had found is kept")
        assert _bytes(project) == chosen
        tab.go("Model")
        assert float(tab.page.get_by_label("value of k").input_value()) == 41
        assert tab.page.get_by_role("button", name="↶ Undo").is_disabled()  # a new server has nothing to go back to
        tab.go("Data")
        tab.press("Go on")
        tab.see("Done after", timeout=PATIENCE)
        job = read_job(project.results("diagnose"))
        assert job is not None
        assert job.state == DONE
        assert tab.errors == []


def _choose_a_value(tab: Tab, project: Project) -> dict[str, bytes]:
    """A parameter is set, which undo and redo take back and give again."""
    tab.go("Model")
    tab.page.locator(".chart[aria-label='Measured and simulated'][data-ready=yes]").wait_for()  # logs were read
    field = tab.page.get_by_label("value of k")
    field.fill("41")
    field.press("Tab")
    tab.until(lambda: project.values() == {"k": 41})
    chosen = _bytes(project)
    tab.page.locator("h1").click()
    tab.page.keyboard.press("Control+z")
    tab.until(lambda: project.values() == {})
    tab.page.keyboard.press("Control+y")
    tab.until(lambda: _bytes(project) == chosen)
    tab.go("Data")
    return chosen


def _kill_the_worker(tab: Tab, project: Project) -> None:
    tab.page.get_by_role("button", name="Find what is missing", disabled=False).click()
    tab.see("Stop")
    tab.until(lambda: (job := read_job(project.results("diagnose"))) is not None and job.process is not None)
    job = read_job(project.results("diagnose"))
    assert job is not None
    assert job.process is not None
    os.kill(job.process.pid, signal.SIGKILL)
    tab.see("Find what is missing failed: the process")


def _bytes(project: Project) -> dict[str, bytes]:
    return {path.name: path.read_bytes() for path in project.choices if path.is_file()}
