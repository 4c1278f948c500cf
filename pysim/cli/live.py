"""A diagnosis as it unfolds, on the terminal and in a file that another program follows."""

from __future__ import annotations

import shutil
import sys
import threading
import time
from collections.abc import Sequence
from pathlib import Path
from types import TracebackType
from typing import TYPE_CHECKING

from pysim.cli.terminal import draws_over

if TYPE_CHECKING:
    from pysim.types import LedgerStep, Told

_LEARNED = 4  # last lines kept in sight
_BAR = 24
_PAUSE = 0.5  # s between two drawings
# Share of a diagnosis' time that is usually behind once a stage begins, by the stage's first words.
_USUAL = {"comparing": 0.0, "refitting the model": 0.1, "compiling": 0.3, "screening": 0.45, "refitting the prom": 0.55}


class Story:
    """One calm block that is drawn over: stage and time, the error falling, what was learned.

    Where standard error is no terminal, a line for each thing told.
    """

    def __init__(self, title: str) -> None:
        self._title = title
        self._begun = time.monotonic()
        self._stage = ""
        self._learned: list[str] = []
        self._steps: list[LedgerStep] = []
        self._drawn = 0
        self._live = draws_over(sys.stderr)
        self._lock = threading.Lock()
        self._ended = threading.Event()
        self._clock = threading.Thread(target=self._tick, daemon=True)

    def __call__(self, told: Told) -> None:
        """Take what a diagnosis tells."""
        if not self._live:
            print(f"{self._elapsed():6.1f} s  {told}", file=sys.stderr, flush=True)
            return
        with self._lock:
            self._stage = told.stage
            if told.step is not None:
                from pysim.types.diagnosis import standing

                self._steps = standing([*self._steps, told.step], lambda step: step.step)
            elif told.text:
                self._learned = [*self._learned, told.text][-_LEARNED:]
        self._draw()

    def __enter__(self) -> Story:
        if self._live:
            self._clock.start()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, where: TracebackType | None
    ) -> None:
        self._ended.set()
        if self._live:
            self._clock.join()
            with self._lock:
                self._stage = "stopped" if error else "done"
            self._draw()

    def _elapsed(self) -> float:
        return time.monotonic() - self._begun

    def _tick(self) -> None:
        while not self._ended.wait(_PAUSE):
            self._draw()

    def _draw(self) -> None:
        """Over the lines of the last drawing; each is cut to the terminal, so that none takes two."""
        with self._lock:
            width = shutil.get_terminal_size().columns - 1
            lines = [
                line[:width] for line in block(self._title, self._stage, self._elapsed(), self._steps, self._learned)
            ]
            up = f"\x1b[{self._drawn}A" if self._drawn else ""
            print(up + "".join(f"\r\x1b[K{line}\n" for line in lines), end="", file=sys.stderr, flush=True)
            self._drawn = len(lines)


def block(title: str, stage: str, elapsed: float, steps: Sequence[LedgerStep], learned: Sequence[str]) -> list[str]:
    """Lines of the block: title and time, stage, a row per step with the error as a bar, what was learned."""
    seconds = left(stage, elapsed, steps)
    more = "" if seconds is None else f" (about {_clock(seconds)} left)"
    lines = [title, f"  {_clock(elapsed)}{more}  {stage}", *_bars(steps)]
    return [*lines, *(f"  - {text}" for text in learned)]


def _bars(steps: Sequence[LedgerStep]) -> list[str]:
    """The error over noise falling; the bars' lengths are logarithms, and none is left where nothing but noise is."""
    from math import log

    values = [step.fit if step.fit is not None else step.validate or 1.0 for step in steps]
    top = log(max([2.0, *values]))
    lines = []
    for step, value in zip(steps, values, strict=True):
        name = {"prior": "as it is", "refit": "refitted"}.get(step.step, f"+ {step.step}")
        held = "" if step.validate is None or step.fit is None else f"  held out {step.validate:7.2f}"
        bar = "#" * round(_BAR * max(0.0, log(max(value, 1e-9))) / top)
        lines.append(f"  {name:<24} {value:7.2f} {bar:<{_BAR}}{held}".rstrip())
    return [f"  {'error over noise':<24}", *lines] if lines else []


def _clock(seconds: float) -> str:
    return f"{int(seconds) // 60}:{int(seconds) % 60:02d}"


def left(stage: str, elapsed: float, steps: Sequence[LedgerStep]) -> float | None:
    """How many s it may still take, from what is usually behind by then; None where nobody knows."""
    share = next((value for words, value in _USUAL.items() if stage.startswith(words)), 0.0)
    if share < 0.2 or elapsed < 2 or len(steps) >= 3:  # how many rounds there will be, nobody knows
        return None
    return max(elapsed / share - elapsed, 1.0)


class StoryFile:
    """What a diagnosis tells, as lines of JSON that another program can follow.

    Each has `seconds` since the begin, `left` (s, or null), `stage`, `text`, and `step` of the ledger (or null).
    """

    def __init__(self, path: Path) -> None:
        self._path, self._begun = path, time.monotonic()
        self._steps: list[LedgerStep] = []
        path.write_text("", encoding="utf-8")

    def __call__(self, told: Told) -> None:
        """Write one line; a reader never sees half of one that it cannot tell."""
        import json

        from pysim.present.diagnosis.answer import step_data

        elapsed = time.monotonic() - self._begun
        if told.step is not None:
            from pysim.types.diagnosis import standing

            self._steps = standing([*self._steps, told.step], lambda step: step.step)
        line: dict[str, object] = {
            "seconds": round(elapsed, 3),
            "left": left(told.stage, elapsed, self._steps),
            "stage": told.stage,
        }
        line |= {"text": told.text, "step": None if told.step is None else step_data(told.step)}
        with self._path.open("a", encoding="utf-8") as file:
            file.write(json.dumps(line) + "\n")
