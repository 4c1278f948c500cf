"""Progress on standard error."""

from __future__ import annotations

import sys
import threading
import time
from types import TracebackType
from typing import Self

from pysim.cli.terminal import draws_over

_WIDTH = 30
_COMPILING = "Compiling the solver, once on this machine"
_MOMENT, _TICK, _PAUSE = 0.4, 0.5, 10.0  # s: before the first line, between two on a terminal, and elsewhere


def announce_compilation() -> None:
    """Say why the first run on a machine takes its time."""
    from pysim.simulate import kernel_is_built

    if not kernel_is_built():
        print(f"{_COMPILING} ...", file=sys.stderr)


class Ticking:
    """Says what goes on again and again while a block runs; `_say` writes it to standard error.

    Args:
        first: s until it is said for the first time.
    """

    def __init__(self, title: str, first: float) -> None:
        self._title, self._first = title, first
        self._begun = time.monotonic()
        self._live = draws_over(sys.stderr)
        self._ended = threading.Event()
        self._clock = threading.Thread(target=self._tick, daemon=True)

    def __enter__(self) -> Self:
        self._clock.start()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, where: TracebackType | None
    ) -> None:
        self._ended.set()
        self._clock.join()
        self._end(error)

    def _tick(self) -> None:
        pause = self._first
        while not self._ended.wait(pause):
            self._say()
            pause = _TICK if self._live else _PAUSE

    def _elapsed(self) -> float:
        return time.monotonic() - self._begun

    def _say(self) -> None:
        raise NotImplementedError

    def _end(self, error: BaseException | None) -> None:
        raise NotImplementedError


class Working(Ticking):
    """Says what goes on, and for how long already, once it lasts longer than a moment.

    On a terminal one line is drawn over and taken away at the end; elsewhere there is a line every ten seconds.
    """

    def __init__(self, title: str) -> None:
        super().__init__(title, _MOMENT)
        self._shown = False

    def _say(self) -> None:
        line = f"{self._title} ...{f' {self._elapsed():.0f} s' if self._shown else ''}"
        start, end = ("\r\x1b[K", "") if self._live else ("", "\n")
        print(f"{start}{line}", end=end, file=sys.stderr, flush=True)
        self._shown = True

    def _end(self, error: BaseException | None) -> None:
        if self._shown and self._live:
            print("\r\x1b[K", end="", file=sys.stderr, flush=True)


def simulating() -> Working:
    """What is said while a model runs; the first run on a machine compiles the solver."""
    from pysim.simulate import kernel_is_built

    return Working("Simulating" if kernel_is_built() else _COMPILING)


class ProgressBar:
    """One line that is drawn over; silent where standard error is no terminal, but for its last state."""

    def __init__(self, title: str) -> None:
        self._title = title
        self._drawn = 0.0
        self._started = time.monotonic()
        self._line = ""

    def __call__(self, done: int, total: int) -> None:
        """Show that `done` of `total` runs are finished."""
        share = done / total if total else 1.0
        bar = "#" * round(_WIDTH * share)
        self._line = f"{self._title:<16} [{bar:<{_WIDTH}}] {done}/{total}  {time.monotonic() - self._started:.1f} s"
        now = time.monotonic()
        if sys.stderr.isatty() and (now - self._drawn > 0.1 or done == total):
            self._drawn = now
            print(f"\r{self._line}", end="", file=sys.stderr, flush=True)

    def __enter__(self) -> ProgressBar:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, where: TracebackType | None
    ) -> None:
        if self._line:
            print(f"\r{self._line}" if sys.stderr.isatty() else self._line, file=sys.stderr)
