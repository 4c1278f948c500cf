"""Where a term is missing, and what it looks like: no effect is named for it."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from pysim.diagnose.fitted import Fitted
from pysim.diagnose.locating.fit import Estimate, Table, across, advance, first_order, knots
from pysim.diagnose.locating.formula import Formula, formula
from pysim.diagnose.locating.laws import KNOTS, Law, Term, slot_laws, state_laws
from pysim.diagnose.locating.outside import outside
from pysim.diagnose.locating.runs import patient, seen, thinned
from pysim.diagnose.locating.shape import Told, shape, told, units
from pysim.diagnose.locating.tone import tones
from pysim.diagnose.residuals import Ruler
from pysim.diagnose.screen import column_space
from pysim.diagnose.subject import Subject
from pysim.effects import Slot
from pysim.types import BadInput, Effect, Missing, Model

Array = NDArray[np.float64]

# Effects that the model has already, and a term -> the model compiled with both.
Probed = Callable[[Sequence[Effect], Term], Model]
Say = Callable[[str], None]

# Terms that are fitted together with the parameters, and for how many steps: fewer and fewer go on.
_STAGES = ((6, 1), (4, 2), (2, 5))
# Terms whose likelihoods differ by less than this factor's logarithm are not told apart: a named form goes first.
_TIE = 5.0


@dataclass(frozen=True)
class _Found:
    """One term with what speaks for it: logarithm of the likelihood over that without a term, and its share.

    `estimate` is of first order where it is not yet `fitted`.
    """

    law: Law
    estimate: Estimate = field(repr=False)
    fitted: bool
    evidence: float
    share: float
    told: Told | None = field(default=None, repr=False)
    formula: Formula | None = None


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
    for; the model's free parameters are refitted with it. Tests that show most of the misfit for their time are used.

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
    base = _Base.of(Fitted(current.what, point))
    laws = _laws(subject, current.what.model, slots)
    samples = seen(few, current, laws)
    tried = []
    for law in laws:
        try:
            model = probed(current.what.effects, law)
        except BadInput as error:
            say(f"{law.slot} over {law.argument} could not be looked at: {error}")
            continue
        found = first_order(few, base.at, base.span, Table(law, model, knots(samples[f"{law.slot}|{law.argument}"])))
        if found is not None:
            tried.append(base.found(found))
    tried.sort(key=lambda found: -found.evidence)
    say(f"looked at {len(tried)} terms: " + ", ".join(f"{f.law.slot} {100 * f.share:.0f} %" for f in tried[:3]))
    rows = _missing(subject, few, base, tried, say)
    return _swinging_first(rows, tones(ruler, current, laws, probed), say)


def _swinging_first(rows: Sequence[Missing], swings: Sequence[Missing], say: Say) -> tuple[Missing, ...]:
    """A swing stands for its place where it takes more than the place's best law of the model's own variables does."""
    if not swings or (rows and rows[0].share > swings[0].share):
        return tuple(rows)
    say(f"{swings[0].slot} over time: {100 * swings[0].share:.1f} % of the misfit of a log. {swings[0].formula}")
    places = {row.slot for row in swings}
    return (*swings, *(row for row in rows if row.slot not in places))


@dataclass(frozen=True)
class _Base:
    """The model without a term: what refitting takes, and what is left beyond noise."""

    at: Fitted
    span: Array
    left: float
    rows: int

    @classmethod
    def of(cls, at: Fitted) -> _Base:
        span = column_space(at.point.jacobian)
        rest = across(at.point.residual, span)
        return cls(at, span, float(rest @ rest), at.point.residual.size)

    def found(self, at: Estimate, *, fitted: bool = False) -> _Found:
        """How much better it gets with a term."""
        solution = at.solution
        evidence = 0.5 * self.rows * math.log(self.left / self.rows) - solution.loss
        noise = max(1.0, solution.left / self.rows)
        avoidable = self.left - (self.rows - self.span.shape[1])
        gain = self.left - solution.left - solution.freedom * noise
        share = float(np.clip(gain / avoidable, 0.0, 1.0)) if avoidable > 0 else 0.0
        return _Found(at.table.law, at, fitted, evidence, share)


def _laws(subject: Subject, model: Model, slots: Sequence[Slot]) -> tuple[Law, ...]:
    """Slots that the catalogue has effects for come first; where it has none for any, all of them."""
    known = {effect.slot for effect in subject.catalogue}
    chosen = [slot for slot in slots if slot.name in known] or list(slots)
    return slot_laws(chosen, model) if chosen else state_laws(model)


def _missing(subject: Subject, ruler: Ruler, base: _Base, tried: Sequence[_Found], say: Say) -> tuple[Missing, ...]:
    """Fit the best terms, fewer and fewer, and tell all."""
    running, twins = _different(tried)
    for count, rounds in _STAGES:
        ahead = [_advanced(ruler, base, found, rounds) for found in running[:count]]
        running = [*sorted(ahead, key=lambda found: -found.evidence), *running[count:]]
    done = [_described(subject, found) for found in running]
    done += [_described(subject, _as(found, twin)) for found in done for twin in twins.get(id(found.law), ())]
    best: dict[str, _Found] = {}
    for found in _named_first(sorted(done, key=lambda found: (not found.fitted, -found.evidence))):
        best.setdefault(found.law.slot, found)
    rows = tuple(_row(base, found, _alike(found, best.values())) for found in best.values())
    for row in rows:
        also = f" {', '.join(row.alike)} would do as well." if row.alike else ""
        say(f"{row.slot} over {row.depends_on}: {100 * row.share:.1f} % of the misfit.{also} {row.formula}".strip())
    return rows


def _different(tried: Sequence[_Found]) -> tuple[list[_Found], dict[int, list[Law]]]:
    """Terms that do something of their own, and per such a term the laws at other places that do the very same."""
    different: list[_Found] = []
    twins: dict[int, list[Law]] = {}
    for found in tried:
        same = next((d for d in different if _same(d, found)), None)
        if same is None:
            different.append(found)
        else:
            twins.setdefault(id(same.law), []).append(found.law)
    return different, twins


def _same(one: _Found, other: _Found) -> bool:
    return (
        abs(one.evidence - other.evidence) < 1e-3 * max(abs(one.evidence), 1.0)
        and abs(one.share - other.share) < 1e-3
        and one.law.of_rate == other.law.of_rate
        and one.law.slot != other.law.slot
    )


def _as(found: _Found, law: Law) -> _Found:
    """The same term at another place."""
    return replace(found, law=law)


def _advanced(ruler: Ruler, base: _Base, found: _Found, rounds: int) -> _Found:
    end = advance(ruler, base.at, found.estimate, rounds=rounds)
    return found if end is found.estimate else base.found(end, fitted=True)


def _described(subject: Subject, found: _Found) -> _Found:
    if not found.fitted:
        return found
    of, law = told(found.estimate), found.law
    unit_in, unit_out = units(law, found.estimate.table.model)
    said = formula(
        of.knots,
        of.values,
        of.doubt,
        of.absorbed,
        argument=law.argument,
        unit_in=unit_in,
        unit_out=unit_out,
        slot=law.slot,
        catalogue=subject.catalogue,
    )
    return replace(found, told=of, formula=said)


def _named_first(found: list[_Found]) -> list[_Found]:
    """Of those that the data do not tell apart, one whose form a catalogue effect has at that very place goes first."""
    if not found:
        return found
    near = [f for f in found if found[0].evidence - f.evidence < _TIE]
    near.sort(key=lambda f: not (f.formula and f.formula.effect))
    return near + [f for f in found if not any(f is g for g in near)]


def _alike(found: _Found, others: Iterable[_Found]) -> tuple[str, ...]:
    """Other places whose term the data do not tell from this one."""
    return tuple(
        other.law.slot
        for other in others
        if other is not found and other.fitted is found.fitted and abs(other.evidence - found.evidence) < _TIE
    )


def _row(base: _Base, found: _Found, alike: tuple[str, ...]) -> Missing:
    """What is told of one place; a term that was not worth a fit is told as it is to first order."""
    law, of, said = found.law, found.told, found.formula
    if of is None or said is None:
        unit, solution = found.estimate.table.unit, found.estimate.solution
        values, covariance = unit * solution.values, unit**2 * solution.covariance
        of = Told(found.estimate.table.knots, values, covariance, np.zeros((KNOTS, 0)))
        said = Formula("", "", "", np.zeros(0), np.zeros((0, 0)))
    text = f"{said.text} ({said.effect})" if said.effect else said.text
    text += f", {1e3 * law.lag:g} ms late" if text and law.lag else ""
    shown = shape(of, law, found.estimate.table.model, said.along, said.spread)
    return Missing(law.slot, found.share, law.argument, shown, text, alike, _parameters(base, found))


def _parameters(base: _Base, found: _Found) -> dict[str, float]:
    """The model's own free numbers beside the term."""
    values = found.estimate.table.space(base.at).values(found.estimate.point.x)
    return {name: values[name] for name in base.at.what.space.keys}
