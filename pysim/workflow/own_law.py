"""A law as a user types it: its parameters, their units and usual values, its curve, and the class of its effect."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from itertools import product
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from pysim.types import BadInput, EffectParameter
from pysim.workflow.learned import class_name_of
from pysim.workflow.model import with_standard

if TYPE_CHECKING:
    from pysim.effects import Slot
    from pysim.effects.law import Law

Array = NDArray[np.float64]
Given = Sequence[Any]  # lowest, highest, usual, unit, as a user gives them
_NAME = "own.law"  # of a law that has no name yet, in messages
_WIDE = 10.0  # a range goes that far beyond the usual value, or that far below it
# Where the search for values that follow a curve begins: shares of what their unit makes of its width and its height.
_SHARES = (0.01, 0.03, 0.1, 0.3, 1.0)
_MOST = 3  # parameters of which all combinations of shares are tried


class Range(NamedTuple):
    """Of a parameter of a law."""

    low: float
    high: float
    usual: float
    unit: str


@dataclass(frozen=True)
class LawPlace:
    """A slot that a law is written for.

    Args:
        slot: with what it sees and gives.
        units: of these, and of the time.
        libraries: of the user, that hold what it takes.
    """

    slot: Slot
    units: Mapping[str, str | None]
    libraries: tuple[Path, ...]

    @classmethod
    def of(cls, model: str, slot: str, libraries: Sequence[Path]) -> LawPlace:
        """The slot of a class.

        Raises:
            BadInput: there is none of that name.
        """
        from pysim.effects import slot_units, slots

        places = with_standard(libraries)
        found = next((one for one in slots(model, places) if one.name == slot), None)
        if found is None:
            raise BadInput(f"{model} has no slot {slot}; pick one of the drawing")
        return cls(found, {**slot_units(found, places), "time": "s"}, tuple(libraries))


@dataclass(frozen=True)
class TypedLaw:
    """What a text says as far as it was typed.

    Args:
        ranges: of its parameters.
        curve: (m,) at the knots of the learned curve, at usual values and with what the model's own parameters may add
            to it; None where there is none, or where the law depends on more than that curve does.
    """

    ranges: Mapping[str, Range]
    curve: Array | None = field(repr=False)


def typed_law(
    law: str, place: LawPlace, learned: Mapping[str, Any] | None = None, ranges: Mapping[str, Given] | None = None
) -> TypedLaw:
    """Read a law that is being typed; every name that the slot has not is a parameter of it.

    Args:
        learned: a law of `missing` in an answer, whose curve usual values are to follow.
        ranges: of parameters that the user has chosen.
    Raises:
        LawRefused: what is wrong, and where.
    """
    from fmu_build.text.expressions import names_in
    from pysim.effects import law_class, law_equations, parameter_units
    from pysim.effects.law import Law

    equations = law_equations(_NAME, law, place.slot)
    read, chosen = Law(dict(equations)), {name: Range(*own) for name, own in (ranges or {}).items()}
    units = parameter_units(equations, {**place.units, **{name: own.unit for name, own in chosen.items() if own.unit}})
    named = dict.fromkeys(name for _, tree in equations for name in names_in(tree))
    parameters = [name for name in named if name not in place.units and name not in read.values]
    units |= {name: own.unit for name, own in chosen.items() if name in parameters and own.unit}
    kept = {name: own for name, own in chosen.items() if name in parameters}
    shaped = [EffectParameter(name, units.get(name) or "1", 0.0, 1.0, 1.0, 1.0, None) for name in parameters]
    law_class(class_name_of(_NAME), place.slot, law, shaped, with_standard(place.libraries))
    curve = None if learned is None else _Curve.of(read, place, learned)
    values = {name: float(own.usual) for name, own in kept.items()}
    free = [name for name in parameters if name not in values]
    values |= dict.fromkeys(free, 1.0) if curve is None else curve.followed(free, values, units)
    linear = _linear(read, place.slot, values)
    wide = _WIDE**3 if curve is None else _WIDE  # a guess may be far off
    found = {name: _usual_range(values[name], units.get(name) or "1", name in linear, wide) for name in parameters}
    return TypedLaw({**found, **kept}, None if curve is None else curve.beside(values))


def _usual_range(value: float, unit: str, is_strength: bool, wide: float) -> Range:
    """A strength may be nothing, and on the other side too; what shapes a law keeps its sign."""
    low, high = sorted((0.0 if is_strength else value / wide, wide * value))
    return Range(*((-wide, wide) if low == high else (low, high)), value, unit)


@dataclass(frozen=True)
class _Curve:
    """A law along a learned curve.

    Args:
        argument: of the curve, as the slot calls it.
        turning: variable whose sign is the curve's factor, and its root mean square in the logs; "" without one.
        knots, wanted, spread: (m,) places, coefficients and widths of the band there.
        absorbed: (m, k) curves that the model's own parameters do as well.
        units: of argument and curve.
    """

    law: Law
    slot: Slot
    argument: str
    turning: tuple[str, float]
    knots: Array
    wanted: Array
    spread: Array
    absorbed: Array
    units: tuple[str, str]

    @classmethod
    def of(cls, law: Law, place: LawPlace, learned: Mapping[str, Any]) -> _Curve | None:
        """None where the law depends on more than the curve."""
        from pysim.diagnosis.settings import LearnSettings

        argument = str(learned["depends_on"]).removeprefix(f"{place.slot.name}.")
        (gives, *others), shape = place.slot.gives, learned["shape"]
        needs = {name for name in law.needs(gives) if name in place.units}
        sign = str(learned.get("sign_of") or "")
        if others or (learned["factor"] and not sign) or not needs <= {argument, sign} or len(shape["argument"]) < 2:
            return None
        units = str(shape["argument_unit"]), str(shape["unit"])
        knots, wanted, low, high = (np.array(shape[key], float) for key in ("argument", "value", "low", "high"))
        spread = np.maximum(high - low, 1e-6 * max(float(np.max(np.abs(wanted))), 1e-300))
        absorbed = np.array(shape.get("absorbed") or np.zeros((knots.size, 0)), float)
        turning = sign, float(learned.get("sign_width") or 1.0) / LearnSettings().sign_width
        return cls(law, place.slot, argument, turning, knots, wanted, spread, absorbed, units)

    def at(self, values: Mapping[str, float]) -> Array:
        """(m,) of the law; of its part that changes sign with the curve's factor, where that is a sign."""
        name, far = self.turning
        if not name:
            return self._along(values)
        return 0.5 * (self._along({**values, name: far}) - self._along({**values, name: -far}))

    def _along(self, values: Mapping[str, float]) -> Array:
        from pysim.effects.law import Moment

        found = Moment(self.law, {**values, self.argument: self.knots})[self.slot.gives[0]]
        return np.broadcast_to(np.asarray(found, float), self.knots.shape)

    def beside(self, values: Mapping[str, float]) -> Array:
        """(m,) of the law, with as much of what is absorbed as brings it nearest to the learned curve."""
        own = self.at(values)
        return own + self.absorbed @ self._nearest(self.absorbed, self.wanted - own)

    def _nearest(self, columns: Array, rest: Array) -> Array:
        """Amounts of some curves that come nearest to another one, over the width of the band."""
        left = np.nan_to_num(rest, nan=0.0, posinf=0.0, neginf=0.0)
        return np.asarray(np.linalg.lstsq(columns / self.spread[:, None], left / self.spread, rcond=None)[0])

    def followed(self, free: Sequence[str], held: Mapping[str, float], units: Mapping[str, str]) -> dict[str, float]:
        """Values of free parameters at which the law comes nearest: linear ones by least squares, others searched."""
        from scipy.optimize import least_squares

        linear = sorted(_linear(self.law, self.slot, {**held, **dict.fromkeys(free, 1.0)}) & {*free})
        others = [name for name in free if name not in linear]
        sizes = np.array([self._size(units.get(name, "")) for name in others])

        def solved(shares: Array) -> dict[str, float]:
            own = {**held, **dict(zip(others, (sizes * np.exp(shares)).tolist(), strict=True))}
            return own | self._linear_values(linear, own)

        def left(shares: Array) -> Array:
            rest = (self.beside(solved(shares)) - self.wanted) / self.spread
            return np.nan_to_num(rest, nan=1e6, posinf=1e6, neginf=-1e6)

        starts = list(product(np.log(_SHARES), repeat=len(others))) if len(others) <= _MOST else [(0.0,) * len(others)]
        best = min(starts, key=lambda start: float(np.sum(left(np.array(start)) ** 2)))
        shares = np.array(best)
        if others:
            shares = least_squares(left, shares, bounds=(shares - 5.0, shares + 5.0)).x
        found = solved(shares)
        return {name: float(f"{found[name]:.3g}") for name in free}

    def _linear_values(self, linear: Sequence[str], own: Mapping[str, float]) -> dict[str, float]:
        if not linear:
            return {}
        off = dict.fromkeys(linear, 0.0)
        base = self.at({**own, **off})
        columns = np.column_stack([self.at({**own, **off, name: 1.0}) - base for name in linear])
        if not np.all(np.isfinite(columns)):
            return dict.fromkeys(linear, 1.0)
        amounts = self._nearest(np.column_stack([columns, self.absorbed]), self.wanted - base)
        return dict(zip(linear, amounts.tolist(), strict=False))

    def _size(self, unit: str) -> float:
        """What a unit makes of the curve's width and height; 1 where it is of neither."""
        from pysim.effects.law import dimension

        width, height = float(np.max(np.abs(self.knots))), float(np.max(np.abs(self.wanted)))
        try:
            across, up, own = (dimension(one) for one in (*self.units, unit))
        except ValueError:
            return 1.0
        for powers in product(range(-3, 4), (0, 1)):
            found = {b: powers[0] * across.get(b, 0) + powers[1] * up.get(b, 0) for b in {**across, **up}}
            if own and {b: power for b, power in found.items() if power} == own:
                return max(width ** powers[0] * height ** powers[1], 1e-300)
        return 1.0


