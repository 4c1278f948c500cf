"""What a benchmark gives back, and how two things are timed in turn."""

from __future__ import annotations

import os
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from statistics import median

_STAT = Path("/proc/stat")


@dataclass(frozen=True)
class Measurement:
    """One number beside its aim.

    Args:
        what: what was measured, with the numbers behind it.
        value: in `unit`; a ratio has none.
        aim: at most; None where the number only stands beside another one.
        skipped: why it could not be measured here; empty where it was.
    """

    what: str
    value: float
    aim: float | None = None
    unit: str = ""
    skipped: str = ""


@dataclass(frozen=True)
class Timed:
    """What one call took.

    Args:
        cpu: s of this process, all its threads together.
        wall: s by the clock.
        others: processor seconds that other processes took in that time; not a number where the system does not say.
    """

    cpu: float
    wall: float
    others: float


def timed(call: Callable[[], object]) -> Timed:
    """Call it and take the time."""
    busy, started, used = _busy(), time.perf_counter(), _cpu()
    call()
    cpu, wall = _cpu() - used, time.perf_counter() - started
    return Timed(cpu, wall, max(0.0, _busy() - busy - cpu))


def in_turn(one: Callable[[], object], other: Callable[[], object], pairs: int) -> list[tuple[Timed, Timed]]:
    """Both of them, pair by pair, so that what else the machine does falls on both alike."""
    return [(timed(one), timed(other)) for _ in range(pairs)]


def ratio(pairs: list[tuple[Timed, Timed]], clock: str) -> float:
    """Median over the pairs of one over the other, by `clock`: "cpu" or "wall"."""
    return median(getattr(one, clock) / getattr(other, clock) for one, other in pairs)


def middle(times: list[Timed], clock: str) -> float:
    """Median, s."""
    return median(getattr(one, clock) for one in times)


def load(times: list[Timed]) -> str:
    """What others did meanwhile, for the reader of wall times."""
    share = sum(t.others for t in times) / sum(t.wall for t in times)
    return f"other processes took {share:.2f} of {os.cpu_count()} cores"


def times_of(pairs: list[tuple[Timed, Timed]]) -> Iterator[Timed]:
    """All of them, one after the other."""
    for pair in pairs:
        yield from pair


def _cpu() -> float:
    """s of this process and of those it started that have ended."""
    return sum(os.times()[:4])


def _busy() -> float:
    """s that all processors together worked since the system started, in user and system mode."""
    if not _STAT.is_file():
        return float("nan")
    user, nice, system, _, _, irq, softirq, *_ = (int(n) for n in _STAT.read_text().split("\n", 1)[0].split()[1:])
    return float(user + nice + system + irq + softirq) / os.sysconf("SC_CLK_TCK")
