"""FMUs of others, in worker processes: one that crashes or never answers ends its run, and nothing else."""

from __future__ import annotations

import math
import os
import pickle
import subprocess
import sys
import threading
import time
from collections import deque
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import replace
from functools import lru_cache
from typing import Any

from pysim.io import check_binary, extracted
from pysim.simulate._library import Library, open_library
from pysim.simulate._pool import Stopped
from pysim.simulate._request import Kind, Request
from pysim.simulate._tasks import Tasks
from pysim.simulate.kernel.functions import MATRICES
from pysim.simulate.kernel.layout import MODEL_ERROR, PART_CRASHED, PART_SILENT, RUNNING
from pysim.simulate.kernel.signals import Packs
from pysim.types import BadInput, Model

LONGEST, LOADING = 3600.0, 600.0  # s of one question, and of loading: an FMU that takes longer never answers
_AT_ONCE, _SHARES = 16, 4  # requests in a question at most; questions per worker at least, for none to wait long
_GLANCE = 0.02  # s between two looks at the workers
Answer = tuple[Tasks, int]  # and the place of the request in it
_idle: deque[Worker] = deque()  # processes that wait for work; they end with this one


class Lost(RuntimeError):
    """A worker process ended before it answered; `silent` where it was ended, having taken too long."""

    def __init__(self, silent: bool) -> None:
        super().__init__("the worker process ended")
        self.silent = silent


class Worker:
    """A process that opens models and runs requests, one after the other."""

    def __init__(self) -> None:
        paths = os.pathsep.join(path for path in sys.path if path)
        self._process = subprocess.Popen(
            [sys.executable, "-m", "pysim.simulate._worker"],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            env={**os.environ, "PYTHONPATH": paths},
        )
        self.model: Model | None = None
        self.until = math.inf  # when the question that is not answered yet has taken too long
        self.silent = False

    def ask(self, question: Any, limit: float) -> Any:
        """Its answer, which may take so long (s).

        Raises:
            Lost: there is none.
            BadInput: the worker's own, as of `open_library`.
        """
        out, back = self._process.stdin, self._process.stdout
        assert out is not None
        assert back is not None
        packed = pickle.dumps(question, protocol=5)
        self.until = time.monotonic() + limit
        try:
            out.write(packed)
            out.flush()
            answer = pickle.load(back)
        except (OSError, EOFError, ValueError, pickle.UnpicklingError) as error:  # ended, by itself or by `end`
            self.end()
            raise Lost(self.silent) from error
        finally:
            self.until = math.inf
        if isinstance(answer, BaseException):
            raise answer
        return answer

    @property
    def is_alive(self) -> bool:
        """Whether it can be asked."""
        return self._process.poll() is None

    def open(self, model: Model) -> None:
        """Load a model's library, unless it is the one that is loaded. Raises as `ask`."""
        if self.model is not model:
            self.ask(model, LOADING)
            self.model = model

    def end(self) -> None:
        """End the process, whatever it does."""
        self._process.kill()
        self._process.wait()
        for pipe in (self._process.stdin, self._process.stdout):
            if pipe is not None:
                try:
                    pipe.close()
                except OSError:  # what was not yet written has no reader any more
                    continue


class ForeignLibrary:
    """A model of others. Its library is loaded in worker processes alone."""

    def __init__(self, model: Model) -> None:
        self.model = model
        self.known: dict[Any, Any] = {}  # what was found out about the FMU and need not be asked again

    def run(
        self,
        kind: Kind,
        requests: Sequence[Request],
        workers: int,
        progress: Callable[[int, int], None] | None,
        stopped: Stopped,
    ) -> list[Answer]:
        """As `run_tasks`: where what was found for each request stands."""
        crew = _Crew(self.model, kind.plain(), [replace(one, take=None) for one in requests], stopped)
        return crew.run(min(workers, len(requests)), progress)


Opened = Library | ForeignLibrary


