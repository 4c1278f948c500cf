"""Answer cases one by one, each in a process of its own, and keep every answer: a run goes on where it was stopped."""

from __future__ import annotations

import multiprocessing
import os
import time
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor, as_completed
from fnmatch import fnmatchcase
from multiprocessing.connection import Connection
from pathlib import Path
from zlib import crc32

from pysim.types import BadInput
from validation.blind.benchmark.answer import Answer, read_answers, write_answer
from validation.blind.plant import Case
from validation.commit import this_commit

Task = Callable[[Case], Answer]

KINDS = ("none", "named", "beyond", "left-out", "pair")
LIMIT = 900.0  # s for one case
_RESULTS = Path(__file__).parents[3] / "results" / "blind-benchmark"
_CONTEXT = multiprocessing.get_context("spawn")
_ONE_THREAD = ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS", "NUMBA_NUM_THREADS")


def choose(
    table: Sequence[Case], *, kinds: Sequence[str] = KINDS, names: str = "*", count: int | None = None
) -> list[Case]:
    """Cases in an order that mixes all kinds by their shares, so that the first of them stand for the whole.

    Args:
        names: pattern of their names, with * and ?.
        count: the first of them; None takes all.
    """
    place: dict[Case, float] = {}
    for kind in kinds:
        own = [case for case in table if case.kind == kind and fnmatchcase(case.name, names)]
        own.sort(key=lambda case: crc32(case.name.encode()))
        place |= {case: (i + 0.5) / len(own) for i, case in enumerate(own)}
    return sorted(place, key=lambda case: place[case])[:count]


def folder_of(commit: str, seed: int) -> Path:
    """Where this commit's answers to the table of that seed are kept."""
    return _RESULTS / commit / f"seed-{seed}"


def answer_cases(
    chosen: Sequence[Case],
    task: Task,
    folder: Path,
    commit: str,
    *,
    workers: int = 2,
    limit: float = LIMIT,
    say: Callable[[str], None] = print,
) -> dict[str, Answer]:
    """Answer what the folder does not hold, and what it holds no verdict of; where files differ from the commit, all.

    Args:
        task: a function of a module, called in processes of their own with one thread each.
        limit: s after which a case is given up.
    Returns:
        case -> answer, of all that the folder holds.
    Raises:
        BadInput: no checkout, or one that changed meanwhile.
    """
    if not commit:
        raise BadInput("answers are kept by commit and this is no checkout of git; clone the repository and run there")
    known = {} if commit.endswith("-dirty") else read_answers(folder)
    waiting = [case for case in chosen if case.name not in known or known[case.name].trouble]
    say(f"{len(waiting)} of {len(chosen)} cases to answer by commit {commit}")
    begun = time.monotonic()
    for done, answer in enumerate(_answers(waiting, task, workers, limit), start=1):
        if this_commit() != commit:
            raise BadInput(f"the checkout is no longer that of {commit}; run the benchmark in a clone of its own")
        write_answer(folder, answer)
        known[answer.case] = answer
        left = (time.monotonic() - begun) / done * (len(waiting) - done) / 60
        found = answer.verdict or answer.trouble
        say(f"{done}/{len(waiting)} {answer.case}: {found}; {answer.wall:.0f} s; {left:.0f} min left")
    return known


def _answers(cases: Sequence[Case], task: Task, workers: int, limit: float) -> Iterator[Answer]:
    """As they come."""
    os.environ.update(dict.fromkeys(_ONE_THREAD, "1"))  # the processes are the parallel part
    pool = ThreadPoolExecutor(workers)
    try:
        for future in as_completed([pool.submit(_alone, task, case, limit) for case in cases]):
            yield future.result()
    finally:
        pool.shutdown(cancel_futures=True)


def _alone(task: Task, case: Case, limit: float) -> Answer:
    """By a new process; if it crashes or takes too long, that costs its case and no more."""
    here, there = _CONTEXT.Pipe(duplex=False)
    process = _CONTEXT.Process(target=_serve, args=(task, case, there), daemon=True)
    process.start()
    there.close()
    try:
        if here.poll(limit):
            answer: Answer = here.recv()
            return answer
        trouble = f"given up after {limit:g} s"
    except EOFError:
        process.join()
        trouble = f"the process ended with {process.exitcode}"
    finally:
        process.kill()
        process.join()
        here.close()
    return Answer(case.name, trouble=trouble)


def _serve(task: Task, case: Case, line: Connection) -> None:
    try:
        answer = task(case)
    except Exception as error:  # whatever it is, it is the case's answer
        answer = Answer(case.name, trouble=f"{type(error).__name__}: {error}"[:300])
    line.send(answer)
