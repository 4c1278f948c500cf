"""Whether effects and sensor errors that were found stay in the model beside a learned law.

A law at the slot of an effect, over a variable of the effect's own law, refines the effect and never replaces it: such
a curve can imitate every effect there. Any other law replaces ("unseats") an effect if the effect is no longer
significant beside the law, and the law alone explains clearly more of the avoidable sum of squares.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping, Sequence

import numpy as np

from pysim.diagnosis import rivals
from pysim.diagnosis.candidate import Candidate
from pysim.diagnosis.floors import Floors
from pysim.diagnosis.learn.fit import LawFit, ended, settled, started
from pysim.diagnosis.learn.screening import LawModel
from pysim.diagnosis.refit import FinalFit, begin
from pysim.diagnosis.session import Session
from pysim.diagnosis.settings import LearnSettings
from pysim.effects.learned import Law
from pysim.identify.greybox import Nuisance
from pysim.types import BadInput, Effect
from pysim.types.answer import GainTest

# Effects and sensor errors -> the candidate with these.
Alone = Callable[[Sequence[Effect], Sequence[Nuisance]], Candidate]


def refines(law: Law, effect: Effect) -> bool:
    """Whether the law is at the effect's slot, over a variable that the effect's own law has, and has no memory."""
    if law.free:
        return False
    name = law.argument.removeprefix(f"{law.place.name}.")
    words = set(re.findall(r"[A-Za-z_]\w*", effect.law))
    return effect.slot == law.place.name and name in words


def without_the_unseated(
    session: Session,
    law: LawFit,
    present: FinalFit,
    base: FinalFit,
    losses: Mapping[str, GainTest],
    alone: Alone,
    floors: Floors,
    tried: int,
    settings: LearnSettings | None = None,
) -> LawFit:
    """The refitted law without what it replaces; the effect or sensor error that costs least is tried first.

    Args:
        law: refitted beside all effects and sensor errors of `present`.
        base: the model without effects.
        losses: label -> test of what leaving an effect or sensor error out of `present` costs.
        tried: number of comparisons, for the Bonferroni correction.
    """
    settings = settings or LearnSettings()
    best, before, avoidable = law, floors.avoidable(present), floors.avoidable(base)
    for _, part in sorted(present.candidate.parts.items(), key=lambda item: losses[item[0]].gain):
        if isinstance(part, Effect) and refines(law.law, part):
            continue
        smaller = _without(session, best, part, alone, settings)
        if smaller is None or avoidable <= 0:
            continue
        better = (before - floors.avoidable(smaller.fit)) / avoidable
        if better < settings.unseats:
            continue
        size, gain = best.fit.candidate.size, smaller.cost - best.cost
        df = size - smaller.fit.candidate.size
        test = rivals.gain_test(smaller.fit, best.fit, gain, df, size, max(tried, 1), session.settings)
        if test.p_value >= session.settings.false_alarm:
            best = smaller
    return best


def _without(
    session: Session, law: LawFit, part: Effect | Nuisance, alone: Alone, settings: LearnSettings
) -> LawFit | None:
    """The law in the model without an effect or sensor error, refitted from its values; None if that does not compile
    or run."""
    assert session.build_law is not None
    effects = [one for one in law.fit.candidate.effects if one is not part]
    nuisances = [one for one in law.fit.candidate.nuisances if one is not part]
    values = dict(_kept(law, part))
    try:
        candidate = alone(effects, nuisances)
        present = begin(candidate, values, law.fit.simulation, law.fit)
        if not present.good:
            return None
        model = session.build_law(effects, [law.term])
    except BadInput:
        return None
    made = LawModel(law.law.place, law.knots.size, present, model, law.term.memory)
    x = np.append(candidate.at(values), law.fit.point.x[-len(law.own) :])
    found = started(made, law.law, law.knots, law.unit, law.smoothness, x, law.fit.simulation)
    return ended(settled(found, settings.heat, session.settings.least_gain)) if found.fit.good else None


def _kept(law: LawFit, part: Effect | Nuisance) -> Iterator[tuple[str | tuple[str, str], float]]:
    """Key and value of the free parameters of the model and of all effects but one."""
    name = part.name if isinstance(part, Effect) else ""
    for key, value in law.fit.values.items():
        if key not in law.own and not (isinstance(key, tuple) and key[0] == name):
            yield key, value
