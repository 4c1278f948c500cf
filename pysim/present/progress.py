"""What goes on, shown while it goes on: drawn over on a terminal and in a notebook, by lines elsewhere."""

from __future__ import annotations

import json
import logging
import sys
import threading
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from types import TracebackType
from typing import TYPE_CHECKING, Any, Self

from pysim.types import ErrorStep, ProgressEvent, step_data

if TYPE_CHECKING:
    from pysim.identify.greybox import Tried

Listener = Callable[[ProgressEvent], None]
Progress = Callable[[ProgressEvent], object] | bool | None
LOG = logging.getLogger("pysim")
_COMPILING = "Compiling the solver, once on this machine"
_MOMENT, _TICK, _PAUSE = 0.4, 0.25, 10.0  # s: before anything is said, between two drawings, and between two lines
_WIDTH, _BAR = 30, 24  # letters of a bar
_LEARNED = 4  # last lines kept in sight


def announce_compilation() -> None:
    """Say why the first run on a machine takes its time."""
    from pysim.simulate import kernel_is_built

    if not kernel_is_built():
        print(f"{_COMPILING} ...", file=sys.stderr)


def simulating() -> Working:
    """What is said while a model runs; the first run on a machine compiles the solver."""
    from pysim.simulate import kernel_is_built

    return Working("Simulating" if kernel_is_built() else _COMPILING)


@contextmanager
def showing(progress: Progress, title: str) -> Iterator[Listener]:
    """Take what is being done, and show it.

    Every stage goes to the logger "pysim" as INFO, every result on the way as DEBUG.

    Args:
        progress: True shows it on standard error; None does so where that is a terminal or a notebook; False shows
            nothing; a callable gets every ProgressEvent, and what it raises ends the work.
        title: of the work.
    """
    LOG.info("%s", title)
    if progress is True or (progress is None and is_watched()):
        with Unfolding(title) as shown:
            yield _logged(shown)
    else:
        yield _logged(progress if callable(progress) else lambda event: None)
    LOG.info("%s: done", title)


def is_watched() -> bool:
    """Whether somebody looks: at a terminal, or at a notebook."""
    shell: Any = sys.modules.get("IPython")
    in_notebook = shell is not None and getattr(shell.get_ipython(), "kernel", None) is not None
    return in_notebook or (sys.stderr is not None and sys.stderr.isatty())


def _logged(listener: Callable[[ProgressEvent], object]) -> Listener:
    last = ""

    def heard(event: ProgressEvent) -> None:
        nonlocal last
        if event.stage != last:
            LOG.info("%s", event.stage)
            last = event.stage
        if event.text:
            LOG.debug("%s", event.text)
        listener(event)

    return heard


class Working:
    """Says what goes on, and for how long already, once it lasts longer than a moment.

    Where it is watched it is drawn over, and taken away at the end; elsewhere there is a line every ten seconds.
    """

    stays = False

    def __init__(self, title: str) -> None:
        self._title, self._begun = title, time.monotonic()
        self._watched = is_watched()
        self._ended = threading.Event()
        self._clock = threading.Thread(target=self._draw if self._watched else self._tell, daemon=True)

    def __enter__(self) -> Self:
        self._clock.start()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, where: TracebackType | None
    ) -> None:
        self._end(error)
        self._ended.set()
        self._clock.join()

    def lines(self) -> list[str]:
        """What is shown now."""
        return [f"{self._title} ... {self._elapsed():.0f} s"]

    def _elapsed(self) -> float:
        return time.monotonic() - self._begun

    def _end(self, error: BaseException | None) -> None:
        """The work is over."""

    def _draw(self) -> None:
        """One block, drawn over until the end; lines wider than the terminal are cut."""
        if self._ended.wait(_MOMENT) and not self.stays:
            return
        from rich.console import Console
        from rich.live import Live
        from rich.text import Text

        def block() -> Text:
            return Text("\n".join(self.lines()), no_wrap=True, overflow="crop")

        own = {"auto_refresh": False, "redirect_stdout": False, "redirect_stderr": False}
        with Live(get_renderable=block, console=Console(stderr=True), **own) as live:  # type: ignore[arg-type]
            while not self._ended.wait(_TICK):
                live.refresh()
            live.transient = not self.stays

    def _tell(self) -> None:
        """Lines where nothing can be drawn over."""
        pause = _MOMENT
        while not self._ended.wait(pause):
            print(*self.lines(), file=sys.stderr, flush=True)
            pause = _PAUSE


