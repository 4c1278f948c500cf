"""When a process began, on every system: the same for as long as it runs, and nothing once it has ended."""

import os
import shutil
import subprocess
import sys
from collections.abc import Callable

import pytest

from pysim.app import began as module
from pysim.app.began import began

WAYS = [
    began,
    pytest.param(module._by_ps, marks=pytest.mark.skipif(shutil.which("ps") is None, reason="there is no ps here")),
]


@pytest.mark.parametrize("way", WAYS)
def test_it_stays_the_same_and_is_gone_with_the_process(way: Callable[[int], str]) -> None:
    own = way(os.getpid())
    with subprocess.Popen([sys.executable, "-c", "input()"], stdin=subprocess.PIPE) as process:
        first = way(process.pid)
        assert first
        assert (way(process.pid), way(os.getpid())) == (first, own)
        process.kill()
        os.waitid(os.P_PID, process.pid, os.WEXITED | os.WNOWAIT)
        assert way(process.pid) == ""  # it has ended, though nobody has asked how
    assert way(process.pid) == ""


def test_two_processes_have_two_beginnings() -> None:
    with subprocess.Popen([sys.executable, "-c", "input()"], stdin=subprocess.PIPE) as process:
        assert began(process.pid) != began(os.getpid())
        process.kill()
