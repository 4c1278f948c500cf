"""The promising candidates of a round refitted: all of them cheaply, the leaders with slopes of their own."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import astuple, replace
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pysim.diagnose import decide
from pysim.diagnose.blame import Blame
from pysim.diagnose.contenders import Contender
from pysim.diagnose.corrections import as_noise, blamed, is_off, recounted
from pysim.diagnose.fitted import Fitted
from pysim.diagnose.nuisance import Suspect
from pysim.diagnose.reduced import reduced
from pysim.diagnose.refit import chord_refit, refit_from
from pysim.diagnose.rounds import Tried
from pysim.diagnose.scores import by_score, score, share
from pysim.diagnose.screen import Footprint, elsewhere, largest_value
from pysim.diagnose.set_aside import set_aside
from pysim.diagnose.start import start_at, start_off
from pysim.diagnose.steps import run_again
from pysim.diagnose.story import Story
from pysim.diagnose.strengths import limits
from pysim.diagnose.unbent import best_of, unbent
from pysim.identify.greybox.residuals import Point
from pysim.simulate import Rodas
from pysim.types import Effect

Array = NDArray[np.float64]

# Candidates that get a refit on probation, and the share of the best gain that the screening has to promise for it.
_PROBATION, _PROMISE = 7, 0.05
# Candidates whose slopes are run, and the share of the best score that a refit on probation has to reach for it.
_FINAL, _NEAR = 3, 0.8
# Where a refit reaches less than this share of what was promised, straight lines were no guide, and another start is.
_KEPT = 0.5
# Points tried on probation, from parameters far off, and to see which of several strengths to begin at.
_STEPS, _FAR_STEPS, _LOOK = 6, 9, 2
# Integration of ties.
_FINE = Rodas(rtol=1e-7, atol=1e-7)


def refitted(
    story: Story, tried: Tried, nominal: Fitted | None, *, least: float = 0.5 * decide.FAIR
) -> dict[str, Fitted]:
    """The promising candidates refitted: all on probation, the leaders with slopes of their own.

    Args:
        nominal: the base model at its own parameters, counted without nuisances; refits start there too where those
            found have been bent, and where more than noise is left. None where the model so far has an effect.
        least: share of the misfit that a refit on probation has to take for slopes of its own.
    """
    story.now("refitting the promising candidates")
    nominal = None if nominal is None else recounted(story.first, tried.ruler, nominal)
    found: dict[str, Fitted] = {}
    for head in promising(tried):
        one = tried.contenders[head.effect.name]
        end = _on_probation(story, tried, one, partial(_probation, tried, one, nominal))
        found |= {} if end is None else {head.effect.name: end}
    story.stage("refit candidates")
    order = _worth_slopes(story, tried, found, least)
    best = score(story, tried.current, found[order[0]]) if order else 0.0
    for name in order[:_FINAL]:
        if score(story, tried.current, found[name]) < _NEAR * best and name != order[0]:
            continue
        end = _with_slopes(story, tried, tried.contenders[name], found[name], nominal, leads=name == order[0])
        if end is not None:
            found[name] = end
            story.say(
                f"refitted with {name}: sum of squares {tried.current.point.cost:.6g} -> {found[name].point.cost:.6g}"
            )
    found |= _special_cases(story, tried, found)
    story.stage("refit leaders")
    return found


def _special_cases(story: Story, tried: Tried, found: dict[str, Fitted]) -> dict[str, Fitted]:
    """Effects that are the leader with parameters less, refitted from where it has led.

    Whether the leader's other parameters are needed is asked of both at their best, and a cheap refit may have stalled.
    """
    done = {name: one for name, one in found.items() if one.point.residual.size}  # those on probation have none
    ends: dict[str, Fitted] = {}
    for leader in by_score(story, tried.current, done)[:1]:
        for name, one in tried.contenders.items():
            if name in done or not one.effect.is_special_case_of(tried.contenders[leader].effect):
                continue
            find = partial(_specialised, story, one, found[leader])
            end = story.fitted(one.what, part_of(tried, name), find, one.ruler)
            if end is not None:
                ends[name] = end
                before = tried.current.point.cost
                story.say(f"refitted with {name}, from {leader}: sum of squares {before:.6g} -> {end.point.cost:.6g}")
    return ends


def _specialised(story: Story, one: Contender, leader: Fitted) -> tuple[Point, Array] | None:
    """A refit from the leader's numbers."""
    ours = zip(one.what.effects, leader.what.effects, strict=True)
    names = {
        f"{one.what.places[own.name]}.{p.name}": f"{leader.what.places[its.name]}.{p.name}"
        for own, its in ours
        for p in own.parameters
    }
    columns = [leader.what.space.keys.index(names.get(key, key)) for key in one.what.space.keys]
    return reduced(one.ruler, recounted(story.ruler_of(leader.what), one.ruler, leader), one.what, columns)


