"""Models with one effect more, each with the way it is run."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from pysim.diagnose.fitted import Fitted
from pysim.diagnose.residuals import Ruler
from pysim.diagnose.strengths import setting, strengths
from pysim.diagnose.subject import Extended
from pysim.simulate import Esdirk, Rodas, simulate_many
from pysim.types import Effect, Outcome

# The other method has to take this share of the work, to make up for the noise that another integration brings in.
_WORTH = 0.6


@dataclass(frozen=True)
class Contender:
    """The model so far with one effect more.

    Args:
        effect: the one.
        what: the model.
        ruler: that runs it through the tests.
    """

    effect: Effect
    what: Extended
    ruler: Ruler


def suited(ruler: Ruler, current: Fitted, what: Extended, effects: Sequence[Effect]) -> Ruler:
    """The ruler, with the implicit Runge-Kutta method where that is so much less work for this model.

    A law that switches within microseconds makes the other one creep. Work is counted, not timed, so that the choice
    is the same everywhere.
    """
    if not isinstance(ruler.solver, Rodas):
        return ruler
    values: dict[str, float] = {}
    for effect in effects:
        values |= setting(current.what, what, effect, current.point.x, next(strengths(effect)))
    shortest = min(ruler.experiments(values), key=lambda e: float(e.times[-1]) - e.start)
    other = Esdirk(rtol=ruler.solver.rtol, atol=ruler.solver.atol)
    work = []
    for solver in (ruler.solver, other):
        (record,) = simulate_many(what.model, [shortest], solver=solver, workers=1)
        work.append(record.statistics["derivatives"] if record.outcome is Outcome.DONE else float("inf"))
    return replace(ruler, solver=other) if work[1] < _WORTH * work[0] else ruler