class _Crew:
    """Threads that each hold a worker process and hand it request after request."""

    def __init__(self, model: Model, kind: Kind, requests: Sequence[Request], stopped: Stopped) -> None:
        self._model, self._kind, self._stopped = model, kind, stopped
        self._requests = list(requests)
        self._left: deque[list[int]] = deque()
        self._found: dict[int, Answer] = {}
        self._busy: set[Worker] = set()
        self._stop, self._errors = False, list[BaseException]()

    def run(self, count: int, progress: Callable[[int, int], None] | None) -> list[Answer]:
        """All requests; those that were stopped are answered as such."""
        total = len(self._requests)
        size = max(1, min(_AT_ONCE, total // (_SHARES * count)))
        self._left.extend([*range(first, min(first + size, total))] for first in range(0, total, size))
        threads = [threading.Thread(target=self._work, daemon=True) for _ in range(count)]
        for thread in threads:
            thread.start()
        try:
            shown = 0
            for thread in threads:
                while thread.is_alive():
                    thread.join(_GLANCE)
                    self._watch()
                    shown = self._report(progress, shown)
        except BaseException:
            self._end_all()
            raise
        finally:
            for thread in threads:
                thread.join()
        if self._errors:
            raise self._errors[0]
        return [self._found.get(number) or self._without(number, RUNNING) for number in range(total)]

    def _report(self, progress: Callable[[int, int], None] | None, shown: int) -> int:
        done = sum(tasks.counts(place) for tasks, place in list(self._found.values()))
        while progress is not None and shown < done:
            shown += 1
            progress(shown, len(self._requests))
        return shown

    def _watch(self) -> None:
        if not self._stop and self._stopped():
            self._end_all()
        for worker in list(self._busy):
            if time.monotonic() > worker.until:
                worker.silent = True
                worker.end()

    def _end_all(self) -> None:
        self._stop = True
        for worker in list(self._busy):
            worker.end()

    def _work(self) -> None:
        worker: Worker | None = None
        try:
            while self._left and not self._stop:
                try:
                    numbers = self._left.popleft()
                except IndexError:
                    break
                worker = worker or _take()
                self._busy.add(worker)
                try:
                    worker.open(self._model)
                    answers = worker.ask((self._kind, [self._requests[number] for number in numbers]), LONGEST)
                    self._found |= zip(numbers, answers, strict=True)
                except Lost as lost:
                    self._busy.discard(worker)
                    worker = None
                    if len(numbers) > 1:  # one by one, to find the culprit
                        self._left.extendleft([number] for number in reversed(numbers))
                    elif not self._stop:
                        part = PART_SILENT if lost.silent else PART_CRASHED
                        self._found[numbers[0]] = self._without(numbers[0], MODEL_ERROR, part)
        except BaseException as error:
            self._errors.append(error)
            self._stop = True
        finally:
            if worker is not None:
                self._busy.discard(worker)
                _idle.append(worker)

    def _without(self, number: int, code: int, part: int = 0) -> Answer:
        """Stands for an answer that nobody gave."""
        tasks = Tasks(self._model, self._kind, [self._requests[number]], Packs())
        tasks.table["code"], tasks.table["part"] = code, part
        return tasks, 0


def _take() -> Worker:
    """A worker that is alive."""
    while True:
        try:
            worker = _idle.pop()
        except IndexError:
            return Worker()
        if worker.is_alive:
            return worker


@contextmanager
def open_model(model: Model) -> Iterator[Opened]:
    """A model for the length of the block: one of ours in this process, one of others in processes of its own.

    Raises:
        BadInput: no model exchange, no binary for this machine, or an FMU that cannot be loaded or instantiated.
    """
    if is_ours(model):
        with open_library(model) as library:
            yield library
        return
    worker = _take()
    try:
        worker.open(model)
    except Lost as lost:
        raise BadInput(f"{model.label}: the FMU ended its process as it was loaded; export it again") from lost
    finally:
        _idle.append(worker)
    yield ForeignLibrary(model)


def is_ours(model: Model) -> bool:
    """Whether fmu_build made the FMU: its library offers more than the standard asks for.

    Raises:
        BadInput: no model exchange, or no binary for this machine.
    """
    if not model.abilities.model_exchange:
        raise BadInput(f"{model.label} is for co-simulation only; export it for model exchange as well")
    check_binary(model, model.abilities.library)
    return _offers_matrices(str(extracted(model.path)), model.abilities.library)


@lru_cache(maxsize=256)
def _offers_matrices(folder: str, library: str) -> bool:
    files = [os.path.join(root, name) for root, _, names in os.walk(os.path.join(folder, "binaries")) for name in names]
    own = [file for file in files if os.path.splitext(os.path.basename(file))[0] == library]
    return any(MATRICES.encode() in _content(file) for file in own)


def _content(file: str) -> bytes:
    with open(file, "rb") as opened:
        return opened.read()
