"""The model of the page: only the newest build counts, and none leaves a process behind."""

import asyncio
import json
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path
from types import SimpleNamespace

import pytest

from fmu_build.pack import compiler
from pysim.app import model_build
from pysim.app.desk import Desk
from pysim.app.jobs import Runner
from pysim.app.model_build import build_model
from pysim.app.project import Project
from pysim.app.upload import Limits
from tests.pysim.app.alive import PARENT, alive, child

_TOLD = {"structure": None, "parameters": [], "slots": [], "effects": []}


def _write(name: str) -> str:
    """Python that writes what the command line would say of a model."""
    return f"open(sys.argv[-1], 'w').write({json.dumps({'name': name, **_TOLD})!r})"


_BUILDS = {
    "Quick": _write("Quick"),
    "Slow": f"time.sleep(1.5); {_write('Slow')}",
    "Bad": "print('pysim model: no such class; name another'); raise SystemExit(2)",
    "Endless": PARENT,
}


@pytest.fixture
def project(tmp_path: Path) -> Project:
    return Project.at(tmp_path / "project")


@pytest.fixture(autouse=True)
def started(monkeypatch: pytest.MonkeyPatch) -> "list[subprocess.Popen[bytes]]":
    """Processes that were begun; a class name stands for some lines of Python."""
    found: list[subprocess.Popen[bytes]] = []

    def run(words: Sequence[str], folder: Path, output: int) -> "subprocess.Popen[bytes]":
        command = [sys.executable, "-c", f"import sys, time\n{_BUILDS[words[1]]}", words[-1]]
        found.append(subprocess.Popen(command, cwd=folder, stdout=output, stderr=output, start_new_session=True))
        return found[-1]

    monkeypatch.setattr(model_build, "run_pysim", run)
    return found


def overtaken(project: Project, by: str) -> Desk:
    """A slow build still goes on when another model is named."""
    desk = Desk(project, Runner(project), Limits(), " ".join)

    async def both() -> None:
        project.change(model="Slow")
        first = asyncio.create_task(desk.read_model())
        await asyncio.sleep(0.2)
        project.change(model=by)
        await desk.read_model()
        assert not desk.model_busy
        await first

    asyncio.run(both())
    return desk


def test_a_slow_build_that_is_overtaken_is_ended_and_thrown_away(
    project: Project, started: "list[subprocess.Popen[bytes]]"
) -> None:
    desk = overtaken(project, "Quick")
    assert desk.model is not None
    assert (desk.model["name"], desk.model_trouble, desk.model_busy) == ("Quick", "", False)
    assert [process.poll() for process in started] == [-9, 0]


def test_without_a_model_the_build_of_the_earlier_one_is_thrown_away(project: Project) -> None:
    desk = overtaken(project, "")
    assert (desk.model, desk.model_trouble, desk.model_busy) == (None, "", False)


def test_what_fails_says_why_in_the_command_s_own_words(project: Project) -> None:
    project.change(model="Bad")
    built = asyncio.run(build_model(project, lambda: True))
    assert (built.model, built.trouble) == (None, "no such class; name another")


def test_a_build_beyond_its_limit_is_ended_with_all_that_it_has_started(
    project: Project, monkeypatch: pytest.MonkeyPatch
) -> None:
    project.change(model="Endless")
    clock = SimpleNamespace(monotonic=lambda: 9.0 if (project.folder / "child").exists() else 0.0)
    monkeypatch.setattr(model_build, "time", clock)
    built = asyncio.run(build_model(project, lambda: True, limit=5.0))
    assert built.trouble.startswith("the model was not ready within 5 s; the first one on a machine takes some minutes")
    assert "use it again" in built.trouble
    assert not alive(child(project.folder))


def test_the_first_compilation_has_the_time_that_the_compiler_grants_it() -> None:
    assert model_build._LIMIT > compiler._LONGEST_S


def test_a_build_that_nobody_waits_for_is_ended(project: Project, started: "list[subprocess.Popen[bytes]]") -> None:
    project.change(model="Endless")

    async def left() -> None:
        task = asyncio.create_task(build_model(project, lambda: True))
        await asyncio.to_thread(child, project.folder)
        task.cancel()
        with pytest.raises(asyncio.CancelledError):
            await task

    asyncio.run(left())
    assert not alive(child(project.folder))
    assert started[0].poll() is not None
