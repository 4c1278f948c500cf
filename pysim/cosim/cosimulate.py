"""One run of a system from its begin to its end."""

from __future__ import annotations

from collections.abc import Callable

from pysim.cosim.doubling import Doubling
from pysim.cosim.order import Order
from pysim.cosim.run import Run
from pysim.cosim.system import System
from pysim.types import Experiment, Record, SimulationError


def cosimulate(
    system: System,
    experiment: Experiment,
    *,
    step: float,
    order: Order | None = None,
    doubling: Doubling | None = None,
    check: bool = True,
    progress: Callable[[float], None] | None = None,
) -> Record:
    """Run a system through an experiment.

    Args:
        system: its members are started anew, and closed at the end.
        experiment: times at communication points; names are "member.port", in `overrides` "member.parameter".
        step: s between two communication points, which lie at start + n * step.
        order: who steps when, with which inputs; None is Jacobi().
        doubling: error control within each step.
        check: False returns a failed run instead of raising.
        progress: called now and then with the time, s.
    Returns:
        columns as asked for, then `<bond>.power` (W) and `<bond>.residual` (J) of each bond.
    Raises:
        BadInput: an unknown name, an input that nothing drives, a time or a rate that is no whole number of steps, an
            algebraic loop that the order does not solve, or a member that cannot do what the order asks for.
        SimulationError: a member failed or put out what is no finite number; the text has time and name, `.record` the
            part that was reached.
    """
    try:
        with Run(system, experiment, step=step, order=order, doubling=doubling) as run:
            run.advance(progress=progress)
            return run.record()
    except SimulationError as error:
        if check:
            raise
        return error.record
