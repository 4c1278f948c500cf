"""A diagnosis as it unfolds, on the terminal and in a file that another program follows."""

from __future__ import annotations

import shutil
import sys
import threading
import time
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from pysim.cli.progress import Ticking

if TYPE_CHECKING:
    from pysim.types import ErrorStep, ProgressEvent

_LEARNED = 4  # last lines kept in sight
_BAR = 24
_PAUSE = 0.5  # s between two drawings


class Live(Ticking):
    """One block that is drawn over: stage and time, the error falling, what came out.

    Where standard error is no terminal, a line for each event.
    """

    def __init__(self, title: str) -> None:
        super().__init__(title, _PAUSE)
        self._stage = ""
        self._learned: list[str] = []
        self._steps: list[ErrorStep] = []
        self._drawn = 0
        self._lock = threading.Lock()

    def __call__(self, event: ProgressEvent) -> None:
        """Show it."""
        if not self._live:
            print(f"{self._elapsed():6.1f} s  {event}", file=sys.stderr, flush=True)
            return
        with self._lock:
            self._stage = event.stage
            if event.step is not None:
                self._steps.append(event.step)
            elif event.text:
                self._learned = [*self._learned, event.text][-_LEARNED:]
        self._say()

    def _end(self, error: BaseException | None) -> None:
        self._stage = "stopped" if error else "done"
        self._say()

    def _say(self) -> None:
        """Draw over the lines of the last drawing; each is cut to the terminal, so that none takes two."""
        if not self._live:
            return
        with self._lock:
            width = shutil.get_terminal_size().columns - 1
            shown = block(self._title, self._stage, self._elapsed(), self._steps, self._learned)
            lines = [line[:width] for line in shown]
            up = f"\x1b[{self._drawn}A" if self._drawn else ""
            print(up + "".join(f"\r\x1b[K{line}\n" for line in lines), end="", file=sys.stderr, flush=True)
            self._drawn = len(lines)


def block(title: str, stage: str, elapsed: float, steps: Sequence[ErrorStep], learned: Sequence[str]) -> list[str]:
    """Lines of the block: title and time, stage, a row per step with the error as a bar, what was learned."""
    lines = [title, f"  {_clock(elapsed)}  {stage}", *_bars(steps)]
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


def _clock(seconds: float) -> str:
    return f"{int(seconds) // 60}:{int(seconds) % 60:02d}"


class EventFile:
    """Progress as lines of JSON that another program can follow.

    Each has `seconds` since the begin, `stage`, `text`, and `step` of the error history (or null).
    """

    def __init__(self, path: Path) -> None:
        self._path, self._begun = path, time.monotonic()
        path.write_text("", encoding="utf-8")

    def __call__(self, event: ProgressEvent) -> None:
        """Write one line at once, so that a reader sees it whole or not at all."""
        import json

        from pysim.types import step_data

        elapsed = time.monotonic() - self._begun
        step = None if event.step is None else step_data(event.step)
        line = {"seconds": round(elapsed, 3), "stage": event.stage, "text": event.text, "step": step}
        with self._path.open("a", encoding="utf-8") as file:
            file.write(json.dumps(line) + "\n")
