"""Blocks without memory around a controller: gains, limits, switches, units."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from pysim.control._check import check_numbers
from pysim.types import BadInput, Port


@dataclass
class Gain:
    """output = gain * input.

    Args:
        gain: output unit per input unit.
        unit, output_unit: of input and output.
    Source: the master gains and the Negate of thesis Tables 12 and 13; `speed_feed_forward`, `load_feed_forward`.
    """

    gain: float
    unit: str = "1"
    output_unit: str = "1"

    def __post_init__(self) -> None:
        check_numbers("gain", self, "gain")
        if not math.isfinite(self.gain):
            raise BadInput(f"gain: {self.gain} is no finite number; give one")
        self.inputs, self.outputs = (Port("u", self.unit),), (Port("y", self.output_unit),)

    def step(self, time: float, inputs: Sequence[float]) -> tuple[float]:
        """(u,) -> (y,)."""
        return (self.gain * inputs[0],)


def speed_feed_forward(K_s: float, K_P: float) -> Gain:
    """Swash plate angle (rad) that pumps what the motor takes at the reference speed (rad/s).

    Args:
        K_s: m3/rad of the motor.
        K_P: m3/(s rad) of the pump.
    Source: thesis Eq. 5.35.
    """
    return Gain(K_s / K_P, "rad/s", "rad")


def load_feed_forward(K_L: float, K_qu: float) -> Gain:
    """Servo valve opening (1) that lets through what the load motor pumps at the reference speed (rad/s).

    Args:
        K_L: m3/rad of the motor.
        K_qu: m3/s of the valve, per opening.
    Source: thesis Eq. 5.37.
    """
    return Gain(-K_L / K_qu, "rad/s", "1")


@dataclass
class Limiter:
    """The input, kept within low ... high.

    Source: `limit1` of thesis Table 13.
    """

    low: float
    high: float
    unit: str = "1"

    def __post_init__(self) -> None:
        check_numbers("limiter", self, "low", "high")
        if not self.low < self.high:
            raise BadInput(f"limiter: low = {self.low:g} is not below high = {self.high:g}; exchange them")
        self.inputs, self.outputs = (Port("u", self.unit),), (Port("y", self.unit),)

    def step(self, time: float, inputs: Sequence[float]) -> tuple[float]:
        """(u,) -> (y,)."""
        return (min(max(inputs[0], self.low), self.high),)


@dataclass
class ZeroSwitch:
    """Lets a signal through while a speed's size is at least a threshold, else zero.

    Its second output says so, for the `active` of a controller ahead of it.

    Args:
        threshold: rad/s.
        unit: of the signal.
    Source: `ZeroSwitch` and `abs_omegaS` of thesis Table 12.
    """

    threshold: float
    unit: str = "1"

    def __post_init__(self) -> None:
        check_numbers("zero switch", self, "threshold")
        if not self.threshold >= 0:
            raise BadInput(f"zero switch: the threshold is {self.threshold:g} rad/s; give zero or more")
        self.inputs = (Port("u", self.unit), Port("speed", "rad/s"))
        self.outputs = (Port("y", self.unit), Port("connected", "1"))

    def step(self, time: float, inputs: Sequence[float]) -> tuple[float, float]:
        """(u, speed) -> (y, connected)."""
        connected = abs(inputs[1]) >= self.threshold
        return (inputs[0] if connected else 0.0, 1.0 if connected else 0.0)


@dataclass
class NormalizeSignal:
    """Swash plate angle in percent of the largest, within 100 percent either way.

    Args:
        largest: rad.
    Source: `NormalizeSignal` of thesis Table 12.
    """

    largest: float

    def __post_init__(self) -> None:
        check_numbers("normalize", self, "largest")
        if not 0 < self.largest < math.inf:
            raise BadInput(f"normalize: the largest angle is {self.largest:g} rad; give a positive one")
        self.inputs, self.outputs = (Port("angle", "rad"),), (Port("percent", "%"),)

    def step(self, time: float, inputs: Sequence[float]) -> tuple[float]:
        """(angle,) -> (percent,)."""
        return (min(max(100 * inputs[0] / self.largest, -100.0), 100.0),)
