"""From what was found at each place to what is told of it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from pysim.diagnose.locating.drawn import remembered
from pysim.diagnose.locating.formula import Formula, formula
from pysim.diagnose.locating.found import Base, Found, Named
from pysim.diagnose.locating.laws import KNOTS
from pysim.diagnose.locating.shape import Told, shape, told, units
from pysim.diagnose.strengths import translated
from pysim.types import Missing
from pysim.types.diagnosis import Shape

# Terms whose likelihoods differ by less than this factor's logarithm cannot be told apart.
TIE = 5.0


@dataclass(frozen=True)
class Place:
    """One place with its best term and its best effect.

    Args:
        slot: its name.
        table: a term over one variable, estimated from the measurements alone; None where none could be looked at.
        named: an effect of the catalogue; None where none promises anything.
        same: places where any term does the very same.
    """

    slot: str
    table: Found | None
    named: Named | None
    same: tuple[str, ...] = ()

    @property
    def leads(self) -> Found | Named:
        """What counts: the better of both; a term that was not worth a fit does not beside an effect that was."""
        if self.named is None or self.table is None:
            found = self.named or self.table
            assert found is not None  # a place is one where something was looked at
            return found
        return self.table if self.table.fitted and self.table.evidence > self.named.evidence else self.named

    @property
    def fitted(self) -> bool:
        """Whether that is of a fit."""
        return not isinstance(self.leads, Found) or self.leads.fitted

    @property
    def suggested(self) -> str:
        """The effect with its sizes where it leads, or where the data cannot tell its law from the table; else ""."""
        if self.named is None:
            return ""
        tied = self.table is not None and self.table.evidence - self.named.evidence < TIE
        return self.named.one.text if tied or self.leads is self.named else ""

    @property
    def by_effect(self) -> bool:
        """Whether it is drawn as the effect does it: that remembers, or no table was fitted."""
        if not isinstance(self.leads, Named) or self.leads.acted is None:
            return False
        return self.leads.acted.remembers or self.table is None or not self.table.fitted


def in_order(tables: Sequence[Found], named: Sequence[Named], same: Mapping[str, Sequence[str]]) -> list[Place]:
    """Per place its best, the most likely place first; places of which nothing can be drawn are left out.

    Args:
        tables: with what is told of them, where they were fitted.
        same: place -> others where any term does the very same.
    """
    effects: dict[str, Named] = {}
    for one in sorted(named, key=lambda one: -one.evidence):
        effects.setdefault(one.one.slot, one)
    looked_at = dict.fromkeys(found.law.slot for found in tables)
    best = {slot: _best([f for f in tables if f.law.slot == slot], effects.get(slot)) for slot in looked_at}
    slots = dict.fromkeys([*best, *(slot for slot, one in effects.items() if one.acted is not None)])
    places = [Place(slot, best.get(slot), effects.get(slot), tuple(same.get(slot, ()))) for slot in slots]
    return sorted(places, key=lambda place: (not place.fitted, -place.leads.evidence))


def _best(tables: Sequence[Found], named: Named | None) -> Found:
    """Of one place the likeliest; of those that the data cannot tell apart, the one over which its effect acts."""
    first = min(tables, key=lambda found: (not found.fitted, -found.evidence))
    law = named.acted.law if named and named.acted else None
    near = (f for f in tables if f.fitted is first.fitted and first.evidence - f.evidence < TIE)
    return next((f for f in near if f.law == law), first)


def described(found: Found) -> Found:
    """A fitted term with its band and its formula."""
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
    )
    return replace(found, told=of, formula=said)


def rows(base: Base, places: Sequence[Place]) -> tuple[Missing, ...]:
    """What is told of each place."""
    return tuple(_row(base, place, _alike(place, places)) for place in places)


def _alike(place: Place, places: Sequence[Place]) -> tuple[str, ...]:
    """Other places whose best the data do not tell from this one's, or that are the same place to any measurement."""
    return tuple(
        other.slot
        for other in places
        if other.slot in place.same
        or (
            other is not place
            and other.fitted is place.fitted
            and abs(other.leads.evidence - place.leads.evidence) < TIE
        )
    )


def _row(base: Base, place: Place, alike: tuple[str, ...]) -> Missing:
    law, shown, text, parameters = _by_effect(base, place) if place.by_effect else _by_table(base, place)
    return Missing(place.slot, place.leads.share, law, shown, text, alike, parameters)


def _by_effect(base: Base, place: Place) -> tuple[str, Shape, str, dict[str, float]]:
    """Drawn as the effect does it."""
    named = place.named
    assert named is not None
    assert named.acted is not None
    one, at = named.one, base.at.what
    values = one.at.what.space.values(one.at.point.x)
    names = translated(at, one.at.what, dict.fromkeys(at.space.keys, 0.0))
    parameters = {name: values[new] for name, new in zip(at.space.keys, names, strict=True)}
    text = f"{one.text}; the band holds 95 % of its values, for it remembers" if named.acted.remembers else one.text
    return named.acted.law.argument, remembered(named.acted, at.model, one.doubt), text, parameters


def _by_table(base: Base, place: Place) -> tuple[str, Shape, str, dict[str, float]]:
    """Drawn as estimated; a term that was not worth a fit as it is to first order."""
    found = place.table
    assert found is not None
    law, of, said = found.law, found.told, found.formula
    if of is None or said is None:
        unit, solution = found.estimate.table.unit, found.estimate.solution
        values, covariance = unit * solution.values, unit**2 * solution.covariance
        of = Told(found.estimate.table.knots, values, covariance, np.zeros((KNOTS, 0)))
        said = Formula("", "", np.zeros(0), np.zeros((0, 0)))
    late = f", {1e3 * law.lag:g} ms late" if said.text and law.lag else ""
    text = "; ".join(filter(None, (f"{said.text}{late}", place.suggested)))
    shown = shape(of, law, found.estimate.table.model, said.along, said.spread)
    numbers = found.estimate.table.space(base.at).values(found.estimate.point.x)
    return law.argument, shown, text, {name: numbers[name] for name in base.at.what.space.keys}
