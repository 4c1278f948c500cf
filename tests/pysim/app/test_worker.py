"""The process that stays warm: it keeps what it has, ends with all that it has started, and is begun anew."""

import os
import signal
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from pysim.app.worker import Ended, Worker
from pysim.types import BadInput
from tests.pysim.app.alive import PARENT, alive, child
from tests.pysim.app.browser import ROOT
from tests.pysim.app.code_tasks import CODE

_LONG = 60.0  # s


@pytest.fixture
def worker(tmp_path: Path) -> Iterator[Worker]:
    one = Worker(tmp_path, CODE)
    yield one
    one.end()


def test_it_keeps_what_it_has_until_it_is_ended(worker: Worker) -> None:
    assert [worker.ask("count").result(_LONG) for _ in range(3)] == [1, 2, 3]
    first = worker.warm()
    worker.end()
    assert not first.lives
    assert worker.ask("count").result(_LONG) == 1


def test_answers_come_in_order_and_a_refusal_is_one(worker: Worker) -> None:
    asked = [worker.ask("run", code) for code in ("value = 1", "raise BadInput('no; write yes')", "value = 3")]
    with pytest.raises(BadInput, match="no; write yes"):
        asked[1].result(_LONG)
    assert [asked[k].result(_LONG) for k in (0, 2)] == [1, 3]


def test_what_breaks_it_down_is_told_to_all_that_wait_and_the_next_is_answered(worker: Worker) -> None:
    waiting = [worker.ask("run", code) for code in ("import os; os._exit(3)", "value = 1")]
    for one in waiting:
        with pytest.raises(Ended):
            one.result(_LONG)
    assert worker.ask("run", "value = 2").result(_LONG) == 2


def test_it_ends_with_all_that_it_has_started(worker: Worker, tmp_path: Path) -> None:
    waiting = worker.ask("run", PARENT)
    number = child(tmp_path)
    worker.end()
    with pytest.raises(Ended):
        waiting.result(_LONG)
    assert not alive(number)


_SERVER = f"""
import sys, time
from pathlib import Path
from pysim.app.worker import Worker
if __name__ == "__main__":
    worker = Worker(Path(sys.argv[1]), {CODE!r})
    worker.ask("run", {PARENT!r})
    print(worker.warm().pid, flush=True)
    time.sleep(600)
"""


def test_it_does_not_outlive_a_server_that_was_killed(tmp_path: Path) -> None:
    (tmp_path / "server.py").write_text(_SERVER)
    command = [sys.executable, str(tmp_path / "server.py"), str(tmp_path)]
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True, env=environment) as server:
        assert server.stdout is not None
        pid, number = int(server.stdout.readline()), child(tmp_path)
        server.send_signal(signal.SIGKILL)
    assert not alive(pid)
    assert not alive(number)
