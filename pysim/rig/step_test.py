"""A step of one reference, the other one held, and what the answer is worth."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from pysim.rig.rig_system import OUTPUTS, Feed
from pysim.types import BadInput, Experiment, Record, Signal

Array = NDArray[np.float64]

# s between two rows of a record; a whole number of communication steps of 0.1 to 2 ms.
_ROW = 2e-3


@dataclass(frozen=True)
class StepTest:
    """Speed and load pressure come to where they start by ramps; then one of them steps.

    Args:
        kind: whose reference steps.
        size: rad/s or Pa, from `speed` or `load` on.
        speed: rad/s, the reference of the speed before the step.
        load: Pa, that of the load pressure.
        at: s, when it steps; the ramps take the first second.
        length: s behind the step.
    Raises:
        BadInput: no step, or times that leave no room for the ramps.
    Source: thesis Section 6.4, whose sizes are not published.
    """

    kind: Literal["speed", "load"]
    size: float
    speed: float = 0.0
    load: float = 0.0
    at: float = 10.0
    length: float = 30.0

    def __post_init__(self) -> None:
        if self.kind not in ("speed", "load"):
            raise BadInput(f"step test: kind is {self.kind!r}; give 'speed' or 'load'")
        if not (math.isfinite(self.size) and self.size != 0):
            raise BadInput(f"step test: its size is {self.size:g}; give a number other than zero")
        if not (1.0 <= self.at < math.inf and 0 < self.length < math.inf):
            raise BadInput(
                f"step test: at {self.at:g} s for {self.length:g} s; give 1 s or more, and a positive length"
            )

    @property
    def output(self) -> str:
        """What answers: the true speed, or the load pressure."""
        return "rig.omega" if self.kind == "speed" else "rig.pL"

    def reference(self, kind: str) -> Signal:
        """Of the speed (rad/s) or the load pressure (Pa)."""
        ramp = Signal.lines([0.0, 1.0], [0.0, self.speed if kind == "speed" else self.load])
        return ramp.plus(Signal.steps([0.0, self.at], [0.0, self.size])) if kind == self.kind else ramp

    def experiment(self, feed: Feed = "reference", *, every: float = _ROW) -> Experiment:
        """For `rig_system` without a crane, a row every so many seconds, a whole number of communication steps."""
        inputs = {"speed.reference": self.reference("speed"), "load.reference": self.reference("load")}
        if feed == "reference":
            inputs["load.speed"] = self.reference("speed")
        times = np.arange(round((self.at + self.length) / every) + 1, dtype=np.float64) * every
        return Experiment(times, (*OUTPUTS, "speed.pi", "load.pi"), inputs)


@dataclass(frozen=True)
class StepFigures:
    """Of one answer to a step; shares are of the step's size.

    Args:
        steady_error: what the mean of the last second is above its reference, unit of the answer.
        overshoot: share.
        rise_time: s from a tenth to nine tenths; not a number where it does not get there.
        settling_time: s from the step until the answer stays within `band`; not a number where it does not.
        band: share.
    """

    steady_error: float
    overshoot: float
    rise_time: float
    settling_time: float
    band: float


def step_figures(record: Record, test: StepTest, *, band: float = 0.05) -> StepFigures:
    """What the answer in a record is worth.

    Args:
        band: share of the step around the reference's new value.
    Raises:
        BadInput: a record that ends before the step, or without the answer.
    """
    if record.time.size == 0 or record.time[-1] <= test.at:
        raise BadInput(f"step figures: the record ends before the step at {test.at:g} s; run it to the end")
    base = test.speed if test.kind == "speed" else test.load
    time, values = record.time, record[test.output]
    after = time >= test.at
    since, share = time[after] - test.at, (values[after] - base) / test.size
    last = time > time[-1] - min(1.0, 0.5 * test.length)
    outside = np.flatnonzero(np.abs(share - 1) > band)
    settled = not outside.size or outside[-1] + 1 < since.size
    return StepFigures(
        float(values[last].mean() - base - test.size),
        max(float(share.max()) - 1.0, 0.0),
        _reaches(since, share, 0.9) - _reaches(since, share, 0.1),
        (float(since[outside[-1] + 1]) if outside.size else 0.0) if settled else math.nan,
        band,
    )


def _reaches(since: Array, share: Array, level: float) -> float:
    """When a share is first reached, s, on the line between two rows."""
    beyond = np.flatnonzero(share >= level)
    if not beyond.size:
        return math.nan
    k = int(beyond[0])
    if k == 0:
        return float(since[0])
    part = (level - share[k - 1]) / (share[k] - share[k - 1])
    return float(since[k - 1] + part * (since[k] - since[k - 1]))
