"""The end of a process is the end of all that it has started."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from pysim.app import processes
from pysim.app.processes import Started, end_all
from tests.pysim.app.alive import PARENT, alive, child


@pytest.mark.skipif(sys.platform == "win32", reason="reads /proc")
@pytest.mark.parametrize("hard", [True, False])
def test_what_it_has_started_ends_with_it(hard: bool, tmp_path: Path) -> None:
    with subprocess.Popen([sys.executable, "-c", PARENT], cwd=tmp_path, start_new_session=True) as process:
        number = child(tmp_path)
        end_all(process.pid, hard=hard)
        process.wait(30)
    assert not alive(number)


STUBBORN = f"import signal; signal.signal(signal.SIGTERM, signal.SIG_IGN)\n{PARENT}"


@pytest.mark.skipif(sys.platform == "win32", reason="reads /proc")
@pytest.mark.parametrize("code", [PARENT, STUBBORN])
def test_what_somebody_else_has_started_ends_with_all_that_it_has_started(code: str, tmp_path: Path) -> None:
    with subprocess.Popen([sys.executable, "-c", code], cwd=tmp_path, start_new_session=True) as process:
        number, started = child(tmp_path), Started.of(process.pid)
        assert started.lives
        assert started.end(0.2 if code == STUBBORN else 30)
    assert not started.lives
    assert not alive(number)


def test_another_process_with_its_number_is_left_alone(tmp_path: Path) -> None:
    with subprocess.Popen([sys.executable, "-c", PARENT], cwd=tmp_path, start_new_session=True) as process:
        child(tmp_path)
        for earlier in (Started(process.pid, 1e9), Started(process.pid, 0.0)):
            assert not earlier.lives
            assert earlier.end(0.2)
        assert process.poll() is None
        end_all(process.pid, hard=True)


@pytest.mark.skipif(sys.platform == "win32", reason="nobody is asked there")
def test_one_that_has_ended_and_waits_to_be_asked_does_not_run() -> None:
    with subprocess.Popen([sys.executable, "-c", "input()"], stdin=subprocess.PIPE) as process:
        started = Started.of(process.pid)
        assert started.lives
        process.kill()
        os.waitid(os.P_PID, process.pid, os.WEXITED | os.WNOWAIT)
        assert not started.lives
        assert Started.of(process.pid).began == 0
    assert not started.lives


def test_what_cannot_be_ended_is_said(monkeypatch: pytest.MonkeyPatch) -> None:
    def refused(*_: object) -> None:
        raise PermissionError

    monkeypatch.setattr(processes.os, "killpg", refused)
    assert not Started.of(os.getpid()).end(0.05)
