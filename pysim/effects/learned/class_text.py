"""A learned law as a Modelica class that fills its slot: the slot's own equations with `factor*h(argument)` added."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from textwrap import fill as wrapped

import numpy as np
from numpy.typing import NDArray

from fmu_build.text import class_text
from fmu_build.text.expressions import parse
from fmu_build.text.write import quoted
from pysim.effects.catalogue import VENDOR
from pysim.effects.law import check_units, dimension, dimension_words
from pysim.effects.law_class import parameter_text, slot_units
from pysim.effects.learned.curve import CURVE, RAMP, SLOPE, widths
from pysim.effects.learned.formula import REACH, Formula, rounded_up
from pysim.effects.learned.places import LESS
from pysim.effects.slots import Filling, Slot, filling, paired
from pysim.types import BadInput, Effect, EffectParameter
from pysim.types.answer import LearnedLaw
from pysim.types.factor import Factor, Form

Array = NDArray[np.float64]

_DIFFERENCE = "difference"  # the argument of a law over the difference of two signals


def learned_class(
    law: LearnedLaw,
    slot: Slot,
    name: str,
    libraries: Sequence[Path],
    *,
    effect: str = "",
    description: str = "",
    formula: Formula | None = None,
    inner: Sequence[Effect] = (),
) -> str:
    """Text of the Modelica class of a learned law, to be saved as a file and named as a library.

    Its parameters are the coefficients `c[1]` ... `c[m]` (`c_h` if an effect inside has a c), with the learned values
    as defaults and 0 for off, or the amounts and widths of a formula. Beyond the first and last knot the curve is
    constant. A signal that the slot does not have becomes an input, which `pysim.effects.variant` connects.

    Args:
        law: its argument is a variable of the slot, `v` or `SLOT.v`, another signal of the model, the difference of
            two, or `time`. If the slot gives several variables of one kind, `q1` and `q2`, each gets the same curve:
            over `p1` for `q1`, and over `p2` for `q2`.
        slot: the slot that it fills, as `pysim.effects.slots` reads it from a model.
        name: of the class.
        libraries: contain the slot's present class and its partial class.
        effect: its name in the catalogue; "" for a class that a diagnosis does not try.
        formula: takes the place of the curve, see `formulas`.
        inner: one or two effects in the same slot, which become part of the class, since a slot takes one class only:
            two as `first` and `second` of a pair of the libraries.
    Raises:
        BadInput: the slot's class does not give its variable by an equation `y = ...`, or units do not match.
    """
    slot = replace(slot, filling=inner[0].class_name) if len(inner) == 1 else slot
    parts = paired(slot, inner, libraries) if len(inner) > 1 else filling(slot, libraries, final=not inner)
    taken = re.search(r"\bc\b", " ".join(parts.declarations))
    writer = _Writer(law, slot, libraries, formula, "c_h" if taken else "c")
    equations = []
    sides = _sides(slot, parts)
    for left, right in parts.equations:
        term = next((writer.term(side) for side in sides if side.output == left), "")
        rate = next((writer.rate(side) for side in sides if side.rate == left), "")
        equations.append(f"{left} = {_sum(right, term or rate)}" if left else right)
    argument, unit = writer.argument, law.argument_unit
    reach = f"{law.reach[0]:.4g} to {law.reach[1]:.4g} {unit}"
    comment = f"Learned from measurements, for {argument} from {reach}.\nBeyond that range the law is not known."
    comment += "" if formula else "\nThe curve is constant beyond its outermost knots."
    note = f"{VENDOR}(effect={quoted(effect)}, slot={quoted(slot.name)})" if effect else ""
    return class_text(
        name,
        description=description or f"{slot.description or slot.name}: {writer.words} (learned)",
        comment=comment,
        extends=[(slot.takes, parts.modifications)],
        declarations=[*parts.declarations, *writer.declarations()],
        protected=writer.protected(any(side.rate for side in sides)),
        initial=parts.initial,
        equations=[*equations, *writer.equations],
        annotation=note,
    )


@dataclass(frozen=True)
class _Side:
    """One variable that the slot's class computes, such as `q1` of a slot with `q1` and `q2`.

    Args:
        output: name of the variable.
        rate: name of its derivative; "" if the slot has none.
        tags: suffix of the names of the first side, and of this side, such as "1" and "2".
    """

    output: str
    rate: str
    tags: tuple[str, str]


def _sides(slot: Slot, parts: Filling) -> list[_Side]:
    """The variables that the slot's class computes by equations; a variable and its rate make one side."""
    given = [left for left, _ in parts.equations if left in slot.gives]
    outputs = [one for one in given if not (one.endswith("_t") and one[:-2] in given)]
    kinds = {re.sub(r"(\d+|_\w)$", "", one) for one in outputs}
    if not outputs or len(kinds) > 1:
        what = f"gives {', '.join(outputs)}, which are of several kinds" if outputs else "gives nothing by an equation"
        raise BadInput(f"slot {slot.name}: {slot.filling} {what}; a learned law cannot stand there")
    (kind,) = kinds
    first = outputs[0].removeprefix(kind)
    return [_Side(one, f"{one}_t" if f"{one}_t" in given else "", (first, one.removeprefix(kind))) for one in outputs]


