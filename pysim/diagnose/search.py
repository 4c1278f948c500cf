"""The search: one effect after the other, pairs where single ones do not do, and none that is not needed."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from functools import partial
from types import MappingProxyType
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pysim.diagnose import decide
from pysim.diagnose.corrections import Settled, as_noise, is_off
from pysim.diagnose.fitted import Fitted
from pysim.diagnose.graduated import is_far
from pysim.diagnose.null import ALARM, leftover
from pysim.diagnose.pairs import Pair, joint
from pysim.diagnose.ranking import as_data, rows
from pysim.diagnose.reduced import reduced
from pysim.diagnose.refit import chord_refit, refit_from
from pysim.diagnose.rounds import Tried, promise, screened
from pysim.diagnose.scores import by_score, gain, score, share
from pysim.diagnose.screen import across, column_space
from pysim.diagnose.settling import settle
from pysim.diagnose.start import start_at
from pysim.diagnose.story import Story
from pysim.diagnose.strengths import translated
from pysim.diagnose.subject import Extended, extended
from pysim.diagnose.trials import finer, part_of, refitted, refitted_elsewhere, start_amount
from pysim.identify.greybox.residuals import Point
from pysim.types import BadInput, Candidate

Array = NDArray[np.float64]

# Pairs that are refitted, and by how many times the best single gain a pair has to exceed it.
_PAIRS, _TOGETHER = 3, 1.5
# Another round is in vain where noise alone leaves as much with more than this chance, and no footprint promises this
# share of what chance does.
_QUIET, _HOPE = 0.05, 0.5
# What a round comes to where nothing is found: rows of the ranking, groups that tie, effects that are added, parts of
# the journal that hold the refit with them and with each of those tied, what is said, whether another round is in vain.
_NOTHING: Mapping[str, Any] = MappingProxyType(
    {"rows": [], "ties": [], "chosen": [], "part": "", "rivals": {}, "said": "", "done": False}
)


def search(story: Story, nominal: Fitted, base: Settled, most: int) -> tuple[Settled, Settled]:
    """Add effects while the data demand one.

    Returns:
        the base model, at a better end of its refit where the first effect has shown one, and the model with all
        effects.
    """
    current = base
    for number in range(1, most + 1):
        if len(current.at.what.effects) >= most:  # a round may add two
            break
        found = _round(story, current.whole, nominal if number == 1 else None, number, most)
        if found is not None and number == 1:
            better = _freed(story, base, found)
            if better is not None:
                base = current = better
                found = _round(story, current.whole, nominal, number, most)
        if found is None:
            break
        needed, known = _without_the_needless(story, found), current.at.what.effects
        current = settle(story, needed, needed.name)
        story.enter(" + ".join(e.name for e in needed.what.effects if e not in known), current.at)
        if story.journal.once(f"round {number}", dict)["done"]:
            break
    return base, current


def _freed(story: Story, base: Settled, found: Fitted) -> Settled | None:
    """The base model refitted from where an effect has led it, where that is much nearer to the measurements.

    Its refit had ended in a dent of the sum of squares then, and any effect would have seemed to help it out.
    """
    if not is_off(base.ruler, base.whole.point):
        return None
    story.now("refitting the model from where the effect has led it")
    what = base.whole.what
    out = story.fitted(what, f"{found.name} without it", partial(_without, story, found, what))
    before = base.whole.point
    freedom = before.residual.size - before.x.size
    if out is None or decide.explained(before.cost - out.point.cost, before.cost, freedom) < decide.FAIR:
        story.stage("refit leaders")
        return None
    story.afresh()
    end = settle(story, out, "base")
    story.say(f"it had ended in a dent: sum of squares {before.cost:.6g} -> {end.at.point.cost:.6g}")
    story.stage("refit")
    story.enter("refit", end.at)
    return end


def _round(story: Story, current: Fitted, nominal: Fitted | None, number: int, most: int) -> Fitted | None:
    """The model so far with what it lacks most, or None."""
    told = story.journal.once(f"round {number}", lambda: _played(story, current, nominal, number, most))
    if not story.ranking or number > max(row.round for row in story.ranking):
        story.ranking += [Candidate(**row) for row in told["rows"]]
        story.ties += [tuple(group) for group in told["ties"]]
    if told["said"]:
        story.say(told["said"])
    if not told["chosen"]:
        story.refused = told["said"]
        return None
    named = {e.name: e for e in story.subject.catalogue}
    what = extended(story.subject, [*current.what.effects, *(named[name] for name in told["chosen"])])
    found = story.fitted(what, told["part"], lambda: None)
    for group in told["ties"]:  # the leader stands first
        rival = extended(story.subject, [*current.what.effects, named[group[1]]])
        other = story.fitted(rival, told["rivals"][group[1]], lambda: None)
        if found is not None and other is not None:
            story.tied = found, other
    return found


def _played(story: Story, current: Fitted, nominal: Fitted | None, number: int, most: int) -> dict[str, Any]:
    tried = screened(story, current)
    if not tried.promises:
        return {**_NOTHING, "rows": as_data(rows(story, tried, {}, number))}
    found = refitted(story, tried, nominal)
    answer = _alone(story, tried, found, number)
    point = tried.current.point
    if not answer["chosen"] and not as_noise(tried.ruler, point) and not is_far(tried.ruler, point):
        better = refitted_elsewhere(story, tried, found)
        again = _alone(story, tried, {**found, **better}, number, better) if better else answer
        answer = again if again["chosen"] else answer
    if not answer["chosen"] and len(current.what.effects) + 2 <= most:
        names = _together(story, tried, found)
        if names:
            part = f"{current.name} + {' + '.join(names)}"
            said = f"added {' and '.join(names)}, which work together"
            return {**answer, "ties": [], "chosen": names, "part": part, "said": said}
    return answer


def _alone(
    story: Story, tried: Tried, found: dict[str, Fitted], number: int, again: Collection[str] = ()
) -> dict[str, Any]:
    """The best single effect, if nothing speaks against it.

    Args:
        again: effects of those found that were refitted from other strengths.
    """
    listed = rows(story, tried, found, number)
    answer = {**_NOTHING, "rows": as_data(listed)}
    order = by_score(story, tried.current, {name: one for name, one in found.items() if one.point.residual.size})
    if not order:
        return answer
    leader, ties = _first(story, tried.current, found, order)
    answer["ties"] = [ties] if len(ties) > 1 else []
    trouble = _objection(story, tried.current, found[leader])
    if trouble:
        return {**answer, "said": trouble}
    row = next(row for row in listed if row.effect == leader)
    taken = f", {100 * row.explained:.1f} % of the misfit explained" if row.explained else ""
    said = f"added {leader}: score {row.score:.4g}{taken}"
    done = _nothing_left(story, tried, found[leader])
    parts = {name: part_of(tried, name, again=name in again) for name in ties}
    return {**answer, "chosen": [leader], "part": parts[leader], "rivals": parts, "said": said, "done": done}


def _together(story: Story, tried: Tried, found: dict[str, Fitted]) -> list[str]:
    """Two effects that do together what none does alone."""
    point = tried.current.point
    left_over = across(column_space(point.jacobian), point.residual)
    alone = max([tried.limit, *(point.cost - one.point.cost for one in found.values())])
    pairs = [pair for pair in joint(tried.footprints, left_over)[:_PAIRS] if pair.gain > _TOGETHER * alone]
    if pairs:
        story.now("refitting pairs of effects")
    ends: dict[tuple[str, str], Fitted] = {}
    for pair in pairs:
        end = _pair(story, tried, pair, min([point.cost, *(one.point.cost for one in found.values())]))
        if end is not None:
            ends[pair.names] = end
    story.stage("refit pairs")
    if not ends:
        return []
    best = max(ends, key=lambda names: score(story, tried.current, ends[names]))
    return [] if _objection(story, tried.current, ends[best]) else list(best)


def _pair(story: Story, tried: Tried, pair: Pair, enough: float) -> Fitted | None:
    """The model with both, where that is better than with any alone."""
    one, other = (part.effect for part in pair.parts)
    try:
        contender = story.extended(tried.current, one, other)
    except BadInput as error:
        story.note(f"{one.name} and {other.name} could not be tried together: {error}")
        return None

    def find() -> tuple[Point, Array] | None:
        amounts = [start_amount(part.effect, a) for part, a in zip(pair.parts, pair.amounts, strict=True)]
        start = start_at(contender.ruler, tried.current, contender.what, list(zip(pair.parts, amounts, strict=True)))
        if start is None:
            return None
        end = chord_refit(contender.ruler, contender.what, start, steps=8)
        if end.cost > enough:
            return None
        first = contender.ruler.evaluation(contender.what, end.x)
        return refit_from(contender.ruler, contender.what, first, rounds=2) if first.good else None

    end = story.fitted(contender.what, f"{tried.current.name} + {' + '.join(pair.names)}", find)
    if end is not None:
        before, after = tried.current.point.cost, end.point.cost
        story.say(f"refitted with {' and '.join(pair.names)}: sum of squares {before:.6g} -> {after:.6g}")
    return end


def _without_the_needless(story: Story, found: Fitted) -> Fitted:
    """The model without effects that another has made needless since."""
    for effect in found.what.effects[:-1]:
        story.now(f"asking whether {effect.name} is still needed")
        rest = [e for e in found.what.effects if e is not effect]
        what = extended(story.subject, rest)
        lean = story.fitted(what, f"{found.name} without {effect.name}", partial(_without, story, found, what))
        story.stage("prune")
        if lean is not None and score(story, lean, found) <= 0:
            story.say(
                f"{effect.name} is not needed any more: sum of squares {found.point.cost:.6g} -> {lean.point.cost:.6g}"
            )
            return _without_the_needless(story, lean)
    return found


def _without(story: Story, found: Fitted, what: Extended) -> tuple[Point, Array] | None:
    """A refit with an effect less."""
    ruler, names = story.ruler_of(what), translated(what, found.what, dict.fromkeys(what.space.keys, 0.0))
    return reduced(ruler, found, what, [found.what.space.keys.index(name) for name in names])


def _nothing_left(story: Story, tried: Tried, at: Fitted) -> bool:
    """Whether another round would be in vain: no more than noise is left, and no footprint promises anything."""
    if promise(tried, at) > _HOPE * tried.limit:
        return False
    return leftover(story.ruler_of(at.what), at.point, seed=story.seed).p_value > _QUIET


def _first(story: Story, current: Fitted, found: dict[str, Fitted], order: Sequence[str]) -> tuple[str, list[str]]:
    """The best of what was refitted with slopes of its own, and with whom it is confusable.

    Near-ties are run again at a finer integration, and records held out are evidence between them: the refits have not
    seen those. They do not overrule a clear score.
    """
    leader, scale = order[0], decide.inflation(found[order[0]].point)
    worth = {name: score(story, current, found[name]) for name in order}
    near = [name for name in order[1:] if worth[leader] - worth[name] < decide.TIE * scale]
    ties = [leader]
    for name in near:
        story.now(f"settling {leader} against {name}")
        ahead = worth[leader] - worth[name] + finer(story, found[leader], found[name])
        ahead += _held_cost(story, found[name]) - _held_cost(story, found[leader])
        if abs(ahead) < decide.TIE * scale:
            ties.append(name)
        elif ahead < 0:
            leader, ties = name, [name]
    return leader, ties


def _held_cost(story: Story, at: Fitted) -> float:
    held = story.held_out(at)
    return 0.0 if held is None else float(held @ held)


def _objection(story: Story, current: Fitted, best: Fitted) -> str:
    """Why the best is not added; "" where it is."""
    name, point = best.what.effects[-1].name, current.point
    freedom = point.residual.size - point.x.size
    fall, extra = gain(story, current, best), best.point.x.size - point.x.size
    part = share(story, current, best)
    chance = decide.p_value(fall, extra, scale=decide.inflation(best.point)) * len(story.subject.catalogue)
    if score(story, current, best) <= 0 or chance > ALARM:
        return f"{name} gains no more than chance"
    if story.blame(current).cost > 2 * freedom and part < decide.FAIR:
        return f"{name} takes {100 * part:.1f} % of the misfit: not enough to be named"
    before, after = story.held_out(current), story.held_out(best)
    if before is not None and after is None:
        return f"{name} makes a model that cannot be simulated on what is held out: not named"
    if before is None or after is None or decide.disagreement(before, after) <= decide.AGAINST:
        return ""
    if float(after @ after - before @ before) > fall:
        return f"{name} makes what is held out worse by more than it gains: not named"
    return ""
