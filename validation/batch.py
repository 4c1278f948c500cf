"""Many cases answered one by one, a line of JSON each, kept by commit; a batch that was stopped goes on."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from threading import Lock
from typing import Any

from fmu_build.version import this_commit
from pysim.types import BadInput

_ROOT = Path(__file__).parents[1]
_THREADS = ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS", "NUMBA_NUM_THREADS")

Line = Mapping[str, Any]  # "case": its name; "trouble": why there is no answer, where there is none


def file_of(batch: str) -> Path:
    """Where this commit's lines are kept."""
    return _ROOT / "results" / batch / f"{this_commit()}.jsonl"


def answered(
    module: str,
    names: Sequence[str],
    file: Path,
    *,
    workers: int | None = None,
    limit: int = 3600,
    together: int = 1,
    say: Callable[[Line], str] = str,
) -> list[Line]:
    """Answer the cases that the file does not answer yet.

    Args:
        module: its main part calls `serve`.
        file: a line for each case; started anew where the checkout differs from its commit.
        workers: processes at a time, of one thread each; no more than there are cores, which is what None takes.
        limit: s of wall time after which a case is given up.
        together: cases that one process answers, so that what it compiles and loads serves them all.
        say: what is printed of a line.
    Returns:
        the last line of each case of `names` that has one, in their order.
    Raises:
        BadInput: no checkout, or one that changed meanwhile.
    """
    commit = this_commit()
    if not commit:
        raise BadInput("answers are kept by commit and this is no checkout of git; clone the repository and run there")
    file.parent.mkdir(parents=True, exist_ok=True)
    if commit.endswith("-dirty"):
        file.unlink(missing_ok=True)
    known = read_lines(file)
    waiting = [name for name in names if name not in known or known[name].get("trouble")]
    print(f"{len(waiting)} of {len(names)} cases to answer by commit {commit}", flush=True)
    begun, done, lock = time.monotonic(), 0, Lock()

    def work(some: Sequence[str]) -> None:
        nonlocal done
        for line in _asked(module, some, limit):
            with lock:
                if this_commit() != commit:
                    raise BadInput(f"the checkout is no longer that of {commit}; run the batch in a clone of its own")
                with file.open("a", encoding="utf-8", newline="\n") as kept:
                    kept.write(json.dumps(line) + "\n")
                known[line["case"]], done = line, done + 1
                left = (time.monotonic() - begun) / done * (len(waiting) - done) / 60
                print(f"{done}/{len(waiting)} {say(line)}; {left:.0f} min left", flush=True)

    cores = os.cpu_count() or 1
    with ThreadPoolExecutor(min(workers or cores, cores)) as pool:
        jobs = [pool.submit(work, waiting[k : k + together]) for k in range(0, len(waiting), together)]
        try:
            for job in jobs:
                job.result()
        except BaseException:
            pool.shutdown(cancel_futures=True)
            raise
    return [known[name] for name in names if name in known]


def read_lines(file: Path) -> dict[str, Line]:
    """Case -> its last line; none where there is no file."""
    text = file.read_text(encoding="utf-8") if file.is_file() else ""
    return {line["case"]: line for line in map(json.loads, text.splitlines())}


def serve(answer: Callable[[str], Line], argv: Sequence[str]) -> None:
    """Answer the cases that are named behind a limit in seconds, in this process, a line of JSON each."""
    limit, *names = argv
    for name in names:
        if hasattr(signal, "alarm"):
            signal.alarm(int(limit))  # ends the process, whatever it is in
        try:
            line = answer(name)
        except Exception as error:  # whatever it is, it is the case's answer
            line = {"trouble": f"{type(error).__name__}: {error}"[:300]}
        print(json.dumps({"case": name, **line}), flush=True)


def _asked(module: str, names: Sequence[str], limit: int) -> Iterator[Line]:
    """Lines of a process; one that crashes or takes too long costs its case and no more."""
    left = list(names)
    while left:
        words = [sys.executable, "-m", module, str(limit), *left]
        one_thread = {**os.environ, **dict.fromkeys(_THREADS, "1")}
        with subprocess.Popen(words, cwd=_ROOT, env=one_thread, stdout=subprocess.PIPE, text=True) as process:
            assert process.stdout is not None
            try:
                for text in process.stdout:
                    if text.startswith("{"):
                        line = json.loads(text)
                        left.remove(line["case"])
                        yield line
            finally:
                process.kill()
        if left:
            yield {"case": left.pop(0), "trouble": f"the process ended with {process.returncode}"}
