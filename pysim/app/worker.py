"""A process of the project's own that stays warm: packages, models and data are kept in it between two questions."""

from __future__ import annotations

import atexit
import contextlib
import multiprocessing
import os
import queue
import sys
import threading
import traceback
from collections.abc import Iterator
from concurrent.futures import Future, InvalidStateError
from importlib import import_module
from multiprocessing.connection import Connection
from pathlib import Path
from typing import Any

from pysim.app.processes import Started, end_all
from pysim.types import BadInput, SimulationError

TASKS = "pysim.app.tasks:Tasks"
_OURS = "this is our mistake: {error}; please report it"


class Ended(Exception):
    """The process ended before it had answered: it was stopped, or it broke down."""


class Worker:
    """Answers one question after the other; where it was ended or broke down, the next question begins it anew.

    Args:
        folder: where it works.
        tasks: module and class, made with the folder; a question is the name of one of its methods.
    """

    def __init__(self, folder: Path, tasks: str = TASKS) -> None:
        self._folder, self._tasks = folder, tasks
        self._process: Any = None
        self._open: dict[int, Future[Any]] = {}
        self._over = threading.Event()  # it has broken down
        self._count = 0

    def warm(self) -> Started:
        """Begin it where it does not run; who it is."""
        if self._over.is_set():
            self.end()
        if self._process is None:
            context = multiprocessing.get_context("spawn")
            self._pipe, theirs = context.Pipe()
            self._process = context.Process(target=_answer, args=(theirs, str(self._folder), self._tasks))
            self._process.start()
            theirs.close()
            self._open, self._over = {}, threading.Event()
            threading.Thread(target=_listen, args=(self._pipe, self._open, self._over), daemon=True).start()
            atexit.register(self.end)  # else Python would wait for it
        return Started.of(self._process.pid)

    def ask(self, task: str, *given: Any) -> Future[Any]:
        """Ask a question.

        Returns:
            its answer, in time; BadInput where it cannot be answered, Ended where the process ended before.
        """
        self.warm()
        self._count += 1
        future = self._open[self._count] = Future()
        try:
            self._pipe.send((self._count, task, given))
        except OSError:
            future.set_exception(Ended())
        return future

    def end(self) -> None:
        """End it with all that it has started, whatever it does."""
        process, self._process = self._process, None
        self._over.clear()
        atexit.unregister(self.end)
        if process is not None:
            end_all(process.pid, hard=True)
            process.kill()  # it may have had no time to begin
            process.join()


def _listen(pipe: Connection, waiting: dict[int, Future[Any]], over: threading.Event) -> None:
    """Hand answers to those who wait for them, until the process ends."""
    with contextlib.suppress(OSError, EOFError):
        while True:
            number, good, value = pipe.recv()
            future = waiting.pop(number)
            with contextlib.suppress(InvalidStateError):  # nobody waits any more
                future.set_result(value) if good else future.set_exception(BadInput(value))
    over.set()
    for future in list(waiting.values()):
        with contextlib.suppress(InvalidStateError):
            future.set_exception(Ended())


def _answer(pipe: Connection, folder: str, tasks: str) -> None:
    """Of the process itself."""
    if sys.platform != "win32":
        os.setsid()
    os.chdir(folder)
    asked: queue.SimpleQueue[tuple[int, str, tuple[Any, ...]]] = queue.SimpleQueue()
    threading.Thread(target=_hear, args=(pipe, asked), daemon=True).start()
    module, _, name = tasks.partition(":")
    own = getattr(import_module(module), name)(Path(folder))
    while True:
        number, task, given = asked.get()
        try:
            good, value = True, getattr(own, task)(*given)
        except (BadInput, SimulationError, OSError) as error:
            good, value = False, str(error)
        except Exception as error:
            traceback.print_exc()
            good, value = False, _OURS.format(error=f"{type(error).__name__}: {error}")
        pipe.send((number, good, value))


def _hear(pipe: Connection, asked: queue.SimpleQueue[Any]) -> None:
    """Take questions; a server that is gone needs no answer."""
    with contextlib.suppress(OSError, EOFError):
        while True:
            asked.put(pipe.recv())
    end_all(os.getpid(), hard=True)
    os._exit(1)


@contextlib.contextmanager
def said_in(path: Path) -> Iterator[None]:
    """All that is printed meanwhile, by libraries and compilers too, goes into a file."""
    sys.stdout.flush(), sys.stderr.flush()
    kept = [os.dup(number) for number in (1, 2)]
    with path.open("wb") as file:
        for number in (1, 2):
            os.dup2(file.fileno(), number)
        try:
            yield
        finally:
            sys.stdout.flush(), sys.stderr.flush()
            for number, before in zip((1, 2), kept, strict=True):
                os.dup2(before, number)
                os.close(before)