def _linear(law: Law, slot: Slot, values: Mapping[str, float]) -> set[str]:
    """Parameters in which what the slot gives is linear: it changes twice as much where one changes twice as much."""
    found = set()
    for name in values:
        at = [_seen(law, slot, {**values, name: value}) for value in (0.0, 1.0, 2.0)]
        change = at[1] - at[0]
        same = np.all(np.isfinite(at)) and np.allclose(at[2] - at[1], change, rtol=1e-9, atol=1e-12)
        if same and np.any(change != 0):
            found.add(name)
    return found


def _seen(law: Law, slot: Slot, values: Mapping[str, float]) -> Array:
    """What the slot gives at some values of what it sees."""
    from pysim.effects.law import Moment

    rng = np.random.default_rng(0)
    seen = {name: rng.uniform(0.5, 2.0, 16) * rng.choice([-1.0, 1.0], 16) for name in (*slot.sees, "time")}
    at = Moment(law, {**seen, **values})
    return np.concatenate([np.broadcast_to(np.asarray(at[name], float), (16,)) for name in slot.gives])


def effect_class(
    name: str,
    slot: Slot,
    law: str,
    parameters: Mapping[str, Given],
    libraries: Sequence[Path],
    *,
    description: str = "",
) -> str:
    """The class of an effect, from its formula.

    A parameter whose range holds zero and without which the law vanishes is a strength: it is 0 until it is fitted. Any
    other one shapes the law, and has its usual value.

    Args:
        name: of the effect, "my.drag" -> class MyDrag.
        parameters: name -> lowest, highest, usual, unit.
        libraries: of the user, that hold what the slot takes.
    Raises:
        BadInput: what a law may not hold, with its place in the text, or no parameter that switches it off.
    """
    from pysim.effects import law_class

    ranges = {key: _range(key, given) for key, given in parameters.items()}
    places = with_standard(libraries)
    shaped = [_parameter(key, own, is_strength=False) for key, own in ranges.items()]
    law_class(class_name_of(name), slot, law, shaped, places)  # refuses the law, before its values are asked for
    strengths = _strengths(law, slot, ranges)
    if not strengths:
        raise BadInput(f"effect {name}: no parameter switches the law off at 0; give one a range that holds 0")
    declared = [_parameter(key, own, is_strength=key in strengths) for key, own in ranges.items()]
    return law_class(class_name_of(name), slot, law, declared, places, effect=name, description=description)


