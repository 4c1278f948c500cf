"""Which laws may be tried at a place, and how the compiled term is set to one of them.

A law is `factor*h(argument)`, added to a variable that a slot computes. h is the curve of `curve.py`. The argument is a
variable of the slot ("force.x"), another variable of the model, or `time` on the common clock of all records. The
factor is 1, a variable of the slot or its smooth sign, a bristle that follows a speed and remembers, or a tone
(`pysim.types.factor`).
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pysim.effects.learned.curve import widths
from pysim.effects.learned.places import Place, Side
from pysim.types.factor import Factor, Form

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Law:
    """One law: a place, an argument and a factor.

    Args:
        place: where it is added.
        chosen: index of its argument in `place.arguments`.
        form: what its factor is.
        by: index of the factor's variable in `own` of each side; None for 1 and for a tone.
        number: of the factor: the width over which a sign changes, in its variable's unit; the length of a bristle, in
            that unit times s, or of a hysteresis, in that unit; the phase of a tone, rad. Widths are not refitted.
        rate: angular frequency of a tone, rad/s.
    """

    place: Place
    chosen: int
    form: Form = Form.ONE
    by: int | None = None
    number: float = 1.0
    rate: float = 0.0

    @property
    def argument(self) -> str:
        """Name of the argument on the first side."""
        return self.place.arguments[self.chosen]

    @property
    def factor(self) -> Factor:
        """The factor, with the name of its variable in the slot."""
        variable = "" if self.by is None else self.place.sides[0].own[self.by].removeprefix(f"{self.place.name}.")
        return Factor(self.form, variable, self.number, self.rate)

    @property
    def free(self) -> tuple[str, ...]:
        """Name of the parameter that holds the factor's number if it is refitted."""
        last = "l" if self.is_bristle else "p" if self.form is Form.TONE else ""
        return (f"{self.place.key}_{last}",) if last else ()

    @property
    def is_bristle(self) -> bool:
        """Whether the factor is the deflection of a bristle, whatever pulls on it."""
        return self.form in (Form.BRISTLE, Form.HYSTERESIS)

    @property
    def start(self) -> Array:
        """(1,) start of the factor's number in the search, of a length its logarithm; (0,) if it is not refitted."""
        own = math.log(self.number) if self.is_bristle else self.number
        return np.full(len(self.free), own)

    @property
    def label(self) -> str:
        """The law as text, such as "force: sign(v) * h(force.x)", without the number of its factor."""
        own = self.factor
        factor = f"tone({self.rate / (2 * math.pi):.4g} Hz)" if self.form is Form.TONE else str(own)
        factor = f"{self.form.name.lower()}({own.variable})" if self.is_bristle else factor
        return f"{self.place.name}: {factor + ' * ' if factor else ''}h({self.argument})"

    def seen(self, side: Side) -> tuple[str, str]:
        """Full names of argument and factor on one side; "" for the factor 1."""
        argument = (*side.own, *self.place.outside)[self.chosen]
        return argument, "" if self.by is None else side.own[self.by]

    def settings(self, knots: Array, unit: float = 1.0) -> dict[str, float]:
        """Parameter values that turn the compiled term into this law, with knots (m,); `unit` scales coefficients."""
        key, wide, form = self.place.key, widths(knots), self.form
        found = {f"{key}_u": unit}
        found |= {f"{key}_a{i}": float(i == self.chosen) for i in range(len(self.place.arguments))}
        found[f"{key}_b"] = float(form is Form.ONE)
        for i in range(len(self.place.sides[0].own)):
            found[f"{key}_b{i}"] = float(i == self.by and form is Form.VARIABLE)
            found[f"{key}_s{i}"] = float(i == self.by and form is Form.SIGN)
            found[f"{key}_d{i}"] = self.number if form is Form.SIGN else 1.0
            if self.free:
                found[f"{key}_m{i}"] = float(i == self.by and self.is_bristle)
        if self.free:
            found |= {f"{key}_t": float(form is Form.TONE), f"{key}_f": self.rate, self.free[0]: self.number}
        for i, (k, w) in enumerate(zip(knots.tolist(), wide.tolist(), strict=True), start=1):
            found[f"{key}_k{i}"], found[f"{key}_w{i}"] = k, w
        return found


def laws_at(place: Place) -> Iterator[Law]:
    """All laws of a place without memory. The factor is never the argument itplace, which the curve can hold."""
    for i in range(len(place.arguments)):
        yield Law(place, i)
    if place.sides[0].output_rate:
        return
    for factor in range(len(place.sides[0].own)):
        for i in range(len(place.arguments)):
            if i != factor:
                yield Law(place, i, Form.VARIABLE, factor)
                yield Law(place, i, Form.SIGN, factor)
