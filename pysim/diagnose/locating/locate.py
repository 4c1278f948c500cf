"""Where a term is missing, and what it looks like."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from pysim.diagnose.fitted import Fitted
from pysim.diagnose.locating.drawn import Acted, acted
from pysim.diagnose.locating.fit import Table, advance, begun, first_order, knots
from pysim.diagnose.locating.found import Base, Found, Named
from pysim.diagnose.locating.known import Known, known
from pysim.diagnose.locating.laws import Law, Term, slot_laws, state_laws
from pysim.diagnose.locating.outside import outside
from pysim.diagnose.locating.places import TIE, described, in_order, rows
from pysim.diagnose.locating.runs import patient, seen, thinned
from pysim.diagnose.locating.same import alike, different, neighbours
from pysim.diagnose.locating.tone import tones
from pysim.diagnose.residuals import Ruler
from pysim.diagnose.subject import Subject
from pysim.effects import Slot
from pysim.types import BadInput, Effect, Missing, Model

Array = NDArray[np.float64]

# Effects that the model has already, and a term -> the model compiled with both.
Probed = Callable[[Sequence[Effect], Term], Model]
Say = Callable[[str], None]

# Terms that are fitted together with the parameters, and for how many steps: fewer and fewer go on. Where the misfit is
# less than this share of the noise, first order is near the truth.
_STAGES, _SMALL, _FEW = ((5, 1), (3, 2), (2, 4)), 0.2, ((2, 2),)
# An effect that takes such a share of the avoidable misfit leaves no term to look for.
_WHOLE = 0.9
# Steps for a term that starts near the end of its way.
_STEPS = 2


def locate(
    subject: Subject,
    ruler: Ruler,
    current: Fitted,
    *,
    slots: Sequence[Slot] = (),
    probed: Probed | None = None,
    progress: Say | None = None,
) -> tuple[Missing, ...]:
    """Estimate, at each place of the model, the term that would close the gap to the measurements.

    A term is a table over one variable that the place sees, straight between its knots and as smooth as the data ask
    for; the model's free parameters are refitted with it. What no table can hold, because it remembers, is looked for
    as the effects of the catalogue, each at its place. Tests that show most of the misfit for their time are used.

    Args:
        ruler: of what is fitted.
        current: the model so far at its best point.
        slots: of the model's class; where there are none, the equations of its states are looked at.
        probed: compiles the model with a term; None for a model without source, which shows inputs and outputs alone.
        progress: told a line per step.
    Returns:
        per place the best term, the most likely place first; empty where nothing could be looked at.
    """
    say = progress or (lambda line: None)
    if probed is None:
        return outside(ruler, current)
    few = patient(thinned(ruler, current.point), current)
    point = few.evaluation(current.what, current.point.x)
    if not point.good:
        return ()
    base = Base.of(Fitted(current.what, point))
    named = base.worth(known(subject, few, base.at, say))
    say("; ".join(f"{one.one.slot} {100 * one.share:.0f} % ({one.one.text})" for one in named[:3]) or "no effect helps")
    laws = _laws(subject, current.what.model, slots)
    samples = seen(few, base.at, laws)
    spread = [(law, knots(samples[f"{law.slot}|{law.argument}"])) for law in laws]
    whole = bool(named) and named[0].share > _WHOLE
    tried = _tried(few, base, _beside(named, spread) if whole else spread, probed, say)
    running = tried if whole else _fitted(few, base, tried)
    named = [_acting(base, one, spread) for one in _first_of_place(named)]
    found = [described(one) for one in (*running, *_drawn(few, base, named, running))]
    missing = rows(base, in_order(found, named, neighbours(tried)))
    for row in missing:
        also = f" {', '.join(row.alike)} would do as well." if row.alike else ""
        say(f"{row.slot} over {row.depends_on}: {100 * row.share:.1f} % of the misfit.{also} {row.formula}".strip())
    return missing if whole else _swinging_first(missing, tones(ruler, current, laws, probed), say)


def _beside(named: Sequence[Named], laws: Sequence[tuple[Law, Array]]) -> list[tuple[Law, Array]]:
    """Laws of the places where effects leave nothing, and those over the very same values at other places."""
    leading = {one.one.slot for one in named if named[0].evidence - one.evidence < TIE}
    own = [(law, k) for law, k in laws if law.slot in leading]
    return [(law, k) for law, k in laws if any(law is one or alike(law, k, one, j) for one, j in own)]


def _tried(ruler: Ruler, base: Base, laws: Sequence[tuple[Law, Array]], probed: Probed, say: Say) -> list[Found]:
    """Every law to first order, the best first."""
    tried = []
    for law, k in laws:
        try:
            model = probed(base.at.what.effects, law)
        except BadInput as error:
            say(f"{law.slot} over {law.argument} could not be looked at: {error}")
            continue
        found = first_order(ruler, base.at, base.span, Table(law, model, k))
        if found is not None:
            tried.append(base.found(found))
    tried.sort(key=lambda found: -found.evidence)
    say(f"looked at {len(tried)} terms: " + ", ".join(f"{f.law.slot} {100 * f.share:.0f} %" for f in tried[:3]))
    return tried


def _swinging_first(rows: Sequence[Missing], swings: Sequence[Missing], say: Say) -> tuple[Missing, ...]:
    """A swing stands for its place where it takes more than the place's best law of the model's own variables does."""
    if not swings or (rows and rows[0].share > swings[0].share):
        return tuple(rows)
    say(f"{swings[0].slot} over time: {100 * swings[0].share:.1f} % of the misfit of a log. {swings[0].formula}")
    places = {row.slot for row in swings}
    return (*swings, *(row for row in rows if row.slot not in places))


def _laws(subject: Subject, model: Model, slots: Sequence[Slot]) -> tuple[Law, ...]:
    """Slots that the catalogue has effects for come first; where it has none for any, all of them."""
    known = {effect.slot for effect in subject.catalogue}
    chosen = [slot for slot in slots if slot.name in known] or list(slots)
    return slot_laws(chosen, model) if chosen else state_laws(model)


def _fitted(ruler: Ruler, base: Base, tried: Sequence[Found]) -> list[Found]:
    """All terms, the best of them fitted, fewer and fewer; what does the same at another place is fitted with it."""
    running, twins = different(tried)
    for count, rounds in _FEW if base.left < (1 + _SMALL) * base.rows else _STAGES:
        ahead = [_advanced(ruler, base, found, rounds) for found in running[:count]]
        running = [*sorted(ahead, key=lambda found: -found.evidence), *running[count:]]
    return running + [replace(found, law=twin) for found in running for twin in twins.get(id(found.law), ())]


def _advanced(ruler: Ruler, base: Base, found: Found, rounds: int) -> Found:
    end = advance(ruler, base.at, found.estimate, rounds=rounds)
    return found if end is found.estimate else base.found(end, fitted=True)


def _first_of_place(named: Sequence[Named]) -> list[Named]:
    """Per place the best effect, the best place first."""
    best: dict[str, Named] = {}
    for one in named:
        best.setdefault(one.one.slot, one)
    return list(best.values())


def _acting(base: Base, one: Named, laws: Sequence[tuple[Law, Array]]) -> Named:
    """With what the effect does over the variables that its place sees."""
    own = [(law, k) for law, k in laws if law.slot == one.one.slot]
    return replace(one, acted=acted(one.one, base.at, own)) if own else one


def _drawn(ruler: Ruler, base: Base, named: Sequence[Named], running: Sequence[Found]) -> list[Found]:
    """Terms at the places of the effects that lead, estimated from the measurements; none where no table can hold it.

    They start from what the effects do there, which is near the end of their way.
    """
    leading = max([found.evidence for found in running if found.fitted] + [one.evidence for one in named], default=0.0)
    found: list[Found] = []
    for one in named:
        own = [f for f in running if f.law.slot == one.one.slot]
        if not own or one.evidence < leading - TIE:
            continue
        if one.acted is None:
            found.append(_advanced(ruler, base, max(own, key=lambda f: f.evidence), _STEPS))
        elif not one.acted.remembers:
            found += _begun(ruler, base, one.one, one.acted, own)
    return found


def _begun(ruler: Ruler, base: Base, one: Known, does: Acted, own: Sequence[Found]) -> list[Found]:
    table = next((f.estimate.table for f in own if f.law is does.law), None)
    start = None if table is None else begun(ruler, base.at, one.at, table, does.values)
    return [] if start is None else [base.found(advance(ruler, base.at, start, rounds=_STEPS), fitted=True)]
