"""What holds for every test: one store of FMUs, no deadline, and a budget of processor time that is watched.

A test may take 3 s of processor time and a file 15 s, on the computer that `REFERENCE` names and scaled to this one, so
that a slow computer fails nothing. From twice that on the run fails. A test that built an FMU or the solver for
those after it does not count. What needs more is marked `slow`.
"""

import functools
import os
import time
from collections import defaultdict
from collections.abc import Iterator
from pathlib import Path

import pytest
from hypothesis import HealthCheck, settings

ROOT = Path(__file__).parents[1]
STORE = Path(os.environ.setdefault("HTB_CACHE", str(ROOT / "build" / "cache")))  # by content: all workers share it
os.environ.setdefault("NUMBA_CACHE_DIR", str(STORE / "numba"))
os.environ.setdefault("ZIG_GLOBAL_CACHE_DIR", str(STORE / "zig"))  # tests that compile C share what our builds keep
# Before numpy is loaded: the matrices here are small, and threads that wait for each other count as processor time.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

TEST_LIMIT, FILE_LIMIT = 3.0, 15.0  # s of processor time: of a test's call; of all calls and set-ups of a file
ROOM = 2.0  # times the limit from which a test fails: programs that share a core make each other that much slower
REFERENCE = 0.022  # s that `calibration` takes on one core of the server (AMD EPYC) on which the limits were set

settings.register_profile("untimed", deadline=None, suppress_health_check=[HealthCheck.too_slow])
settings.load_profile("untimed")

_before = pytest.StashKey[int]()
_spent: list[pytest.TestReport] = []  # in the process that prints the summary


def new_cache(folder: Path) -> Path:
    """`folder`, made to hold nothing but zig's start-up code, whose compiling takes 5 s of processor time."""
    from fmu_build.cache import cache_folder

    folder.mkdir(mode=0o700)
    (folder / "zig").symlink_to(cache_folder("zig"), target_is_directory=True)
    return folder


def cpu() -> float:
    """Processor time of this process and of the children it has waited for, s."""
    return sum(os.times()[:4])


def calibration() -> float:
    """Processor time of a fixed piece of work, s; the quickest of five, as the rest is other work of this computer."""
    found = []
    for _ in range(5):
        begun = time.process_time()
        sum(k * k % 7 for k in range(400_000))
        found.append(time.process_time() - begun)
    return min(found)


def stored() -> int:
    """How many FMUs and compiled code are stored. Asked twice a test: a folder is read again once it has changed."""
    kinds = {STORE / "fmu": "*.fmu", STORE / "kernel": "*"} | dict.fromkeys(STORE.glob("numba/*"), "*.nb?")
    return sum(entries(place, kind, place.stat().st_mtime_ns) for place, kind in kinds.items() if place.is_dir())


@functools.lru_cache
def entries(place: Path, kind: str, changed_ns: int) -> int:
    return sum(1 for _ in place.glob(kind))


def measured(item: pytest.Item, phase: str) -> Iterator[None]:
    begun = cpu()
    try:
        return (yield)
    finally:
        item.user_properties.append((phase, cpu() - begun))


@pytest.hookimpl(wrapper=True)
def pytest_runtest_setup(item: pytest.Item) -> Iterator[None]:
    item.stash[_before] = stored()
    return (yield from measured(item, "setup"))


@pytest.hookimpl(wrapper=True)
def pytest_runtest_call(item: pytest.Item) -> Iterator[None]:
    return (yield from measured(item, "call"))


@pytest.hookimpl(wrapper=True)
def pytest_runtest_teardown(item: pytest.Item) -> Iterator[None]:
    item.user_properties.append(("built", stored() - item.stash[_before]))
    return (yield)


def pytest_runtest_logreport(report: pytest.TestReport) -> None:
    if report.when == "teardown":
        _spent.append(report)


def over_budget(room: float = 1.0) -> list[str]:
    """Tests and files that take more than `room` times the processor time that they may."""
    scale = room * max(1.0, calibration() / REFERENCE)
    found, files = [], defaultdict(float)
    for report in _spent:
        took = dict(report.user_properties)
        if "slow" in report.keywords or took.get("built"):
            continue
        call = took.get("call", 0.0)
        files[report.nodeid.partition("::")[0]] += call + took.get("setup", 0.0)
        if call > TEST_LIMIT * scale:
            found.append(f"{report.nodeid} takes {call:.1f} s, {TEST_LIMIT:g} s are allowed")
    for file, total in files.items():
        if total > FILE_LIMIT * scale:
            found.append(f"{file} takes {total:.1f} s, {FILE_LIMIT:g} s are allowed")
    return found


@pytest.hookimpl(tryfirst=True)
def pytest_sessionfinish(session: pytest.Session) -> None:
    if not hasattr(session.config, "workerinput") and session.exitstatus == pytest.ExitCode.OK and over_budget(ROOM):
        session.exitstatus = pytest.ExitCode.TESTS_FAILED


def pytest_terminal_summary(terminalreporter: pytest.TerminalReporter) -> None:
    folders: defaultdict[str, list[float]] = defaultdict(list)
    for report in _spent:
        folder = report.nodeid.partition("::")[0].rpartition("/")[0]
        took = dict(report.user_properties)
        folders["/".join(folder.split("/")[:3])].append(took.get("setup", 0.0) + took.get("call", 0.0))
    if len(folders) > 1:
        terminalreporter.section("processor time, s")
        for folder, times in sorted(folders.items(), key=lambda one: -sum(one[1])):
            terminalreporter.line(f"{sum(times):7.1f}  {folder} ({len(times)} tests)")
        terminalreporter.line(f"{sum(sum(times) for times in folders.values()):7.1f}  in all")
    for line in over_budget():
        terminalreporter.line(f"over budget: {line}; make it faster, or mark it slow", red=True)
