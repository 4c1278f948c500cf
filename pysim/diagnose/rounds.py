"""One round of the search: which effect the model so far lacks most."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import asdict, astuple, dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pysim.diagnose import decide
from pysim.diagnose.blame import Blame
from pysim.diagnose.contenders import Contender
from pysim.diagnose.corrections import as_noise, blamed, evidence, is_off, recounted
from pysim.diagnose.fitted import Fitted
from pysim.diagnose.nuisance import Suspect
from pysim.diagnose.null import chance
from pysim.diagnose.refit import chord_refit, refit_from
from pysim.diagnose.residuals import Ruler
from pysim.diagnose.screen import Footprint, across, column_space, footprint, per_effect, screen
from pysim.diagnose.start import start_at, start_off
from pysim.diagnose.story import Story
from pysim.diagnose.strengths import translated
from pysim.identify.greybox.evaluation import Evaluation
from pysim.simulate import Rodas
from pysim.types import BadInput, Candidate, Effect

Array = NDArray[np.float64]

# Candidates that get a refit on probation, and the share of the best gain that the screening has to promise for it.
_PROBATION, _PROMISE = 7, 0.05
# Candidates whose slopes are run, and the share of the best score that a refit on probation has to reach for it.
_FINAL, _NEAR = 3, 0.8
# Where a refit reaches less than this share of what was promised, straight lines were no guide, and another start is.
_KEPT = 0.5
# Points tried on probation, and from parameters far off.
_STEPS, _FAR_STEPS = 6, 9
# Mean square residual from which the parameters of the model so far count as bent.
_BENT = 2.0
# Integration of ties.
_FINE = Rodas(rtol=1e-7, atol=1e-7)


@dataclass(frozen=True)
class Tried:
    """What a round tried.

    Args:
        current: the model so far.
        ruler: that counts it.
        contenders: by the name of the effect, each with the ruler that allows for the nuisances it leaves to blame.
        footprints: of all, the best gain first; every nuisance is allowed for.
        instead: by the name of the effect, by how much it is more likely, with the nuisances that it leaves to blame,
            than those that are to blame without it.
        limit: gain that chance alone exceeds seldom.
        left: sum of squares that the model so far leaves beside the nuisances that are to blame without any effect.
    """

    current: Fitted
    ruler: Ruler
    contenders: dict[str, Contender]
    footprints: tuple[Footprint, ...]
    instead: dict[str, float]
    limit: float
    left: float

    @property
    def bent(self) -> bool:
        """Whether so much is left that the parameters have left their place to make up for it."""
        return self.left > _BENT * self.current.point.residual.size

    @property
    def promises(self) -> bool:
        """Whether some effect promises more than chance does, or straight lines are not to be trusted."""
        return self.bent or any(self.worth(head) >= self.limit for head in self.heads)

    @property
    def heads(self) -> list[Footprint]:
        """The best footprint of each effect, the most promising effect first."""
        return sorted(per_effect(self.footprints), key=lambda head: -self.worth(head))

    def beside(self, one: Contender) -> tuple[Fitted, list[Footprint]]:
        """The model so far as a contender's ruler counts it, and the contender's footprints there, the best first."""
        current, own = recounted(self.ruler, one.ruler, self.current), list[Footprint]()
        span = column_space(current.point.jacobian)
        left_over = across(span, current.point.residual)
        for f in self.footprints:
            if f.effect.name == one.effect.name:
                change = one.ruler.span.across(f.plain[:, None])[:, 0]
                own += footprint(f.effect, f.values, change, span, left_over)
        return current, sorted(own, key=lambda f: -f.gain)

    def worth(self, head: Footprint) -> float:
        """What an effect promises: what it explains itself, or what it explains in place of nuisances."""
        return max(head.gain, self.instead.get(head.effect.name, 0.0))


def screened(story: Story, current: Fitted) -> Tried:
    """Every effect of the catalogue that the model so far lacks, in a run or two."""
    missing = [e for e in story.subject.catalogue if e.name not in [had.name for had in current.what.effects]]
    story.now(f"compiling {len(missing)} candidates")
    contenders = {}
    for effect in missing:
        try:
            contenders[effect.name] = story.extended(current, effect)
        except BadInput as error:
            story.note(f"{effect.name} could not be tried: {error}")
    story.stage("build")
    story.now(f"screening {len(contenders)} candidates")
    footprints = screen(current, list(contenders.values()))
    limit = chance(footprints, scale=1.0, seed=story.seed).limit
    ruler = story.ruler_of(current.what)
    none = story.blame(current)
    left_to = {} if is_off(ruler, current.point) else _left_to(ruler, current, footprints)
    for name, blame in left_to.items():
        one = contenders[name]
        contenders[name] = replace(one, ruler=one.ruler.only(blame.suspects))
    note_mimics(story, none, left_to)
    instead = {name: blame.over(none) for name, blame in left_to.items()}
    tried = Tried(current, ruler, contenders, footprints, instead, limit, none.cost)
    story.stage("screen")
    heads = ", ".join(f"{f.effect.name} {tried.worth(f):.4g}" for f in tried.heads[:3])
    story.say(f"screened {len(contenders)} effects: {heads}; by chance up to {limit:.3g}")
    return tried


def _left_to(ruler: Ruler, current: Fitted, footprints: Sequence[Footprint]) -> dict[str, Blame]:
    """By the name of the effect the nuisances that it leaves to blame."""
    found = evidence(ruler, current.point, [f.plain for f in footprints])
    best = dict[str, Blame]()
    for f, blame in zip(footprints, found.beside([f.signed for f in footprints]), strict=True):
        if f.effect.name not in best or blame.total < best[f.effect.name].total:
            best[f.effect.name] = blame
    return best


def note_mimics(story: Story, none: Blame, left_to: Mapping[str, Blame]) -> None:
    """Tells which effects would do what one nuisance does."""
    mimics: dict[Suspect, list[str]] = {}
    for name, blame in left_to.items():
        spared = none.suspects - blame.suspects
        if len(spared) == 1 and abs(blame.over(none)) < decide.TIE:
            mimics.setdefault(next(iter(spared)), []).append(name)
    for suspect, names in mimics.items():
        of = f"the {suspect.kind} of {suspect.signal}" if suspect.signal else "the shift of clocks"
        story.note(f"{' or '.join(sorted(names))} would do what {of} does: these data cannot tell them apart")


def refitted(
    story: Story, tried: Tried, nominal: Fitted | None, *, least: float = 0.5 * decide.FAIR
) -> dict[str, Fitted]:
    """The promising candidates refitted: all on probation, the leaders with slopes of their own.

    Args:
        nominal: the base model at its own parameters, counted without nuisances, where refits start too if those found
            have been bent.
        least: share of the misfit that a refit on probation has to take for slopes of its own.
    """
    story.now("refitting the promising candidates")
    if nominal is not None:
        nominal = recounted(story.first, tried.ruler, nominal)
    found: dict[str, Fitted] = {}
    for head in _promising(tried):
        one = tried.contenders[head.effect.name]
        part = f"{name_of(tried.current)} + {head.effect.name} on probation"
        kept = story.journal.once(part, lambda one=one: _kept(tried, one, _probation(tried, one, nominal)))  # type: ignore[misc]
        if kept is not None:
            x, cost = np.array(kept["x"]), float(kept["cost"])
            found[head.effect.name] = Fitted(one.what, Evaluation(x, cost, np.zeros(0), np.zeros((0, x.size))))
            story.know(found[head.effect.name], Blame(frozenset(Suspect(*s) for s in kept["blame"]), *kept["evidence"]))
    story.stage("refit candidates")
    worth = not tried.bent or any(share(story, tried.current, one) > least for one in found.values())
    order = by_score(story, tried.current, found) if worth else []
    best = score(story, tried.current, found[order[0]]) if order else 0.0
    for name in order[:_FINAL]:
        if score(story, tried.current, found[name]) < _NEAR * best and name != order[0]:
            continue
        end = _leader(story, tried, tried.contenders[name], found[name], nominal if name == order[0] else None)
        if end is not None:
            found[name] = end
            story.say(
                f"refitted with {name}: sum of squares {tried.current.point.cost:.6g} -> {found[name].point.cost:.6g}"
            )
    story.stage("refit leaders")
    return found


def _promising(tried: Tried) -> list[Footprint]:
    """The first of the ranking; several always, since the promise is one to first order only."""
    heads = tried.heads
    enough = [k < 3 or tried.worth(f) > _PROMISE * tried.worth(heads[0]) for k, f in enumerate(heads)]
    return [f for f, good in zip(heads[:_PROBATION], enough, strict=False) if good]


def _kept(tried: Tried, one: Contender, point: Evaluation | None) -> dict[str, Any] | None:
    if point is None:
        return None
    whole = replace(tried.ruler, solver=one.ruler.solver)
    blame = blamed(whole, whole.counted(point.x, one.ruler.whole(point)))
    suspects = sorted(astuple(suspect) for suspect in blame.suspects)
    return {"x": point.x.tolist(), "cost": point.cost, "blame": suspects, "evidence": [blame.cost, blame.price]}


def _probation(tried: Tried, one: Contender, nominal: Fitted | None) -> Evaluation | None:
    """The best end of a few cheap refits; None where nothing is better than the model so far."""
    current, own = tried.beside(one)
    if not own:
        return None
    ends = [_end(one, current, own[0], _STEPS)]
    before = current.point.cost
    if (ends[0] is None or ends[0].cost > before) and len(own) > 1:
        ends.append(_end(one, current, min(own, key=lambda f: f.size), _STEPS))
    reached = before - min(end.cost for end in ends if end is not None) if any(ends) else 0.0
    if nominal is not None and reached < _KEPT * own[0].gain:
        ends.append(_end(one, recounted(tried.ruler, one.ruler, nominal), own[0], _FAR_STEPS))
    good = [end for end in ends if end is not None and end.cost < before]
    return min(good, key=lambda end: end.cost) if good else None


def _end(one: Contender, current: Fitted, found: Footprint, steps: int) -> Evaluation | None:
    """A refit from the model so far, with the effect off where it can be."""
    start = start_off(current, one.what, found) if len(one.effect.parameters) == 1 else None
    if start is None:
        size = start_amount(found.effect, found.amount)
        start = start_at(one.ruler, current, one.what, [(found, size)])
    return None if start is None else chord_refit(one.ruler, one.what, start, steps=steps)


def start_amount(effect: Effect, amount: float) -> float:
    """Of the strength that was tried: near what looked best, but for limits, which act or do not."""
    if effect.bypass or any(p.inverse for p in effect.strengths):
        return 1.0
    return math.copysign(float(np.clip(abs(amount), 1 / 3, 3.0)), amount)


def _leader(story: Story, tried: Tried, one: Contender, at: Fitted, nominal: Fitted | None) -> Fitted | None:
    """With slopes of its own; from the model's own parameters too where that leaves more than noise does."""

    def refitted_from(x: Array) -> tuple[Evaluation, Array] | None:
        first = one.ruler.evaluation(one.what, x)
        return refit_from(one.ruler, one.what, first, rounds=3 if tried.bent else 2) if first.good else None

    def find() -> tuple[Evaluation, Array] | None:
        end = refitted_from(at.point.x)
        if nominal is None or (end is not None and as_noise(one.ruler, end[0])):
            return end
        other = refitted_from(_beside(nominal, one, at))
        ends = [e for e in (end, other) if e is not None]
        return min(ends, key=lambda e: e[0].cost, default=None)

    return story.fitted(one.what, f"{name_of(tried.current)} + {one.effect.name}", find, one.ruler)


