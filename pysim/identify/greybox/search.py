"""One search from one start: propose, try, tell, write down."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from pysim.identify.greybox.evaluation import Evaluate, Evaluation
from pysim.identify.greybox.journal import Journal
from pysim.identify.greybox.optimiser import Bounds, Optimiser, State
from pysim.identify.greybox.parameters import ParameterSpace
from pysim.types import FitOutcome

Array = NDArray[np.float64]


class Tried(NamedTuple):
    """What a progress callback is told: which search, points tried, the best cost so far, and the last point's."""

    search: str
    tried: int
    best: float
    last: float


Progress = Callable[[Tried], None]


def search(
    evaluate: Evaluate,
    optimiser: Optimiser,
    space: ParameterSpace,
    start: Array | Evaluation,
    *,
    squares: bool,
    name: str = "",
    journal: Journal | None = None,
    resume: bool = False,
    progress: Progress | None = None,
) -> State:
    """Search from one start until the optimiser has an outcome.

    Args:
        start: (n,), or a point found before, perhaps by rougher simulations: orbits are sought from its own.
        journal: where every point is written down, or None.
        resume: go on from the journal where it holds a state; an outcome it holds is final.
        progress: called after every point; what it raises ends the search, which can be resumed.
    Returns:
        the last state; outcome NO_START where the model could not be simulated at the start.
    """
    bounds = Bounds(*space.bounds())
    state = journal.load() if journal is not None and resume else None
    if state is None:
        before = start if isinstance(start, Evaluation) else None
        x = optimiser.first(start.x if isinstance(start, Evaluation) else start, bounds)
        first = evaluate(x, () if before is None else before.guesses(x))
        state = _begun(optimiser, first, bounds, squares)
        if journal is not None:
            journal.begin()
        _written(journal, space, state, first)
        _told(progress, name, state, first)
    while state.outcome is None:
        proposal = optimiser.propose(state, bounds)
        trial = evaluate(proposal.x, state.best.guesses(proposal.x))
        state = optimiser.tell(state, proposal, trial, bounds)
        _written(journal, space, state, trial)
        _told(progress, name, state, trial)
    return state


def _begun(optimiser: Optimiser, first: Evaluation, bounds: Bounds, squares: bool) -> State:
    if first.good:
        return replace(optimiser.begin(first, bounds, squares), first_cost=first.cost)
    return replace(State(first), outcome=FitOutcome.NO_START, message=first.trouble)


def _written(journal: Journal | None, space: ParameterSpace, state: State, trial: Evaluation) -> None:
    if journal is not None:
        journal.write(state, trial, space.values(trial.x))


def _told(progress: Progress | None, name: str, state: State, trial: Evaluation) -> None:
    if progress is not None:
        progress(Tried(name, state.tried, state.best.cost, trial.cost))
