"""One search from one start: propose a point, evaluate it, tell the optimiser, write the checkpoint."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from pysim.identify.greybox.checkpoint import Checkpoint
from pysim.identify.greybox.optimiser import Bounds, Optimiser, State
from pysim.identify.greybox.parameters import ParameterSpace
from pysim.identify.greybox.residuals import Carried, Point
from pysim.types import FitOutcome

Array = NDArray[np.float64]


class Tried(NamedTuple):
    """What a progress callback receives: name of the search, points tried, best cost so far, cost of the last point."""

    search: str
    tried: int
    best: float
    last: float


Progress = Callable[[Tried], None]

# Search coordinates and the other unknowns -> the objective there.
Evaluate = Callable[[Array, Carried], Point]


def search(
    evaluate: Evaluate,
    optimiser: Optimiser,
    space: ParameterSpace,
    start: Array | Callable[[], Point],
    *,
    squares: bool,
    name: str = "",
    checkpoint: Checkpoint | None = None,
    resume: bool = False,
    progress: Progress | None = None,
) -> State:
    """Search from one start until the optimiser has an outcome.

    Args:
        start: (n,), or a function that returns the first point; not called if the search resumes from a checkpoint.
        checkpoint: where every point is written, or None.
        resume: go on from the checkpoint if it has a state; if that state has an outcome, the search is over.
        progress: called after every point; an exception in it ends the search, which can be resumed.
    Returns:
        the last state; its outcome is NO_START if the model could not be simulated at the start.
    """
    bounds = Bounds(*space.bounds())
    state = checkpoint.load() if checkpoint is not None and resume else None
    if state is None:
        first = start() if callable(start) else evaluate(optimiser.first(start, bounds), Carried())
        state = _begun(optimiser, first, bounds, squares)
        if checkpoint is not None:
            checkpoint.begin()
        _written(checkpoint, space, state, first)
        _told(progress, name, state, first)
    while state.outcome is None:
        proposal = optimiser.propose(state, bounds)
        trial = evaluate(proposal.x, state.best.carried_to(proposal.x, proposal.damping))
        state = optimiser.tell(state, proposal, trial, bounds)
        _written(checkpoint, space, state, trial)
        _told(progress, name, state, trial)
    return state


def _begun(optimiser: Optimiser, first: Point, bounds: Bounds, squares: bool) -> State:
    if first.good:
        return replace(optimiser.begin(first, bounds, squares), first_cost=first.cost)
    return replace(State(first), outcome=FitOutcome.NO_START, message=str(first.failure))


def _written(checkpoint: Checkpoint | None, space: ParameterSpace, state: State, trial: Point) -> None:
    if checkpoint is not None:
        checkpoint.write(state, trial, space.values(trial.x))


def _told(progress: Progress | None, name: str, state: State, trial: Point) -> None:
    if progress is not None:
        progress(Tried(name, state.tried, state.best.cost, trial.cost))