def _beside(nominal: Fitted, one: Contender, at: Fitted) -> Array:
    """The effects as they were found, (n,), beside the model's own parameters."""
    space = one.what.space
    own = translated(nominal.what, one.what, nominal.what.space.values(nominal.point.x))
    values = {**space.values(at.point.x), **own}
    return space.to_search(np.array([values[key] for key in space.keys]))


def score(story: Story, current: Fitted, fitted: Fitted) -> float:
    """What the effects added are worth, less the cost of their parameters."""
    extra = fitted.point.x.size - current.point.x.size
    return gain(story, current, fitted) - decide.price(extra, current.point.residual.size)


def gain(story: Story, current: Fitted, fitted: Fitted) -> float:
    """Fall of the sum of squares, each model with the nuisances that are to blame beside it."""
    return story.blame(fitted).over(story.blame(current))


def share(story: Story, current: Fitted, fitted: Fitted) -> float:
    """Of the avoidable misfit that the effects added take, 0 ... 1."""
    freedom = current.point.residual.size - current.point.x.size
    return decide.explained(gain(story, current, fitted), story.blame(current).cost, freedom)


def by_score(story: Story, current: Fitted, found: dict[str, Fitted]) -> list[str]:
    """Names, the best first."""
    return sorted(found, key=lambda name: -score(story, current, found[name]))


