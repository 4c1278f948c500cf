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
        ("u = v/v_0; f = -F*tanh(u)*sqrt(s)", {"F": "N", "v_0": "m/s", "u": "1", "s": "1"}),
        ("-c*(v/v_0)^n", {"c": "N", "v_0": "m/s", "n": "1"}),
        ("-c*v^(-2)", {"c": "kg.m3/s4"}),
        ("-F*(1 + k*x)*tanh(v/v_0)", {"F": "N", "k": "1/m", "v_0": "m/s"}),
        ("-F_c*tanh(v/v_0) + c*w", {"F_c": "N", "v_0": "m/s", "c": "N", "w": "1"}),
        ("-A*v - c*x", {"A": "N.s/m", "c": "N/m"}),
        ("2", {}),
    ],
)
def test_units_follow_where_the_law_determines_them(law: str, units: dict[str, str]) -> None:
    assert parameter_units(law_equations("own.law", law, SLOT), UNITS) == units


ORIFICE = Slot("orifice", "T.None", "T.Partial", ("q",), "", ("p",))
FLOW: dict[str, str | None] = {"p": "Pa", "q": "m3/s"}


@pytest.mark.parametrize(
    "law",
    [
        "Q_n*sqrt(p/p_n)",
        "sqrt(p/p_n)*Q_n",
        "Q_n*sign(p)*sqrt(abs(p)/p_n)",
        "Q_n*p/sqrt(p_n*(abs(p) + 100))",
        "Q_n*(p/p_n)/sqrt(abs(p)/p_n + 0.01)",
        "Q_n*(p/p_n)^0.5",
        "Q_n*(p/p_n)^(4/7)",
        "r = sqrt(p/p_n); q = Q_n*r",
        "r = p/p_n; q = Q_n*sqrt(r)",
    ],
)
def test_a_flow_through_an_orifice_has_a_nominal_flow_at_a_nominal_pressure(law: str) -> None:
    found = parameter_units(law_equations("own.law", law, ORIFICE), FLOW)
    assert {name: unit for name, unit in found.items() if name != "r"} == {"Q_n": "m3/s", "p_n": "Pa"}
    assert found.get("r", "1") == "1"


def test_a_smooth_orifice_and_one_with_a_conductance_beside_it_have_their_units() -> None:
    """Only A of the last is free: the flow per root of a pressure over a density is an area."""
    for law, given, units in (
        ("Q_n*p/sqrt(p_n*(abs(p) + p_s))", {}, {"Q_n": "m3/s", "p_n": "Pa", "p_s": "Pa"}),
        ("G*p + Q_n*sqrt(p/p_n)*a", {}, {"G": "m3/(s.Pa)", "Q_n": "m3/s", "p_n": "Pa", "a": "1"}),
        ("Q_n*sqrt(p/1e5)", {}, {"Q_n": "m3/s"}),
        ("alpha*A*sqrt(2*p/rho)", {"alpha": "1", "rho": "kg/m3"}, {"A": "m2"}),
    ):
        assert parameter_units(law_equations("own.law", law, ORIFICE), {**FLOW, **given}) == units