def refitted_elsewhere(story: Story, tried: Tried, found: dict[str, Fitted]) -> dict[str, Fitted]:
    """Effects that cannot be switched off, refitted from other strengths, where they are worth more than was found.

    Beside parameters that were bent to hide a lag or a clock, one strength tells little of what another promises.

    Args:
        found: what the other candidates have come to, and these.
    """
    story.now("refitting effects that cannot be switched off from other strengths")
    ends: dict[str, Fitted] = {}
    for name, one in tried.contenders.items():
        if one.effect.bypass:
            end = _on_probation(story, tried, one, partial(_lowest, tried, one), again=True)
            ends |= {} if end is None else {name: end}
    better: dict[str, Fitted] = {}
    for name in _worth_slopes(story, tried, ends, 0.5 * decide.FAIR)[:1]:
        end = _with_slopes(story, tried, tried.contenders[name], ends[name], None, leads=True, again=True)
        before = score(story, tried.current, found[name]) if name in found else 0.0
        if end is not None and score(story, tried.current, end) > before:
            better[name] = end
            story.say(f"refitted with {name}: sum of squares {tried.current.point.cost:.6g} -> {end.point.cost:.6g}")
    story.stage("refit leaders")
    return better


def part_of(tried: Tried, name: str, *, again: bool = False) -> str:
    """What the journal calls the refit with an effect more; that from other strengths where `again`."""
    return f"{tried.current.name} + {name}{' from other strengths' if again else ''}"


def _on_probation(
    story: Story, tried: Tried, one: Contender, find: Callable[[], Point | None], *, again: bool = False
) -> Fitted | None:
    """A cheap refit, and the nuisances that it leaves to blame."""
    part = f"{part_of(tried, one.effect.name, again=again)} on probation"
    kept = story.journal.once(part, lambda: _kept(tried, one, find()))
    if kept is None:
        return None
    x, cost = np.array(kept["x"]), float(kept["cost"])
    found = Fitted(one.what, Point(x, cost, np.zeros(0), np.zeros((0, x.size))))
    story.know(found, Blame(frozenset(Suspect(*s) for s in kept["blame"]), *kept["evidence"]))
    return found


def _worth_slopes(story: Story, tried: Tried, found: dict[str, Fitted], least: float) -> list[str]:
    """Names, the best first; none where parameters are bent and no refit takes this share of the misfit."""
    worth = not tried.bent or any(share(story, tried.current, one) > least for one in found.values())
    return by_score(story, tried.current, found) if worth else []


def _lowest(tried: Tried, one: Contender) -> Point | None:
    """A cheap refit from the strength that is best after a few steps; None where the model so far is as good."""
    current, _ = tried.beside(one)
    ends = [_end(one, current, footprint, _LOOK, slow_first=False) for footprint in elsewhere(current, one)]
    best = min((end for end in ends if end is not None), key=_cost, default=None)
    end = None if best is None else chord_refit(one.ruler, one.what, best, steps=_STEPS)
    return end if end is not None and end.cost < current.point.cost else None


def promising(tried: Tried) -> list[Footprint]:
    """The first of the ranking; several always, since the promise is one to first order only.

    Limits too where parameters have been bent: what a limit promises beside such is no guide.
    """
    heads = tried.heads
    enough = [k < 3 or tried.worth(f) > _PROMISE * tried.worth(heads[0]) for k, f in enumerate(heads)]
    first = [f for f, good in zip(heads[:_PROBATION], enough, strict=False) if good]
    names = [f.effect.name for f in first]
    return first + [f for f in heads if tried.bent and _is_limit(f.effect) and f.effect.name not in names]


def _kept(tried: Tried, one: Contender, point: Point | None) -> dict[str, Any] | None:
    if point is None:
        return None
    whole = replace(tried.ruler, solver=one.ruler.solver)
    blame = blamed(whole, whole.counted(point.x, one.ruler.whole(point)))
    suspects = sorted(astuple(suspect) for suspect in blame.suspects)
    return {"x": point.x.tolist(), "cost": point.cost, "blame": suspects, "evidence": [blame.cost, blame.price]}


