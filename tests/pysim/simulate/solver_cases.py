"""Every solver, as the battery in test_solvers.py wants it. A new one is one entry."""

from collections.abc import Callable
from dataclasses import dataclass

from pysim.simulate import Esdirk, Rk4, Rk45, Rodas, Solver


@dataclass(frozen=True)
class SolverCase:
    """How to make the solver finer, and what its class claims.

    Args:
        make: solver for a resolution: a tolerance, or a step in s.
        coarse: a resolution at which errors of the oscillator are well above rounding and well below its amplitude.
        order: global order of convergence in the length of the step.
        fixed: the resolution is a step.
    """

    make: Callable[[float], Solver]
    coarse: float
    order: int
    fixed: bool = False


SOLVERS = {
    "Rk4": SolverCase(Rk4, 0.05, 4, fixed=True),
    "Rk45": SolverCase(lambda tolerance: Rk45(tolerance, tolerance), 1e-6, 5),
    "Esdirk": SolverCase(lambda tolerance: Esdirk(tolerance, tolerance), 1e-6, 4),
    "Rodas": SolverCase(lambda tolerance: Rodas(tolerance, tolerance), 1e-6, 5),
}
