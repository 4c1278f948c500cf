"""A progress bar on standard error."""

from __future__ import annotations

import sys
import time
from types import TracebackType

_WIDTH = 30


def announce_compilation() -> None:
    """Say why the first run on a machine takes its time."""
    from pysim.simulate import is_compiled

    if not is_compiled():
        print("Compiling the simulation loop, once on this machine, some 15 s ...", file=sys.stderr)


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