def _probation(tried: Tried, one: Contender, nominal: Fitted | None) -> Point | None:
    """The best end of a few cheap refits; None where nothing is better than the model so far."""
    current, own = tried.beside(one)
    if not own:
        return None
    ends = [_end(one, current, own[0], _STEPS)]
    before = current.point.cost
    if (ends[0] is None or ends[0].cost > before) and len(own) > 1:
        ends.append(_end(one, current, min(own, key=lambda f: f.size), _STEPS))
    reached = before - min(end.cost for end in ends if end is not None) if any(ends) else 0.0
    if tried.bent and nominal is not None:
        there = recounted(tried.ruler, one.ruler, nominal)
        if reached < _KEPT * own[0].gain:
            ends.append(_end(one, there, own[0], _FAR_STEPS))
        if _is_limit(one.effect) and is_off(one.ruler, min(_better(ends, before), key=_cost, default=current.point)):
            ends.append(_limited(one, there))
    return min(_better(ends, before), key=_cost, default=None)


def _better(ends: Sequence[Point | None], before: float) -> list[Point]:
    return [end for end in ends if end is not None and end.cost < before]


def _end(one: Contender, current: Fitted, found: Footprint, steps: int, *, slow_first: bool = True) -> Point | None:
    """A refit from the model so far, with the effect off where it can be."""
    start = start_off(current, one.what, found) if len(one.effect.parameters) == 1 else None
    if start is None:
        size = start_amount(found.effect, found.amount)
        start = start_at(one.ruler, current, one.what, [(found, size)])
    return None if start is None else chord_refit(one.ruler, one.what, start, steps=steps, slow_first=slow_first)


def _limited(one: Contender, nominal: Fitted) -> Point | None:
    """A refit from the model's own parameters, with the limit where it fits best beside them.

    Parameters that have been bent to hide a limit say little of where it lies.
    """
    largest = largest_value(nominal, one)
    return None if not largest else best_of(one, nominal, list(limits(one.effect, largest)))


def _cost(end: Point) -> float:
    return end.cost


def _is_limit(effect: Effect) -> bool:
    return any(p.inverse for p in effect.strengths)


def start_amount(effect: Effect, amount: float) -> float:
    """Of the strength that was tried: near what looked best, but for limits, which act or do not."""
    if effect.bypass or _is_limit(effect):
        return 1.0
    return math.copysign(float(np.clip(abs(amount), 1 / 3, 3.0)), amount)


def _with_slopes(
    story: Story, tried: Tried, one: Contender, at: Fitted, nominal: Fitted | None, *, leads: bool, again: bool = False
) -> Fitted | None:
    """With slopes of its own; where the leader leaves more than noise does, from other starts too."""

    def find() -> tuple[Point, Array] | None:
        first = one.ruler.evaluation(one.what, at.point.x)
        end = refit_from(one.ruler, one.what, first, rounds=3 if tried.bent else 2) if first.good else None
        if leads and nominal is not None and not _does(one, end):
            end = _lower(end, unbent(one, at, recounted(tried.ruler, one.ruler, nominal)))
        if leads and end is not None and not _does(one, end):
            end = _lower(end, set_aside(one.ruler, one.what, end[0]))
        return end

    return story.fitted(one.what, part_of(tried, one.effect.name, again=again), find, one.ruler)


def _does(one: Contender, end: tuple[Point, Array] | None) -> bool:
    """Whether a refit leaves no more than noise."""
    return end is not None and as_noise(one.ruler, end[0])


def _lower(*ends: tuple[Point, Array] | None) -> tuple[Point, Array] | None:
    return min((end for end in ends if end is not None), key=lambda end: end[0].cost, default=None)


def finer(story: Story, one: Fitted, other: Fitted) -> float:
    """What a finer integration, both refitted, adds to the fall from the second's sum of squares to the first's."""
    ends = []
    for fitted in (one, other):
        fine = replace(story.ruler_of(fitted.what), solver=_FINE)
        start = run_again(fine, fitted)
        if start is None:
            return 0.0
        ends.append(chord_refit(fine, fitted.what, start, steps=3).cost)
    return ends[1] - ends[0] - (other.point.cost - one.point.cost)
