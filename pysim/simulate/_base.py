"""What a solver is: a method, as data for the kernel, and a step rule."""

from __future__ import annotations

import math
from dataclasses import dataclass, fields
from typing import NamedTuple, Protocol

from pysim.simulate.kernel.method import Method
from pysim.types import BadInput


class Control(NamedTuple):
    """Step rule, the part of the settings that every method shares; times in s."""

    step: float  # fixed step; 0 where the error rules
    rtol: float  # tolerated error of a step, of a state's magnitude
    atol: float  # the same, of a state's nominal value
    max_step: float
    max_steps: int


class Solver(Protocol):
    """Frozen settings of one way to step. A new one of a known family is a file with its coefficients."""

    def method(self) -> Method:
        """The coefficients."""
        ...

    def control(self) -> Control:
        """The step rule."""
        ...


@dataclass(frozen=True)
class Adaptive:
    """What every solver has whose steps follow from their error; a solver adds its `method`.

    Args:
        rtol: tolerated error of a step, of a state's magnitude.
        atol: the same, of a state's nominal value.
        max_step: s; below the duration of what is to make an event and lasts shortly.
        max_steps: the run stops after that many, or once a million of them got so little further that a thousand
            times as many would not do.
    Raises:
        BadInput: a setting that is not positive.
    """

    rtol: float = 1e-6
    atol: float = 1e-6
    max_step: float = math.inf
    max_steps: int = 10_000_000

    def __post_init__(self) -> None:
        for argument in fields(self):
            value = getattr(self, argument.name)
            if not value > 0:
                raise BadInput(f"{type(self).__name__}: {argument.name} must be positive, got {value}")

    def control(self) -> Control:
        """Error-controlled steps."""
        return Control(0.0, self.rtol, self.atol, self.max_step, self.max_steps)


def fixed(name: str, step: float, max_steps: int) -> Control:
    """A step rule with points at start + n * step.

    Raises:
        BadInput: a setting that is not positive.
    """
    if not (step > 0 and math.isfinite(step)):
        raise BadInput(f"{name}: step must be a positive number of seconds, got {step}")
    if not max_steps > 0:
        raise BadInput(f"{name}: max_steps must be positive, got {max_steps}")
    return Control(step, 1.0, 1.0, math.inf, max_steps)
