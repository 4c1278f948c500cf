"""Problems with known answers for optimisers: residuals as plain functions, no model behind them."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from pysim.identify.greybox.parameters import ParameterSpace
from pysim.identify.greybox.residuals import Carried, OwnStep, Point, failed_point
from pysim.identify.greybox.runs import Failure
from pysim.identify.greybox.search import Evaluate
from pysim.types import Outcome

Array = NDArray[np.float64]


def space(start: list[float], lower: list[float] | None = None, upper: list[float] | None = None) -> ParameterSpace:
    """Linear parameters p0, p1, ... of scale 1."""
    n = len(start)
    names = tuple(f"p{i}" for i in range(n))
    return ParameterSpace(
        keys=names,
        variables=names,
        records=(None,) * n,
        units=("1",) * n,
        start=np.array(start, dtype=float),
        lower=np.array(lower if lower is not None else [-np.inf] * n, dtype=float),
        upper=np.array(upper if upper is not None else [np.inf] * n, dtype=float),
        scale=np.ones(n),
        log=np.zeros(n, dtype=bool),
    )


def evaluating(
    residual: Callable[[Array], Array],
    jacobian: Callable[[Array], Array],
    *,
    squares: bool = True,
    bad: Callable[[Array], bool] = lambda x: False,
) -> Evaluate:
    """An objective without a model; points where `bad` says so cannot be simulated."""

    def evaluate(x: Array, carried: Carried) -> Point:
        if bad(x):
            return failed_point(x, Failure("run", Outcome.MODEL_ERROR, "does not run here"))
        r = residual(x)
        cost = 0.5 * float(r @ r) if squares else float(np.sum(np.abs(r)))
        return Point(x, cost, r, jacobian(x))

    return evaluate


def linear(seed: int, rows: int, n: int) -> tuple[Array, Array]:
    """A matrix (rows, n) and a right side (rows,) of normal numbers."""
    rng = np.random.default_rng(seed)
    return rng.normal(size=(rows, n)), rng.normal(size=rows)


def rosenbrock(x: Array) -> Array:
    return np.array([10 * (x[1] - x[0] ** 2), 1 - x[0]])


def rosenbrock_slopes(x: Array) -> Array:
    return np.array([[-20 * x[0], 10.0], [-1.0, 0.0]])


def beside_a_bent_state(x: Array, carried: Carried) -> Point:
    """3 (x - 2) and exp(2 s) - 2: from s = -2 Newton's step on the state s leads to s = 52."""
    (s,) = carried.states or (np.array([-2.0]),)
    assert s is not None
    residual, slope = np.array([3 * (x[0] - 2), np.exp(2 * s[0]) - 2]), 2 * np.exp(2 * s[0])
    own = OwnStep(np.zeros((1, 1)), np.array([[1 / slope]]), np.ones(1), residual[1:], np.zeros((1, 0)))
    return Point(
        x, 0.5 * float(residual @ residual), residual, np.array([[3.0], [0.0]]),
        carried=Carried((s,)), steps=(own, OwnStep.none(np.zeros((0, 1)))),
    )  # fmt: skip
