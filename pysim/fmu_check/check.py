"""Check an FMU in worker processes: a crash or a hang of the FMU is a finding, and the next check goes on."""

from __future__ import annotations

import json
import os
import queue
import signal
import subprocess
import sys
import threading
from collections import deque
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path

from pysim.fmu_check.checks import CHECKS
from pysim.fmu_check.result import DOUBTFUL, FAILS, CheckResult
from pysim.fmu_check.subject import read_subject
from pysim.types import BadInput

PATIENCE_S = 120.0  # without an answer of the FMU
_FAREWELL_S = 5.0  # for the last words of a worker that has ended to arrive


@dataclass(frozen=True)
class FmuReport:
    """Everything that was found about one FMU."""

    path: Path
    model: str
    tool: str
    fmi: str
    results: tuple[CheckResult, ...]

    def count(self, verdict: str) -> int:
        """How many results have that verdict."""
        return sum(result.verdict == verdict for result in self.results)

    @property
    def passes(self) -> bool:
        """Whether nothing fails."""
        return self.count(FAILS) == 0


def check_fmu(
    path: Path | str,
    checks: Sequence[str] = tuple(CHECKS),
    *,
    progress: Callable[[int, int], None] | None = None,
    patience: float = PATIENCE_S,
) -> FmuReport:
    """Try an FMU of FMI 2 or 3 as a strict importer would.

    Args:
        checks: their names, of CHECKS.
        progress: receives the checks done and all.
        patience: s that the FMU may take for an answer before its check is stopped; more than a second.
    Returns:
        the results in the order of the checks.
    Raises:
        BadInput: no such file, no FMU, or no check of that name.
    """
    subject = read_subject(Path(path))
    unknown = [name for name in checks if name not in CHECKS]
    if unknown:
        raise BadInput(f"there is no check named {', '.join(unknown)}; there are {', '.join(CHECKS)}")
    results: list[CheckResult] = []
    left = list(checks)
    while left:
        before = len(checks) - len(left)
        done, found = _work(subject.path, left, patience, partial(_tell, progress, checks, before))
        results += found
        left = left[done:]
    _tell(progress, checks, len(checks), 0)
    d = subject.description
    return FmuReport(subject.path, d.modelName, d.generationTool or "", str(d.fmiVersion), tuple(results))


def _tell(progress: Callable[[int, int], None] | None, checks: Sequence[str], before: int, done: int) -> None:
    if progress is not None:
        progress(before + done, len(checks))


def _work(
    path: Path, names: Sequence[str], patience: float, started: Callable[[int], None]
) -> tuple[int, list[CheckResult]]:
    """One worker for these checks; how many are finished with (the one that killed it too), and the results."""
    order = list(CHECKS)
    words = [sys.executable, "-m", "pysim.fmu_check.worker", str(path), *(str(order.index(name)) for name in names)]
    pipe = subprocess.PIPE
    worker = subprocess.Popen(
        words, env=_environment(), stdout=pipe, stderr=pipe, text=True, encoding="utf-8", errors="replace"
    )
    last, listener = _last_words(worker)
    results: list[CheckResult] = []
    count = 0
    for line in _lines(worker, patience):
        data = json.loads(line)
        if "started" in data:
            started(count)
            count += 1
        elif "result" in data:
            results.append(CheckResult(**data["result"]))
        elif "done" in data:
            worker.wait()
            return len(names), results
    hangs = worker.poll() is None
    worker.kill()
    worker.wait()
    if count == 0:
        listener.join(_FAREWELL_S)
        raise BadInput(f"{path} cannot be tried: {last[0].strip() if last else 'the worker ended'}")
    results.append(_death(names[count - 1], worker.returncode, patience if hangs else None))
    return count, results


def _environment() -> dict[str, str]:
    """This process' own, in which the worker finds this package too, installed or not."""
    paths = [str(Path(__file__).resolve().parents[2]), os.environ.get("PYTHONPATH", "")]
    return {**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, paths)), "OPENBLAS_NUM_THREADS": "1"}


def _lines(worker: subprocess.Popen[str], patience: float) -> Iterator[str]:
    """Lines as they come, until the worker ends or says nothing for too long."""
    said: queue.SimpleQueue[str | None] = queue.SimpleQueue()

    def listen() -> None:
        assert worker.stdout is not None
        for line in worker.stdout:
            said.put(line)
        said.put(None)

    threading.Thread(target=listen, daemon=True).start()
    wait: float | None = None  # however long a worker takes to start on a busy PC; the FMU is not called yet
    while True:
        try:
            line, wait = said.get(timeout=wait), patience
        except queue.Empty:
            return
        if line is None:
            worker.wait()
            return
        yield line


def _last_words(worker: subprocess.Popen[str]) -> tuple[deque[str], threading.Thread]:
    """The last line of its standard error, and who listens: a pipe that nobody empties would make the FMU wait."""
    assert worker.stderr is not None
    last: deque[str] = deque(maxlen=1)
    listener = threading.Thread(target=last.extend, args=(filter(str.strip, worker.stderr),), daemon=True)
    listener.start()
    return last, listener


def _death(name: str, code: int, waited: float | None) -> CheckResult:
    check, _, words = name.partition(": ")
    what = f"survives {words or check}"
    if waited is not None:
        return CheckResult(check, what, FAILS, f"the FMU hangs: no answer in {waited:g} s")
    how = signal.Signals(-code).name if code < 0 else f"exit code {code}"
    # FMI calls a forbidden call the user's mistake: an FMU may do anything then, though it had better not
    return CheckResult(check, what, DOUBTFUL if words else FAILS, f"the FMU crashes ({how})")
