"""What a solver is: a method, as data for the native loop, and a step rule."""

from __future__ import annotations

import math
from typing import NamedTuple, Protocol

from pysim.simulate._state import Control
from pysim.types import BadInput


class Solver(Protocol):
    """Frozen settings of one way to step. A new one of a known family is a file with its coefficients."""

    def method(self) -> NamedTuple:
        """The coefficients, of a family that `_method` knows."""
        ...

    def control(self) -> Control:
        """The step rule."""
        ...


def adaptive(name: str, rtol: float, atol: float, max_step: float, max_steps: int) -> Control:
    """A step rule that keeps the error of each step at its tolerance, checked."""
    for argument, value in (("rtol", rtol), ("atol", atol), ("max_step", max_step), ("max_steps", max_steps)):
        if not value > 0:
            raise BadInput(f"{name}: {argument} must be positive, got {value}")
    return Control(0.0, float(rtol), float(atol), float(max_step), int(max_steps))


def fixed(name: str, step: float, max_steps: int) -> Control:
    """A step rule with points at start + n * step, checked."""
    if not (step > 0 and math.isfinite(step)):
        raise BadInput(f"{name}: step must be a positive number of seconds, got {step}")
    if not max_steps > 0:
        raise BadInput(f"{name}: max_steps must be positive, got {max_steps}")
    return Control(float(step), 1.0, 1.0, math.inf, int(max_steps))
