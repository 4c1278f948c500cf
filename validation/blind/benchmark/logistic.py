"""A share that rises with a logarithm: logistic regression of yes and no."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

_ROUNDS = 50
_PRIOR = 1e-2  # inverse variance of both numbers, which keeps them finite where yes and no do not overlap


@dataclass(frozen=True)
class Rise:
    """Share = 1 / (1 + exp(-(level + slope x))), with the covariance (2, 2) of level and slope."""

    level: float
    slope: float
    covariance: Array

    def share(self, x: Array) -> Array:
        """At x (n,)."""
        return np.asarray(1 / (1 + np.exp(-(self.level + self.slope * x))))

    def band(self, x: Array) -> tuple[Array, Array]:
        """95 percent, to first order on the logit's scale."""
        rows = np.column_stack([np.ones_like(x), x])
        reach = 1.96 * np.sqrt(np.sum(rows @ self.covariance * rows, axis=1))
        middle = self.level + self.slope * x
        return np.asarray(1 / (1 + np.exp(reach - middle))), np.asarray(1 / (1 + np.exp(-reach - middle)))

    def where(self, share: float) -> float:
        """x at which the share is reached; not a number where it does not rise."""
        return (np.log(share / (1 - share)) - self.level) / self.slope if self.slope > 0 else float("nan")


def rise(x: Array, hit: NDArray[np.bool_]) -> Rise:
    """Most likely level and slope, by Newton's method, for x (n,) and hit (n,).

    Source: McCullagh and Nelder 1989, Generalized Linear Models, Section 4.4.
    """
    rows, numbers = np.column_stack([np.ones_like(x), x]), np.zeros(2)
    for _ in range(_ROUNDS):
        share = 1 / (1 + np.exp(-(rows @ numbers)))
        information = rows.T @ (rows * (share * (1 - share))[:, None]) + _PRIOR * np.eye(2)
        step = np.linalg.solve(information, rows.T @ (hit - share) - _PRIOR * numbers)
        numbers = numbers + step * min(1.0, 5.0 / max(float(np.linalg.norm(step)), 1e-12))
        if np.linalg.norm(step) < 1e-10:
            break
    return Rise(float(numbers[0]), float(numbers[1]), np.asarray(np.linalg.inv(information), dtype=np.float64))
