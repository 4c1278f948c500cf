"""How many threads of a process could run at a time, watched by another process: what a machine without load gives.

`python -m validation.benchmarks.runnable PID` watches until its input ends, then prints two numbers of seconds: the
processor time of the process, and the time by the clock that it takes where two cores are free. Linux only.
"""

from __future__ import annotations

import contextlib
import select
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path

CORES = 2
_LOOK = 0.2  # s between two looks: the system counts a wait once it is over, some milliseconds late


class Watched:
    """What was seen once the watch is over: CPU seconds, and seconds on free cores."""

    cpu = free = float("nan")


@contextlib.contextmanager
def watched(pid: int) -> Iterator[Watched]:
    """Watch a process from the start to the end of a block."""
    words = [sys.executable, "-m", "validation.benchmarks.runnable", str(pid)]
    seen = Watched()
    with subprocess.Popen(words, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as watcher:
        assert watcher.stdout is not None
        watcher.stdout.readline()  # it has begun
        yield seen
        answer, _ = watcher.communicate()
    seen.cpu, seen.free = (float(word) for word in answer.split())


def on_free_cores(cpu: float, waited: float, interval: float) -> float:
    """What `cpu` seconds, done in an interval in which threads waited for a core as well, take where cores are free.

    Threads that ran or waited could have run side by side: so many at a time, on average over the interval.
    """
    at_a_time = (cpu + waited) / interval
    return cpu / min(max(at_a_time, 1.0), CORES)


def _times(tasks: Path) -> dict[str, tuple[float, float]]:
    """By thread, s that it ran and s that it waited for a core."""
    found = {}
    for task in tasks.iterdir():
        with contextlib.suppress(OSError):  # it has ended
            ran, waited, _ = (task / "schedstat").read_text().split()
            found[task.name] = 1e-9 * int(ran), 1e-9 * int(waited)
    return found


def main(pid: int) -> None:
    """Watch until the input ends."""
    tasks, cpu, free = Path(f"/proc/{pid}/task"), 0.0, 0.0
    before, at, ended = _times(tasks), time.perf_counter(), False
    print("begun", flush=True)
    while not ended:
        ended = bool(select.select([sys.stdin], [], [], _LOOK)[0])
        now, then = _times(tasks), time.perf_counter()
        changes = [(a - b, c - d) for (a, c), (b, d) in ((now[k], before.get(k, (0.0, 0.0))) for k in now)]
        ran, waited = (sum(column) for column in zip(*changes, strict=True))
        cpu, free = cpu + ran, free + on_free_cores(ran, waited, then - at)
        before, at = now, then
    print(cpu, free, flush=True)


if __name__ == "__main__":
    main(int(sys.argv[1]))
