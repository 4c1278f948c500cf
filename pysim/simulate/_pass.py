"""A pass: threads that share tasks, one call of the kernel each, which leave the interpreter alone."""

from __future__ import annotations

import threading
from collections.abc import Callable, Sequence

import numpy as np

from pysim.simulate._foreign import ForeignLibrary, Opened
from pysim.simulate._found import Found
from pysim.simulate._library import Library
from pysim.simulate._pool import Stopped
from pysim.simulate._request import Kind, Request
from pysim.simulate._tasks import Tasks
from pysim.simulate.kernel.layout import PASS
from pysim.simulate.kernel.library import address, kernel

Progress = Callable[[int, int], None]

_NAP, _GLANCE = 0.2, 0.02  # s between two looks at what goes on: on Windows no interrupt ends a wait without a limit


def run_tasks(
    library: Opened,
    kind: Kind,
    requests: Sequence[Request],
    *,
    workers: int = 1,
    progress: Progress | None = None,
    stopped: Stopped = lambda: False,
) -> list[Found]:
    """Run requests of one kind in threads; what recorded variables and set values are, may differ from one to another.

    Args:
        workers: threads, each with an instance of its own.
        progress: called with (done, in all) from the calling thread; what it raises stops everything, as does an
            interrupt from the keyboard. Runs with derivatives and orbits count where they came to their end.
        stopped: asked now and then.
    """
    if not requests:
        return []
    if isinstance(library, ForeignLibrary):
        answers = library.run(kind, requests, workers, progress, stopped)
        return [Found(*answer) for answer in answers]
    groups: dict[tuple[tuple[str, ...], tuple[str, ...]], list[int]] = {}
    for number, request in enumerate(requests):
        key = request.experiment.record, tuple(request.experiment.overrides)
        groups.setdefault(key, []).append(number)
    found: dict[int, Found] = {}
    shown = 0
    for numbers in groups.values():
        tasks = Tasks(library.model, kind, [requests[number] for number in numbers], library.packs)
        shown += _Crew(library, tasks, workers, later(progress, shown, len(requests)), stopped).run()
        tasks.let_go()
        found |= {number: Found(tasks, place) for place, number in enumerate(numbers)}
    return [found[number] for number in range(len(requests))]


def later(progress: Progress | None, before: int, total: int) -> Progress | None:
    """Progress of a part of the work, behind another part."""
    return None if progress is None else lambda done, _: progress(before + done, total)


class _Crew:
    """Threads that share the tasks, watched by the thread that called."""

    def __init__(
        self, library: Library, tasks: Tasks, workers: int, progress: Progress | None, stopped: Stopped
    ) -> None:
        self._library, self._tasks, self._progress, self._stopped = library, tasks, progress, stopped
        self._pass = np.zeros(1, dtype=PASS)
        self._pass["tasks"], self._pass["count"] = address(tasks.table), tasks.table.size
        self._error: BaseException | None = None
        self._shown = 0
        count = max(1, min(workers, tasks.table.size))
        self._threads = [threading.Thread(target=self._work, daemon=True) for _ in range(count)]

    def _work(self) -> None:
        try:
            while self._pass["next"][0] < self._pass["count"][0] and not self._pass["stop"][0]:
                with self._library.lent() as instance:
                    kernel().work(self._pass, self._tasks.prepare(instance).record)
        except BaseException as error:
            self._error = error
            self._pass["stop"] = 1

    def run(self) -> int:
        """All tasks, or as many as are done when somebody stops them; how many counted as done."""
        for thread in self._threads:
            thread.start()
        try:
            for thread in self._threads:
                while thread.is_alive():
                    thread.join(_GLANCE if self._progress is not None else _NAP)
                    self._look()
            self._look()
        except BaseException:
            self._pass["stop"] = 1
            raise
        finally:
            for thread in self._threads:
                thread.join()
        error = self._error or self._tasks.error
        if error is not None:
            raise error
        return self._shown

    def _look(self) -> None:
        if not self._pass["stop"][0] and (self._tasks.error is not None or self._stopped()):
            self._pass["stop"] = 1
        done = int(self._pass["done"][0])
        while self._progress is not None and self._shown < done:
            self._shown += 1
            self._progress(self._shown, self._tasks.table.size)
