"""What the kernel is asked for: one run or orbit, and what all of a pass have in common."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from pysim.simulate._base import Control, Solver
from pysim.simulate._variation import Directions
from pysim.simulate.kernel.method import Method
from pysim.types import Experiment

Array = NDArray[np.float64]

# Number of the first row, values (n, n_y), slopes (n, n_y, n_d) by the offset, where that is a direction, and the
# parameters; only valid in the call.
Take = Callable[[int, Array, Array], None]


@dataclass(frozen=True)
class Request:
    """One run, or the search for one orbit.

    Args:
        experiment: checked; for an orbit one period from time 0, its end included.
        states: (n,) to start from, for an orbit a guess; those of the FMU where None.
        start_by: (n, n_p) how they depend on the parameters; not at all where None.
        settling: periods from the model's own start that make a guess, where there is none; half of four cost the
            pump three times the time.
        take: of a run with derivatives, is given its rows stretch by stretch; then none of them are kept.
    """

    experiment: Experiment
    states: Array | None = None
    start_by: Array | None = None
    settling: int = 4
    take: Take | None = None


@dataclass(frozen=True)
class Kind:
    """What all requests of a pass have in common.

    Args:
        kind: PLAIN, VARIED or ORBIT.
        directions: of the derivatives.
        mismatch: largest correction of an orbit, in amplitudes, that is left to first order.
        point: whether the derivatives at the last point are wanted: `rates`, `jacobian` and `forcing`.
    """

    kind: int
    solver: Solver
    directions: Directions = Directions(outputs=False)  # noqa: RUF009
    mismatch: float = 0.0
    point: bool = False

    def plain(self) -> Kind:
        """The same with a solver that any process knows."""
        solver = self.solver
        known = PlainSolver(solver.method(), solver.control(), getattr(solver, "derivative_tol", np.inf))
        return replace(self, solver=known)


@dataclass(frozen=True)
class PlainSolver:
    """What the kernel needs of a solver. The class of a user's own may be known to the user's process alone."""

    coefficients: Method
    rule: Control
    derivative_tol: float

    def method(self) -> Method:
        """The coefficients."""
        return self.coefficients

    def control(self) -> Control:
        """The step rule."""
        return self.rule
