"""Rk4: the classical fourth-order method with a fixed step."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from pysim.simulate._base import Control, fixed
from pysim.simulate.kernel.method import ExplicitMethod


def _hermite(b: np.ndarray) -> np.ndarray:
    """Cubic through both ends of the step with their derivatives: weights of the stages and of the last derivative."""
    dense = np.zeros((b.size + 1, 3))
    dense[: b.size] = np.outer(b, (0.0, 3.0, -2.0))  # (x_new - x) / h
    dense[0] += (1.0, -2.0, 1.0)
    dense[-1] += (0.0, -1.0, 1.0)
    return dense


_B = np.array([1, 2, 2, 1]) / 6.0

_METHOD = ExplicitMethod(
    order=4,
    error_order=5,
    a=np.array([[0, 0, 0, 0], [0.5, 0, 0, 0], [0, 0.5, 0, 0], [0, 0, 1.0, 0]]),
    b=_B,
    c=np.array([0, 0.5, 0.5, 1.0]),
    error=np.zeros(5),
    dense=_hermite(_B),
)


@dataclass(frozen=True)
class Rk4:
    """Four stages, order 4, a fixed step; the cubic in between is of order 4 as well.

    Args:
        step: s; points lie at start + n * step, and at the breaks and events in between.
        max_steps: the run stops after that many.
    """

    step: float
    max_steps: int = 1_000_000_000

    def __post_init__(self) -> None:
        self.control()

    def method(self) -> ExplicitMethod:
        """Coefficients of the classical method."""
        return _METHOD

    def control(self) -> Control:
        """A fixed step."""
        return fixed("Rk4", self.step, self.max_steps)
