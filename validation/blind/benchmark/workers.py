"""Processes that answer one case after the other; one that hangs or crashes costs its case and no more."""

from __future__ import annotations

import multiprocessing
import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from multiprocessing.connection import Connection, wait
from multiprocessing.context import SpawnProcess

from validation.blind.benchmark.answer import Answer
from validation.blind.plant import Case

Task = Callable[[Case], Answer]

_CONTEXT = multiprocessing.get_context("spawn")
_RENEWED_AFTER = 60  # cases, lest something piles up
_START = 120.0  # s that a process may take to begin with its first case


@dataclass
class _Worker:
    """One process and what it is at."""

    process: SpawnProcess
    line: Connection
    case: Case
    begun: float = field(default_factory=lambda: time.monotonic() + _START)
    started: bool = False
    answered: int = 0

    def give(self, case: Case) -> None:
        self.case, self.begun = case, time.monotonic()
        self.line.send(case)

    def begins(self) -> bool:
        """Whether it has just said that it begins, which is taken note of; once."""
        if self.started or not self.line.poll():
            return False
        self.started, self.begun = True, time.monotonic()
        try:
            return self.line.recv() is None
        except EOFError:
            return False

    def end(self) -> None:
        self.process.kill()
        self.process.join()
        self.line.close()


def answers(
    cases: Sequence[Case], task: Task, blank: Answer, *, workers: int, limit: float
) -> Iterator[tuple[Case, Answer]]:
    """Each case with its answer, as they come.

    Args:
        task: a function of a module, called in processes of their own.
        blank: what an answer without a verdict looks like.
        workers: processes at a time.
        limit: s after which a case is given up.
    """
    waiting = list(reversed(cases))
    busy: list[_Worker] = []
    try:
        while waiting or busy:
            while waiting and len(busy) < workers:
                busy.append(_started(task, waiting.pop()))
            for worker in _ready(busy, limit):
                if worker.begins():
                    continue
                answer = _received(worker, blank, limit)
                yield worker.case, answer
                worker.answered += 1
                if not waiting or not worker.process.is_alive() or worker.answered >= _RENEWED_AFTER:
                    worker.end()
                    busy.remove(worker)
                else:
                    worker.give(waiting.pop())
    finally:
        for worker in busy:
            worker.end()


def _started(task: Task, case: Case) -> _Worker:
    here, there = _CONTEXT.Pipe()
    process = _CONTEXT.Process(target=_serve, args=(task, there), daemon=True)
    process.start()
    there.close()
    here.send(case)
    return _Worker(process, here, case)


def _ready(busy: Sequence[_Worker], limit: float) -> list[_Worker]:
    """Those that have said something, died, or taken too long."""
    first = min(worker.begun for worker in busy) + limit - time.monotonic()
    heard = wait([worker.line for worker in busy], timeout=max(first, 0.0))
    late = time.monotonic() - limit
    return [worker for worker in busy if worker.line in heard or worker.begun <= late]


def _received(worker: _Worker, blank: Answer, limit: float) -> Answer:
    try:
        answer: Answer = worker.line.recv() if worker.line.poll() else blank
    except EOFError:
        worker.process.join()
        trouble = f"the process ended with {worker.process.exitcode}"
        return replace(blank, case=worker.case.name, trouble=trouble)
    if answer is blank:
        worker.process.kill()
        worker.process.join()
        return replace(blank, case=worker.case.name, trouble=f"given up after {limit:g} s")
    return replace(blank, case=worker.case.name, trouble=answer.trouble) if answer.trouble else answer


def _serve(task: Task, line: Connection) -> None:
    """In the process: say that it begins, and answer until nobody asks any more."""
    line.send(None)
    while True:
        try:
            case = line.recv()
        except EOFError:
            return
        try:
            answer = task(case)
        except Exception as error:  # whatever it is, it is the case's answer
            answer = Answer(case.name, "", "", trouble=f"{type(error).__name__}: {error}"[:300])
        line.send(answer)
