"""The end of a process is the end of all that it has started."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from pysim.app import processes
from pysim.app.processes import Started, end, last_words, run_pysim
from tests.pysim.app.alive import PARENT, alive, child


@pytest.mark.skipif(sys.platform == "win32", reason="reads /proc")
@pytest.mark.parametrize("hard", [True, False])
def test_what_it_has_started_ends_with_it(hard: bool, tmp_path: Path) -> None:
    with subprocess.Popen([sys.executable, "-c", PARENT], cwd=tmp_path, start_new_session=True) as process:
        number = child(tmp_path)
        end(process, hard=hard)
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
        for earlier in (Started(process.pid, "of another one"), Started(process.pid, "")):
            assert not earlier.lives
            assert earlier.end(0.2)
        assert process.poll() is None
        end(process, hard=True)


def test_what_cannot_be_ended_is_said(monkeypatch: pytest.MonkeyPatch) -> None:
    def refused(*_: object) -> None:
        raise PermissionError

    monkeypatch.setattr(processes.os, "killpg", refused)
    assert not Started.of(os.getpid()).end(0.05)


def test_what_a_command_says_is_read_as_it_was_said(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PYTHONIOENCODING", "cp1252")  # as where output goes to a file on Windows
    begin = subprocess.Popen
    say = "print('pysim compare: Prüfstand/Größe.csv: \\u2265 2 rows \\udc80')"
    monkeypatch.setattr(processes.subprocess, "Popen", lambda _, **more: begin([sys.executable, "-c", say], **more))
    with (tmp_path / "output.txt").open("wb") as output:
        assert run_pysim(["compare"], tmp_path, output).wait(60) == 0
    assert last_words(tmp_path / "output.txt") == "Prüfstand/Größe.csv: ≥ 2 rows \\udc80"
