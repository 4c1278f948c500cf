"""What is known to happen at a model's places: the catalogue's effects, fitted there like any other law.

A table over one variable cannot hold what remembers, such as a lag, a sampled signal, play or the stop of a spool; the
effects can. They say where something is missing; what is missing there is drawn from the measurements.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from pysim.diagnose.contenders import Contender, suited
from pysim.diagnose.corrections import as_noise
from pysim.diagnose.decide import price
from pysim.diagnose.fitted import Fitted
from pysim.diagnose.refit import chord_refit, refit_from
from pysim.diagnose.residuals import Ruler
from pysim.diagnose.screen import Footprint, elsewhere, per_effect, screen
from pysim.diagnose.start import start_at, start_off
from pysim.diagnose.subject import Subject, extended
from pysim.diagnose.trials import start_amount
from pysim.diagnose.unbent import unbent
from pysim.identify import HALF_95
from pysim.identify.greybox.residuals import Point
from pysim.types import BadInput, Effect

Array = NDArray[np.float64]
Say = Callable[[str], None]

# Effects that are refitted, and the share of the best gain that the screening has to promise for it; always so many.
_REFITTED, _PROMISE, _ALWAYS = 7, 0.03, 3
# Of these, effects that get slopes of their own, and how near the best they have to be, as a share of its fall.
_LEADERS, _NEAR = 3, 0.8
# Points tried with one set of slopes, and from parameters far off.
_STEPS, _FAR_STEPS = 6, 9
# Where a refit reaches less than this share of what was promised, it starts from the model's own parameters too.
_KEPT = 0.5


@dataclass(frozen=True)
class Known:
    """One effect in its place.

    Args:
        effect: which.
        at: the model with it, refitted; slopes of that point or of one near by.
        worth: by how much the sum of squares falls, less the price of its parameters.
        ruler: that runs the model with it.
    """

    effect: Effect
    at: Fitted = field(repr=False)
    worth: float
    ruler: Ruler = field(repr=False)

    @property
    def slot(self) -> str:
        """Name of the place."""
        return self.effect.slot

    @property
    def text(self) -> str:
        """The effect with its fitted sizes."""
        return f"{self.effect.name}, {', '.join(self._sizes())}"

    @property
    def doubt(self) -> float:
        """Half a 95 percent interval of its size, as a share of it; of several sizes the best known."""
        slopes, x, space = self.at.point.jacobian, self.at.point.x, self.at.what.space
        scale = max(1.0, self.at.point.cost / max(self.at.point.residual.size - x.size, 1))
        spread = np.sqrt(scale * np.diag(np.linalg.pinv(slopes.T @ slopes, rcond=1e-12, hermitian=True)))
        place, values = self.at.what.places[self.effect.name], space.to_model(x)
        own = [space.keys.index(f"{place}.{p.name}") for p in self.effect.strengths]
        shares = [HALF_95 * spread[j] * space.slope(x)[j] / abs(values[j]) for j in own if values[j]]
        return float(min([*shares, 1.0]))

    def _sizes(self) -> Iterator[str]:
        place, values = self.at.what.places[self.effect.name], self.at.what.space.values(self.at.point.x)
        for p in self.effect.parameters:
            name, value = p.reported(values[f"{place}.{p.name}"])
            yield f"{name} = {value:.3g}{f' {p.unit}' if p.unit not in ('', '1') and not p.inverse else ''}"


def known(subject: Subject, ruler: Ruler, at: Fitted, say: Say) -> list[Known]:
    """The catalogue's effects that promise something, refitted with the model's parameters, the best first.

    Args:
        ruler: of the tests to look at.
        at: the model without a term, of that ruler.
    """
    contenders = _contenders(subject, ruler, at, say)
    footprints = [
        *screen(at, list(contenders.values())),
        *(footprint for one in contenders.values() for footprint in elsewhere(at, one)),
    ]
    start = _Start(at, ruler)
    found = _refitted(start, sorted(footprints, key=lambda f: -_fall(f)), contenders)
    if found:
        best = max(one.worth for one in found)
        found = [_led(one, start) if k < _LEADERS and one.worth > _NEAR * best else one for k, one in enumerate(found)]
    return sorted(found, key=lambda one: -one.worth)


def _contenders(subject: Subject, ruler: Ruler, at: Fitted, say: Say) -> dict[str, Contender]:
    """By name every effect that the model has not."""
    had, found = [effect.name for effect in at.what.effects], dict[str, Contender]()
    for effect in subject.catalogue if subject.build_variant else ():
        if effect.name in had:
            continue
        try:
            what = extended(subject, [*at.what.effects, effect])
        except BadInput as error:
            say(f"{effect.name} could not be tried: {error}")
            continue
        found[effect.name] = Contender(effect, what, suited(ruler, at, what, [effect]))
    return found


def _fall(found: Footprint) -> float:
    """Of the sum of squares, to first order: with the best amount, or as it was tried where that cannot be had less."""
    return found.size * (2 * found.amount - 1) if found.effect.bypass else found.gain


@dataclass(frozen=True)
class _Start:
    """Where refits begin.

    Args:
        at: the fitted model.
        ruler: that counts it.
    """

    at: Fitted
    ruler: Ruler

    @cached_property
    def own(self) -> Fitted | None:
        """At the model's own parameters; None where that cannot be simulated."""
        space = self.at.what.space
        point = self.ruler.evaluation(self.at.what, space.to_search(space.start))
        return Fitted(self.at.what, point) if point.good else None


