"""Which physical effect is missing: the steps in a row."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from pysim.diagnose import decide
from pysim.diagnose.fitted import Fitted
from pysim.diagnose.ledger import beside, ledger_step
from pysim.diagnose.refit import chord_refit, refit
from pysim.diagnose.residuals import Ruler, rulers
from pysim.diagnose.screen import Footprint, first_point, screen
from pysim.diagnose.subject import Extended, Subject, extended
from pysim.diagnose.where import failures
from pysim.identify.greybox.evaluation import Evaluation
from pysim.identify.greybox.uncertainty import Uncertainty, uncertainty, untold
from pysim.types import BadInput, Direction, Effect, Estimate, Stage, Told
from pysim.types.diagnosis import NONE, UNKNOWN, AddedEffect, Candidate, Diagnosis, LedgerStep

Array = NDArray[np.float64]
Say = Callable[[Told], None]

# Effects that may be added one after the other.
MOST = 3
# Candidates that get a refit on probation, and the share of the best gain that the screening has to promise for it.
_PROBATION, _PROMISE = 7, 0.02
# Candidates whose slopes are run again at every step.
_FINAL = 3


@dataclass
class _Story:
    """What the steps write down as they go; it stays within this module."""

    subject: Subject
    tell: Say
    seed: int
    ruler: Ruler
    held: Ruler | None
    ledger: list[LedgerStep] = field(default_factory=list)
    seconds: dict[str, float] = field(default_factory=dict)
    notes: list[str] = field(default_factory=list)
    ranking: list[Candidate] = field(default_factory=list)
    ties: list[tuple[str, ...]] = field(default_factory=list)
    stages: list[Stage] = field(default_factory=list)
    doing: str = ""
    begun: float = field(default_factory=time.monotonic)

    def now(self, doing: str) -> None:
        self.doing = doing
        self.tell(Told(doing))

    def say(self, text: str, step: LedgerStep | None = None) -> None:
        self.tell(Told(self.doing, text, step))

    def stage(self, name: str) -> None:
        now = time.monotonic()
        self.seconds[name] = self.seconds.get(name, 0.0) + now - self.begun
        self.begun = now

    def enter(self, name: str, at: Fitted) -> LedgerStep:
        found = beside(self.subject, at.what, at.point.x)
        step = ledger_step(name, found, at.point.cost)
        self.ledger.append(step)
        estimates, directions = ((), ()) if name == "prior" else _relative(self, at)
        where = failures(found.records, self.subject.dataset)
        self.stages.append(Stage(name, estimates, directions, found.records, found.responses, where))
        self.notes += [note for note in found.notes if note not in self.notes]
        held = "" if step.validate is None else f", held out {step.validate:.3f}"
        fitted = "" if step.fit is None else f" {step.fit:.3f}{held};"
        self.say(f"{name}: residual over noise{fitted} sum of squares {step.cost:.6g}", step)
        self.stage("ledger")
        return step


def diagnose(
    subject: Subject, *, seed: int = 0, most: int = MOST, workers: int | None = None, progress: Say | None = None
) -> Diagnosis:
    """Answer which effect of the catalogue the data demand, that they demand none, or that it is unknown.

    Args:
        subject: model, measurements, catalogue.
        seed: of the bootstrap; the same seed gives the same answer.
        most: effects that may be added one after the other.
        workers: runs at a time; all cores where None. The answer does not depend on it.
        progress: told what is being done and what was learned.
    Raises:
        BadInput: the base model cannot be simulated at its own parameters.
    """
    ruler, held = rulers(subject.targets, workers)
    story = _Story(subject, progress or (lambda told: None), seed, ruler, held, notes=list(subject.notes))
    nominal, base = _base(story)
    current = base
    added: list[Effect] = []
    for _ in range(most):
        found = _next_effect(story, current, nominal if not added else None)
        if found is None:
            break
        current, effect = found
        added.append(effect)
        story.enter(effect.name, current)
        if current.point.cost / current.point.residual.size < decide.COMPLETE and decide.excess(current.point) < 1.0:
            break
    return _answer(story, base, current)


def _base(story: _Story) -> tuple[Fitted, Fitted]:
    """The base model as it is, and refitted."""
    what = extended(story.subject, ())
    story.now("comparing the model as it is")
    first = story.ruler.evaluation(what, what.space.to_search(what.space.start))
    if not first.good:
        raise BadInput(f"{what.model.path.name} cannot be simulated through the tests at its own parameters")
    nominal = Fitted(what, first)
    story.stage("compare")
    story.enter("prior", nominal)
    story.now("refitting the model")
    best = refit(story.ruler, what, first.x, rounds=5)
    story.stage("refit")
    base = Fitted(what, best)
    story.enter("refit", base)
    return nominal, base


def _next_effect(story: _Story, current: Fitted, nominal: Fitted | None) -> tuple[Fitted, Effect] | None:
    """The effect to add to the model so far, or None."""
    if story.subject.build_variant is None:
        story.notes.append("the model's Modelica class is not at hand, so no effect of the catalogue could be tried")
        return None
    story.now(f"compiling {len(story.subject.catalogue)} candidates")
    candidates = _candidates(story, current)
    story.stage("build")
    story.now(f"screening {len(candidates)} candidates")
    footprints = screen(story.ruler, current.what, current.point, candidates)
    chance = decide.chance(footprints, scale=1.0, seed=story.seed)
    story.stage("screen")
    best = footprints[0].gain if footprints else 0.0
    heads = ", ".join(f"{f.effect.name} {f.gain:.4g}" for f in _per_effect(footprints)[:3])
    story.say(f"screened {len(candidates)} effects: {heads}; by chance up to {chance.limit:.3g}")
    bent = current.point.cost > 2 * current.point.residual.size
    if best < chance.limit and not bent:
        _rank_screened(story, current, footprints)
        return None
    return _refitted(story, current, nominal if bent else None, candidates, footprints)


def _candidates(story: _Story, current: Fitted) -> list[tuple[Effect, Extended]]:
    found = []
    for effect in story.subject.catalogue:
        if effect.name in [e.name for e in current.what.effects]:
            continue
        try:
            found.append((effect, extended(story.subject, [*current.what.effects, effect])))
        except BadInput as error:
            story.notes.append(f"{effect.name} could not be tried: {error}")
    return found


def _per_effect(footprints: Sequence[Footprint]) -> list[Footprint]:
    """The best footprint of each effect."""
    best: dict[str, Footprint] = {}
    for footprint in footprints:
        best.setdefault(footprint.effect.name, footprint)
    return list(best.values())


def _rank_screened(story: _Story, current: Fitted, footprints: Sequence[Footprint]) -> None:
    if story.ranking:
        return
    n = current.point.residual.size
    for f in _per_effect(footprints):
        story.ranking.append(
            Candidate(
                f.effect.name,
                f.gain - len(f.effect.parameters) * math.log(n),
                decide.p_value(f.gain, 1, scale=1.0),
                decide.explained(f.gain, current.point.cost, n),
                refitted=False,
                parameters=f.values,
            )
        )


def _refitted(
    story: _Story,
    current: Fitted,
    nominal: Fitted | None,
    candidates: list[tuple[Effect, Extended]],
    footprints: Sequence[Footprint],
) -> tuple[Fitted, Effect] | None:
    """Refit the promising, compare, and take the best where it is good enough."""
    models = {effect.name: what for effect, what in candidates}
    heads = _per_effect(footprints)
    chosen = [(current, f) for f in _promising(heads)]
    if nominal is not None:
        others = _per_effect(screen(story.ruler, nominal.what, nominal.point, candidates))
        chosen += [(nominal, f) for f in _promising(others)]
        story.stage("screen")
    story.now("refitting the promising candidates")
    tried: dict[str, Fitted] = {}
    for at, footprint in chosen:
        name = footprint.effect.name
        start = first_point(story.ruler, at.what, models[name], at.point, footprint)
        if start is None:
            continue
        end = chord_refit(story.ruler, models[name], start, steps=5)
        if name not in tried or end.cost < tried[name].point.cost:
            tried[name] = Fitted(models[name], end)
    story.stage("refit candidates")
    order = _ordered(current, tried)
    for name in order[:_FINAL]:
        if name != order[0] and _score(current, tried[name]) < 0.7 * _score(current, tried[order[0]]):
            continue
        end = refit(story.ruler, models[name], tried[name].point.x, rounds=3)
        if end.good and end.cost < tried[name].point.cost:
            tried[name] = Fitted(models[name], end)
        story.say(f"refitted with {name}: sum of squares {current.point.cost:.6g} -> {tried[name].point.cost:.6g}")
    story.stage("refit leaders")
    return _chosen(story, current, tried, heads)


def _promising(heads: Sequence[Footprint]) -> list[Footprint]:
    """The first of the ranking; several always, since the promise is one to first order only."""
    enough = [k < 3 or f.gain > _PROMISE * heads[0].gain for k, f in enumerate(heads)]
    return [f for f, good in zip(heads[:_PROBATION], enough, strict=False) if good]


def _score(current: Fitted, fitted: Fitted) -> float:
    extra = fitted.point.x.size - current.point.x.size
    return decide.score(current.point.cost, fitted.point.cost, extra, current.point.residual.size)


def _ordered(current: Fitted, tried: dict[str, Fitted]) -> list[str]:
    return sorted(tried, key=lambda name: -_score(current, tried[name]))


def _chosen(
    story: _Story, current: Fitted, tried: dict[str, Fitted], heads: Sequence[Footprint]
) -> tuple[Fitted, Effect] | None:
    order = _ordered(current, tried)
    if not order:
        return None
    n = current.point.residual.size
    leader = tried[order[0]]
    scale = decide.inflation(leader.point)
    freedom = n - leader.point.x.size
    rows = []
    for name in order:
        extra = tried[name].point.x.size - current.point.x.size
        gain = current.point.cost - tried[name].point.cost
        share = decide.explained(gain, current.point.cost, freedom)
        values = _own_values(tried[name], tried[name].what.effects[-1])
        rows.append(
            Candidate(name, _score(current, tried[name]), decide.p_value(gain, extra, scale=scale), share, True, values)
        )
    if not story.ranking:
        story.ranking += rows
        done = {row.effect for row in rows}
        _rank_rest(story, current, [f for f in heads if f.effect.name not in done])
    best = rows[0]
    if best.score <= 0 or best.p_value * len(story.subject.catalogue) > decide.ALARM or best.explained < decide.FAIR:
        story.say(f"{best.effect} takes {100 * best.explained:.1f} % of the misfit: not enough to be named")
        return None
    ties = tuple(row.effect for row in rows if best.score - row.score < decide.TIE * scale)
    if len(ties) > 1:
        story.ties.append(ties)
    story.say(f"added {best.effect}: {100 * best.explained:.1f} % of the misfit explained")
    return leader, leader.what.effects[-1]


def _rank_rest(story: _Story, current: Fitted, footprints: Sequence[Footprint]) -> None:
    n = current.point.residual.size
    for f in footprints:
        extra = len(f.effect.parameters)
        story.ranking.append(
            Candidate(
                f.effect.name,
                f.gain - extra * math.log(n),
                decide.p_value(f.gain, 1, scale=1.0),
                decide.explained(f.gain, current.point.cost, n),
                False,
                f.values,
            )
        )


def _own_values(fitted: Fitted, effect: Effect) -> dict[str, float]:
    values = fitted.what.space.values(fitted.point.x)
    return {p.name: values[f"{fitted.what.places[effect.name]}.{p.name}"] for p in effect.parameters}


def _answer(story: _Story, base: Fitted, final: Fitted) -> Diagnosis:
    verdict, reason = _verdict(story, base, final)
    what = final.what
    doubt = _doubt(story, final)[0]
    relative, held = _relative(story, final)
    if what.effects:
        names = [next(iter(d.exponents)) for d in held]
        story.notes += [
            f"intervals of the effects hold {n}, which these data do not determine by itself" for n in names
        ]
    estimates = {e.name: e for e in relative}
    added = tuple(AddedEffect(e, what.places[e.name], _estimates_of(e, what, estimates)) for e in what.effects)
    story.stage("intervals")
    story.say(f"verdict: {verdict}. {reason}")
    return Diagnosis(
        verdict,
        reason,
        added,
        tuple(story.ranking),
        tuple(story.ties),
        tuple(story.ledger),
        doubt.estimates,
        next(stage.where for stage in story.stages if stage.step == "refit"),
        story.seconds,
        tuple(story.notes),
        stages=tuple(story.stages),
    )


def _doubt(story: _Story, fitted: Fitted) -> tuple[Uncertainty, Evaluation, float]:
    """Intervals of a fitted model, its point with the same information in n rows, and what the noise is widened by."""
    point = fitted.point
    short = replace(point, jacobian=np.asarray(np.linalg.qr(point.jacobian, mode="r")))
    size = float(np.sqrt(decide.inflation(point)))
    return uncertainty(fitted.what.space, short, scale=size, told=not untold(story.subject.notes)), short, size


def _relative(story: _Story, fitted: Fitted) -> tuple[tuple[Estimate, ...], tuple[Direction, ...]]:
    """Estimates with one parameter of each exactly undetermined direction held where it stands, and those directions.

    A direction that scales every force leaves no force an interval of its own, though an effect is there for certain.
    """
    doubt, point, scale = _doubt(story, fitted)
    space, slopes, held = fitted.what.space, point.jacobian.copy(), []
    for direction in doubt.known.directions:
        name = next((name for name in story.subject.free if name in direction.exponents), "")
        if math.isinf(direction.spread) and name:
            slopes[:, space.keys.index(name)] = 0.0
            order = dict(sorted(direction.exponents.items(), key=lambda item: item[0] != name))
            held.append(replace(direction, exponents=order))
    if not held:
        return doubt.estimates, ()
    found = uncertainty(space, replace(point, jacobian=slopes), scale=scale, told=not untold(story.subject.notes))
    return found.estimates, tuple(held)


def _estimates_of(effect: Effect, what: Extended, estimates: dict[str, Estimate]) -> tuple[Estimate, ...]:
    return tuple(estimates[f"{what.places[effect.name]}.{p.name}"] for p in effect.parameters)


def _verdict(story: _Story, base: Fitted, final: Fitted) -> tuple[str, str]:
    point, names = final.point, [e.name for e in final.what.effects]
    freedom = point.residual.size - point.x.size
    left = point.cost / max(freedom, 1)
    share = decide.explained(base.point.cost - point.cost, base.point.cost, freedom)
    complete = left < decide.COMPLETE or (names and share >= decide.WHOLE)
    if not names:
        if complete:
            return NONE, f"the refitted base model explains the data to {left:.3f} times the noise's variance"
        return UNKNOWN, f"{left:.3g} times the noise's variance is left, and no effect takes a fair share of it"
    if complete:
        verb = "explains" if len(names) == 1 else "explain"
        return names[0], f"{' and '.join(names)} {verb} {100 * share:.1f} % of what the base model leaves over noise"
    return (
        UNKNOWN,
        f"{' and '.join(names)} help, but {left:.3g} times the noise's variance is left; something else is missing",
    )
