"""What the curve of a learned law is multiplied with."""

from __future__ import annotations

import math
from dataclasses import dataclass
from enum import Enum


class Form(Enum):
    """What the factor of a law is."""

    ONE = "1"
    VARIABLE = "a variable"
    SIGN = "the smooth sign of a variable"
    BRISTLE = "the deflection of a bristle that a speed pulls"
    HYSTERESIS = "the deflection of a bristle that a variable pulls as it moves"
    TONE = "a cosine of time"


@dataclass(frozen=True)
class Factor:
    """The factor of a law; its text is "" for 1, "v", "sign(v)", "bristle(v, 0.0005)", "hysteresis(s, 0.02)"
    or "cos(151.8*time + 0.4)".

    Args:
        form: what it is.
        variable: of the slot, as the slot calls it; "" for 1 and for a tone.
        number: width over which a sign changes, in its variable's unit; length of a bristle, in that unit times s,
            over which its deflection is given (Dahl 1968); that length of a hysteresis, in its variable's unit; phase
            of a tone, rad.
        rate: angular frequency of a tone on the common clock of all records, rad/s.
    """

    form: Form = Form.ONE
    variable: str = ""
    number: float = 1.0
    rate: float = 0.0

    def __str__(self) -> str:
        if self.form is Form.SIGN:
            return f"sign({self.variable})"
        if self.form in (Form.BRISTLE, Form.HYSTERESIS):
            return f"{self.form.name.lower()}({self.variable}, {self.number:.4g})"
        if self.form is Form.TONE:
            return f"cos({self.rate:.7g}*time + {self.number % (2 * math.pi):.4g})"
        return self.variable