def _sum(value: str, term: str) -> str:
    if value == "0" and term:
        return term
    return f"{value} + {term}" if term else value


class _Writer:
    """Writes the parts of one law's class."""

    def __init__(
        self, law: LearnedLaw, slot: Slot, libraries: Sequence[Path], formula: Formula | None, coefficients: str
    ) -> None:
        self._law, self._slot, self._formula, self._coefficients = law, slot, formula, coefficients
        self._units: Mapping[str, str | None] = slot_units(slot, libraries)
        self._outside: dict[str, str] = {}  # local name -> signal of the model
        self._bristle: tuple[str, str, float] | None = None  # variable, its speed, and length
        self._parts = [self._local(one) for one in law.argument.split(LESS)]  # two of a difference
        self.argument = self._parts[0] if len(self._parts) == 1 else _DIFFERENCE
        self._factor = self._factor_text(law.factor)
        self._knots, self._widths = f"{self.argument}_k", f"{self.argument}_w"
        self._check()

    def _local(self, name: str) -> str:
        """Local name of a variable of the slot, or of the input that another signal of the model becomes."""
        own = name.removeprefix(f"{self._slot.name}.")
        if own in self._units or own == "time":
            return own
        local = re.sub(r"\W+", "_", name).strip("_")
        local = f"{local}_in" if local in self._units else local
        self._outside[local] = name
        return local

    def _factor_text(self, factor: Factor) -> str:
        """The factor with local names, a smooth sign, or the state of a bristle; "" for 1."""
        name = self._local(factor.variable) if factor.variable else ""
        if factor.form is Form.SIGN:
            return f"tanh({name}/{factor.number:.8g})"
        if factor.form in (Form.BRISTLE, Form.HYSTERESIS):
            if len([one for one in self._slot.gives if not one.endswith("_t")]) > 1:
                raise BadInput(f"learned law at {self._slot.name}: it has two sides, which cannot share a bristle")
            speed = name if factor.form is Form.BRISTLE else f"der({name})"
            self._bristle = name, speed, float(f"{factor.number:.8g}")
            return f"{name}_bristle"
        if factor.form is Form.TONE:
            return f"cos({factor.rate:.8g}*time + {factor.number % math.tau:.8g})"
        return name

    @property
    def words(self) -> str:
        """What it is, such as "v*h(x)"."""
        factor = self._law.factor
        name = self._local(factor.variable) if factor.variable else ""
        return f"{replace(factor, variable=name)}*h({self.argument})".removeprefix("*")

    def _check(self) -> None:
        """Raise BadInput unless the curve's unit times the factor's is the slot's; units that are not SI pass."""
        law, slot = self._law, self._slot
        bristles = {f"{self._bristle[0]}_bristle": "1"} if self._bristle else {}
        known = {**self._units, **dict.fromkeys(self._outside), **bristles, "time": None}
        for one, unit in known.items():
            known[one] = unit if unit is not None and _is_si(unit) else None
        given = {known.get(one) for one in slot.gives}
        try:
            factor = check_units(parse(self._factor), known) if self._factor else {}
        except ValueError as error:
            raise BadInput(f"learned law at {slot.name}: {error}") from error
        unit = next(iter(given))
        if len(given) > 1 or unit is None or factor is None or not _is_si(law.unit or "1"):
            return
        found = check_units(parse("h*g"), {"h": law.unit or "1", "g": dimension_words(factor)})
        if found != dimension(unit):
            raise BadInput(
                f"learned law at {slot.name}: its curve is in {law.unit or '1'}, and {self._factor or '1'} times that "
                f"is not in {unit}; give the curve's unit"
            )

    def _on(self, side: _Side, text: str) -> str:
        """The expression, with the variables of the first side replaced by those of another side."""
        old, new = side.tags
        if old == new:
            return text
        known = set(self._units)

        def other(found: re.Match[str]) -> str:
            name = found[0]
            twin = name.removesuffix(old) + new
            return twin if name.endswith(old) and name in known and twin in known else name

        return re.sub(r"[A-Za-z_]\w*", other, text)

    def _curve(self, function: str = "curve") -> str:
        if self._formula is not None:
            text = (self._formula.written if function == "curve" else self._formula.slope)(self.argument)
            return text if text.isidentifier() else f"({text})"
        return f"{function}({self.argument}, {self._knots}, {self._widths}, {self._coefficients})"

    def term(self, side: _Side) -> str:
        """The expression that is added to a side's variable."""
        if self._formula is not None and not self._factor:
            return self._on(side, self._formula.written(self.argument))
        return self._on(side, "*".join(filter(None, (self._curve(), self._factor))))

    def rate(self, side: _Side) -> str:
        """Time derivative of the term; raises BadInput if the slot lacks a rate that it needs."""
        argument, factor = f"{self.argument}_t", f"{self._factor}_t"
        known = argument in self._units or self.argument == "time"
        if not known or (self._factor and factor not in self._units):
            raise BadInput(
                f"slot {self._slot.name} hands on the rate {side.rate}, which a law over {self.argument} with the "
                f"factor {self._factor or '1'} does not know; write the class by hand"
            )
        slope = self._curve("slope") + ("" if self.argument == "time" else f"*{argument}")
        if not self._factor:
            return self._on(side, slope)
        return self._on(side, f"{slope}*{self._factor} + {self._curve()}*{factor}")

    def declarations(self) -> list[str]:
        """Declarations of inputs, bristle states, and parameters in the form that `read_catalogue` reads."""
        found = []
        for local, signal in self._outside.items():
            unit = f'(unit="{self._law.argument_unit}")' if local in self._parts else ""
            note = f"annotation({VENDOR}(signal={quoted(signal)}))"
            found.append(f"input Real {local}{unit} {quoted(f'{signal} of the model')} {note}")
        if len(self._parts) > 1:
            found.append(f'Real {_DIFFERENCE}(unit="{self._law.argument_unit}") {quoted(self._law.argument)}')
        if self._bristle:
            name, speed, length = self._bristle
            unit = (self._units.get(name) or "1").removesuffix("/s" if speed == name else "")
            nominal = rounded_up(length)
            bounds = (nominal / REACH, nominal * REACH, nominal)
            own = EffectParameter(f"{name}_length", unit, *bounds, length, None, "Length of the bristle (Dahl 1968)")
            found.append(parameter_text(own))
            found.append(f'Real {name}_bristle(unit="1", min=-1, max=1, start=0, fixed=true) "Bristle over its length"')
        if self._formula is not None:
            return found + [parameter_text(one) for one in self._formula.parameters]
        values = self._law.coefficients
        largest = rounded_up(float(np.max(np.abs(values))))
        attributes = {"min": -REACH * largest, "max": REACH * largest, "nominal": largest, "start": 0.0}
        said = ", ".join(f"each {key}={value:g}" for key, value in attributes.items())
        declared = f'parameter Real {self._coefficients}[{values.size}](each unit="{self._law.unit or "1"}", {said})'
        return [*found, f'{declared} =\n    {_listed(values)}\n    "Value of the curve at each knot, 0 = off"']

    @property
    def equations(self) -> list[str]:
        """The argument, if it is a difference, and the differential equation of the bristle's state (Dahl 1968)."""
        found = [f"{_DIFFERENCE} = {' - '.join(self._parts)}"] if len(self._parts) > 1 else []
        if self._bristle is None:
            return found
        name, speed, _ = self._bristle
        return [*found, f"{name}_length*der({name}_bristle) = {speed} - noEvent(abs({speed}))*{name}_bristle"]

    def protected(self, rates: bool) -> list[str]:
        """Constants and functions of the curve: knots, widths of corners, and `slope` if there are `rates`."""
        if self._formula is not None:
            return []
        knots, unit = self._law.knots, self._law.argument_unit or "1"
        constants = [
            f'constant Real {name}[{knots.size}](each unit="{unit}") =\n    {_listed(values)}\n    {quoted(about)}'
            for name, values, about in (
                (self._knots, knots, "Knots of the curve"),
                (self._widths, widths(knots), "Widths of its rounded corners"),
            )
        ]
        return [*constants, RAMP, CURVE, *([SLOPE] if rates else [])]


def _is_si(unit: str) -> bool:
    try:
        dimension(unit)
    except ValueError:
        return False
    return True


def _listed(values: Array) -> str:
    return wrapped("{" + ", ".join(f"{value + 0.0:.8g}" for value in values) + "}", 90, subsequent_indent="    ")
