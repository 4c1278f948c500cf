"""Units of a law's parameters follow from what the slot sees and gives."""

import pytest

from pysim.effects import Slot, law_equations, parameter_units

SLOT = Slot("force", "T.None", "T.Partial", ("f",), "", ("x", "v"))
UNITS: dict[str, str | None] = {"x": "m", "v": "m/s", "f": "N", "time": "s"}


@pytest.mark.parametrize(
    ("law", "units"),
    [
        ("-F_c*tanh(v/v_0)", {"F_c": "N", "v_0": "m/s"}),
        ("-c*v - c_2*v*abs(v) - k*x - k_3*x^3", {"c": "N.s/m", "c_2": "N.s2/m2", "k": "N/m", "k_3": "N/m3"}),
        ("-F*exp(-((x - x_0)/w)^2)", {"F": "N", "x_0": "m", "w": "m"}),
        ("-F*tanh(v/0.01)", {"F": "N"}),
        ("if v > v_1 then F_1 else a*F_1", {"v_1": "m/s", "F_1": "N", "a": "1"}),
        ("u = v/v_0; f = -F*tanh(u)*sqrt(s)", {"F": "", "v_0": "m/s", "u": "1", "s": ""}),
        ("-c*v^n", {"c": "", "n": "1"}),
        ("2", {}),
    ],
)
def test_units_follow_where_the_law_determines_them(law: str, units: dict[str, str]) -> None:
    assert parameter_units(law_equations("own.law", law, SLOT), UNITS) == units