def promise(tried: Tried, at: Fitted) -> float:
    """The best gain of what was tried, were it asked again at another model: footprints hardly change, slopes do."""
    names = [effect.name for effect in at.what.effects]
    span = column_space(at.point.jacobian)
    left_over = across(span, at.point.residual)
    again = (
        found.gain
        for old in tried.footprints
        if old.effect.name not in names
        for found in footprint(old.effect, old.values, old.change, span, left_over)
    )
    return max(again, default=0.0)


def finer(story: Story, one: Fitted, other: Fitted) -> float:
    """What a finer integration, both refitted, adds to the fall from the second's sum of squares to the first's."""
    ends = []
    for fitted in (one, other):
        fine = replace(story.ruler_of(fitted.what), solver=_FINE)
        residual = fine.at(fitted.what, fitted.point.x)
        if residual is None:
            return 0.0
        start = Evaluation(fitted.point.x, float(residual @ residual), residual, fitted.point.jacobian)
        ends.append(chord_refit(fine, fitted.what, start, steps=3).cost)
    return ends[1] - ends[0] - (other.point.cost - one.point.cost)


def rows(story: Story, tried: Tried, found: dict[str, Fitted], number: int) -> list[Candidate]:
    """Every candidate considered, the refitted ones first, the best of each first."""
    current = tried.current.point
    freedom, before = current.residual.size - current.x.size, story.blame(tried.current).cost
    order = by_score(story, tried.current, found)
    listed = []
    for name in order:
        extra = found[name].point.x.size - current.x.size
        fall = gain(story, tried.current, found[name])
        scale = decide.inflation(current, found[name].point.cost)
        part = share(story, tried.current, found[name])
        values = own_values(found[name], name)
        worth = score(story, tried.current, found[name])
        listed.append(Candidate(name, worth, decide.p_value(fall, extra, scale=scale), part, True, values, number))
    useless = [f for f in _promising(tried) if found and f.effect.name not in found]
    for f in useless:
        price = decide.price(len(f.effect.parameters), current.residual.size)
        listed.append(Candidate(f.effect.name, -price, 1.0, 0.0, True, f.values, number))
    for f in tried.heads:
        if f.effect.name not in [row.effect for row in listed]:
            promised = tried.worth(f)
            worth = promised - decide.price(len(f.effect.parameters), current.residual.size)
            part = decide.explained(promised, before, freedom)
            by_chance = decide.p_value(promised, 1, scale=1.0)
            listed.append(Candidate(f.effect.name, worth, by_chance, part, False, f.values, number))
    return listed


def own_values(fitted: Fitted, name: str) -> dict[str, float]:
    """An effect's parameters, by their names as declared."""
    values, what = fitted.what.space.values(fitted.point.x), fitted.what
    effect = next(e for e in what.effects if e.name == name)
    return {p.name: values[f"{what.places[name]}.{p.name}"] for p in effect.parameters}


def name_of(current: Fitted) -> str:
    """What a model is made of."""
    return " + ".join(["base", *(e.name for e in current.what.effects)])


def as_data(listed: Sequence[Candidate]) -> list[dict[str, Any]]:
    """Rows for the journal."""
    return [{**asdict(row), "parameters": dict(row.parameters)} for row in listed]