def _range(key: str, given: Given) -> Range:
    try:
        low, high, usual, unit = given
        low, high, usual = float(low), float(high), float(usual)
    except (TypeError, ValueError):
        raise BadInput(f"effect: {key} = {given!r}; write {key}=(lowest, highest, usual, unit)", argument=key) from None
    if not low <= usual <= high or not low < high:
        raise BadInput(
            f"effect: {key} is usually {usual:g}, outside {low:g} to {high:g}; give lowest, highest, usual",
            argument=key,
        )
    return Range(low, high, usual, str(unit))


def _parameter(key: str, own: Range, *, is_strength: bool) -> EffectParameter:
    low, high, usual, unit = own
    default, off = (0.0, 0.0) if is_strength else (usual, None)
    return EffectParameter(key, unit, low, high, usual, default, off)


def _strengths(law: str, slot: Slot, ranges: Mapping[str, Range]) -> set[str]:
    """Parameters without which nothing is left: their range holds 0, and the law vanishes only where they are there."""
    from pysim.effects import law_equations
    from pysim.effects.law import Law

    read = Law(dict(law_equations(_NAME, law, slot)))
    usual = {key: own.usual or 0.5 * (own.high or own.low) for key, own in ranges.items()}

    def is_off(zeros: set[str]) -> bool:
        known = {key: 0.0 if key in zeros else value for key, value in usual.items()}
        return bool(np.all(_seen(read, slot, known) == 0.0))

    zeros = {key for key, (low, high, *_) in ranges.items() if low <= 0 <= high}
    if not is_off(zeros):
        return set()
    for key in sorted(zeros, reverse=True):
        if is_off(zeros - {key}):
            zeros = zeros - {key}
    return zeros