class ProgressBar(Working):
    """A bar of what is done; its last state stays."""

    def __init__(self, title: str) -> None:
        super().__init__(title)
        self._line = f"{title} ..."

    def __call__(self, done: int, total: int) -> None:
        """Show that `done` of `total` runs are finished."""
        self.stays = True
        bar = "#" * round(_WIDTH * (done / total if total else 1.0))
        self._line = f"{self._title:<16} [{bar:<{_WIDTH}}] {done}/{total}  {self._elapsed():.1f} s"

    def lines(self) -> list[str]:
        """The bar."""
        return [self._line]

    def _tell(self) -> None:
        self._ended.wait()
        if self.stays:
            print(self._line, file=sys.stderr, flush=True)


class Searching(Working):
    """A search for parameters: its points, and the least cost so far."""

    stays = True

    def __call__(self, tried: Tried) -> None:
        """Show where it is."""
        self._title = f"{tried.search}: point {tried.tried}, cost {tried.best:.6g}"


class Unfolding(Working):
    """A search as it unfolds: stage and time, the error falling, what came out; elsewhere a line for each event."""

    stays = True

    def __init__(self, title: str) -> None:
        super().__init__(title)
        self._stage = ""
        self._learned: list[str] = []
        self._steps: list[ErrorStep] = []
        self._lock = threading.Lock()

    def __call__(self, event: ProgressEvent) -> None:
        """Show it."""
        with self._lock:
            self._stage = event.stage
            if event.trial is not None:
                self._stage += f": {' + '.join(event.trial.names)} {event.trial.error:.4g} x noise"
            if event.step is not None:
                self._steps.append(event.step)
            elif event.text:
                self._learned = [*self._learned, event.text][-_LEARNED:]
        if not self._watched and event.trial is None:
            print(f"{self._elapsed():6.1f} s  {event}", file=sys.stderr, flush=True)

    def lines(self) -> list[str]:
        """The block."""
        with self._lock:
            return block(self._title, self._stage, self._elapsed(), self._steps, self._learned)

    def _end(self, error: BaseException | None) -> None:
        self._stage = "stopped" if error else "done"

    def _tell(self) -> None:
        """Each event has its line already."""


def block(title: str, stage: str, elapsed: float, steps: Sequence[ErrorStep], learned: Sequence[str]) -> list[str]:
    """Lines of the block: title and time, stage, a row per step with the error as a bar, what was learned."""
    lines = [title, f"  {int(elapsed) // 60}:{int(elapsed) % 60:02d}  {stage}", *_bars(steps)]
    return [*lines, *(f"  - {text}" for text in learned)]


def _bars(steps: Sequence[ErrorStep]) -> list[str]:
    """The residual over noise falling; a bar's length is its logarithm, so noise alone has none."""
    from math import log

    from pysim.present.diagnosis.words import step_name
    from pysim.present.notes import USES

    values = [step.fit if step.fit is not None else step.validate or 1.0 for step in steps]
    top = log(max([2.0, *values]))
    lines = []
    for step, value in zip(steps, values, strict=True):
        held = "" if step.validate is None or step.fit is None else f"  {USES['validate']} {step.validate:7.2f}"
        bar = "#" * round(_BAR * max(0.0, log(max(value, 1e-9))) / top)
        lines.append(f"  {step_name(step.step):<24} {value:7.2f} {bar:<{_BAR}}{held}".rstrip())
    return [f"  {'residual over noise':<24}", *lines] if lines else []


class EventFile:
    """Progress as lines of JSON that another program can follow.

    Each has `seconds` since the begin, `stage`, `text`, `step` of the error history (or null), and `trial`: a point of
    a search with `names`, `error` and `values` (or null).
    """

    def __init__(self, path: Path) -> None:
        self._path, self._begun = path, time.monotonic()
        path.write_text("", encoding="utf-8")

    def __call__(self, event: ProgressEvent) -> None:
        """Write one line at once, so that a reader sees it whole or not at all."""
        elapsed = time.monotonic() - self._begun
        step = None if event.step is None else step_data(event.step)
        line = {"seconds": round(elapsed, 3), "stage": event.stage, "text": event.text, "step": step, "trial": None}
        if (trial := event.trial) is not None:
            line["trial"] = {"names": trial.names, "error": trial.error, "values": dict(trial.values)}
        with self._path.open("a", encoding="utf-8") as file:
            file.write(json.dumps(line) + "\n")