def _refitted(start: _Start, footprints: Sequence[Footprint], contenders: dict[str, Contender]) -> list[Known]:
    """With slopes put together from what is known, the best first; what gains nothing is left out."""
    heads = per_effect(footprints)
    found = []
    for k, head in enumerate(heads[:_REFITTED]):
        if k >= _ALWAYS and _fall(head) < _PROMISE * _fall(heads[0]):
            break
        one = contenders[head.effect.name]
        own = [footprint for footprint in footprints if footprint.effect.name == head.effect.name]
        end = _best_end(start, one, own)
        if end is not None:
            found.append(_known(one, end, start.at))
    return sorted(found, key=lambda one: -one.worth)


def _known(one: Contender, end: Point, at: Fitted) -> Known:
    extra = end.x.size - at.point.x.size
    worth = at.point.cost - end.cost - price(extra, end.residual.size)
    return Known(one.effect, Fitted(one.what, end), worth, one.ruler)


def _best_end(start: _Start, one: Contender, own: Sequence[Footprint]) -> Point | None:
    """From the strength that promises most; then from the one that changes least, and from parameters far off."""
    at, before = start.at, start.at.point.cost
    ends = [_end(one, at, own[0], _STEPS)]
    if len(own) > 1 and (ends[0] is None or ends[0].cost > before):
        ends.append(_end(one, at, min(own, key=lambda f: f.size), _STEPS))
    reached = before - min((end.cost for end in ends if end is not None), default=before)
    if reached < _KEPT * _fall(own[0]):
        ends.append(_end(one, start.own, own[0], _FAR_STEPS))
    good = [end for end in ends if end is not None and end.cost < before]
    return min(good, key=lambda end: end.cost, default=None)


def _end(one: Contender, at: Fitted | None, found: Footprint, steps: int) -> Point | None:
    if at is None:
        return None
    first = start_off(at, one.what, found) if len(one.effect.parameters) == 1 else None
    if first is None:
        first = start_at(one.ruler, at, one.what, [(found, start_amount(found.effect, found.amount))])
    return None if first is None else chord_refit(one.ruler, one.what, first, steps=steps)


def _led(one: Known, start: _Start) -> Known:
    """With slopes of its own; where it leaves more than noise does, from the model's own parameters too."""
    first = one.ruler.evaluation(one.at.what, one.at.point.x)
    ends = [refit_from(one.ruler, one.at.what, first, rounds=2)[0]] if first.good else []
    if start.own is not None and not any(as_noise(one.ruler, end) for end in ends):
        again = unbent(Contender(one.effect, one.at.what, one.ruler), one.at, start.own)
        ends += [] if again is None else [again[0]]
    end = min([one.at.point, *ends], key=lambda end: end.cost)
    return replace(one, at=Fitted(one.at.what, end), worth=one.worth + one.at.point.cost - end.cost)
