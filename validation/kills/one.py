"""`python -m validation.kills.one LIMIT CASE ...`: a kill each, as lines of JSON; `fit-3`: a fit, seed 3."""

from __future__ import annotations

import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np

from validation.batch import Line, serve
from validation.kills.subjects import SUBJECTS, Subject

_ROOT = Path(__file__).resolve().parents[2]
_SOONER = 0.7  # of the moment, where the work had ended before it


def answer(case: str) -> Line:
    """Kill the work once, do it again, and compare with what an undisturbed run leaves.

    Returns:
        "moment" in s, "same" whether the results are, "half" what was half written when it was killed.
    """
    name, _, seed = case.rpartition("-")
    subject, (taken, expected) = SUBJECTS[name], undisturbed(name)
    random = np.random.default_rng(int(seed))
    moment, child = taken * float(random.random()), bool(random.integers(2))
    with tempfile.TemporaryDirectory(prefix="kills-", ignore_cleanup_errors=True) as place:
        while not killed(subject, _new(subject, Path(place)), moment, child=child):
            moment *= _SOONER
        folder = Path(place) / "work"
        half = subject.spoiled(folder)
        code = _begun(subject, folder).wait()
        said = (folder / "said.txt").read_text(encoding="utf-8", errors="replace")
        same = code in (0, 1) and "Traceback" not in said and subject.result(folder) == expected
    return {
        "moment": moment,
        "of": taken,
        "same": same,
        "half": half,
        "code": code,
        "said": "" if same else said[-300:],
    }


@cache
def undisturbed(name: str) -> tuple[float, Any]:
    """s that the work takes by itself, and its result; a run before it has filled the caches that stay."""
    subject = SUBJECTS[name]
    with tempfile.TemporaryDirectory(prefix="kills-", ignore_cleanup_errors=True) as place:
        for _ in range(2):
            folder, begun = _new(subject, Path(place)), time.monotonic()
            _begun(subject, folder).wait()
            taken = time.monotonic() - begun
        return taken, subject.result(folder)


def killed(subject: Subject, folder: Path, moment: float, *, child: bool) -> bool:
    """Begin the work and kill it, or what it has begun by then; False where it had ended by itself."""
    process = _begun(subject, folder)
    try:
        process.wait(moment)
    except subprocess.TimeoutExpired:
        begun = subject.also_child(folder) if child and subject.also_child else 0
        os.kill(begun or process.pid, signal.SIGKILL)
        return process.wait() == -signal.SIGKILL or bool(begun)  # a server sees the end of its job, and ends
    return False


def _new(subject: Subject, place: Path) -> Path:
    """The folder of the work as it is before its first run."""
    folder = place / "work"
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir()
    subject.prepare(folder)
    return folder


def _begun(subject: Subject, folder: Path) -> subprocess.Popen[bytes]:
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join([str(_ROOT), os.environ.get("PYTHONPATH", "")])}
    if subject.cold:
        environment["HTB_CACHE"] = str(folder / "cache")
    with (folder / "said.txt").open("wb") as said:
        words = [sys.executable, "-m", *subject.words]
        return subprocess.Popen(words, cwd=folder, env=environment, stdout=said, stderr=subprocess.STDOUT)


if __name__ == "__main__":
    serve(answer, sys.argv[1:])
