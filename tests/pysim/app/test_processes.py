"""The end of a process is the end of all that it has started."""

import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

from pysim.app import processes
from pysim.app.processes import end
from tests.pysim.app.alive import PARENT, alive, child


@pytest.mark.skipif(sys.platform == "win32", reason="reads /proc")
@pytest.mark.parametrize("hard", [True, False])
def test_what_it_has_started_ends_with_it(hard: bool, tmp_path: Path) -> None:
    with subprocess.Popen([sys.executable, "-c", PARENT], cwd=tmp_path, start_new_session=True) as process:
        number = child(tmp_path)
        end(process, hard=hard)
        process.wait(30)
    assert not alive(number)


@pytest.mark.parametrize(("code", "called"), [(None, [["taskkill", "/T", "/F", "/PID", "7"], "kill"]), (0, [])])
def test_on_windows_the_tree_is_ended_while_its_root_still_runs(
    code: int | None, called: list[Any], monkeypatch: pytest.MonkeyPatch
) -> None:
    seen: list[Any] = []
    monkeypatch.setattr(processes.sys, "platform", "win32")
    monkeypatch.setattr(processes.subprocess, "run", lambda words, **_: seen.append(words))
    process: Any = SimpleNamespace(pid=7, poll=lambda: code, kill=lambda: seen.append("kill"))
    end(process, hard=False)
    assert seen == called


def test_where_taskkill_is_missing_the_process_itself_is_ended(monkeypatch: pytest.MonkeyPatch) -> None:
    def missing(*_: object, **__: object) -> None:
        raise FileNotFoundError

    seen: list[str] = []
    monkeypatch.setattr(processes.sys, "platform", "win32")
    monkeypatch.setattr(processes.subprocess, "run", missing)
    process: Any = SimpleNamespace(pid=7, poll=lambda: None, kill=lambda: seen.append("kill"))
    end(process, hard=True)
    assert seen == ["kill"]
