"""A law while it is typed: names become parameters with units and values, and what is wrong has its place."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from pysim.effects import LawRefused
from pysim.types import BadInput
from pysim.workflow import LawPlace, typed_law
from tests.toy import TEXT

F_C, V_0 = 0.4, 0.02  # N, m/s
KNOTS = np.linspace(-0.2, 0.2, 41)


@pytest.fixture
def place(tmp_path: Path) -> LawPlace:
    (tmp_path / "Toy.mo").write_text(TEXT)
    return LawPlace.of("Toy.Mass", "force", [tmp_path / "Toy.mo"])


def learned(curve: Callable[[Any], Any], absorbed: Any = ()) -> dict[str, Any]:
    """A learned law over the velocity."""
    value = curve(KNOTS)
    band = {"low": (value - 0.01).tolist(), "high": (value + 0.01).tolist(), "absorbed": absorbed}
    shape = {"argument": KNOTS.tolist(), "value": value.tolist(), "argument_unit": "m/s", "unit": "N", **band}
    return {"slot": "force", "depends_on": "force.v", "factor": "", "shape": shape}


def test_usual_values_follow_the_learned_curve(place: LawPlace) -> None:
    law = learned(lambda v: -F_C * np.tanh(v / V_0) - 2 * v)
    found = typed_law("-F_c*tanh(v/v_0) - c*v", place, law)
    values = {name: own[2] for name, own in found.ranges.items()}
    assert values == pytest.approx({"F_c": F_C, "v_0": V_0, "c": 2.0}, rel=0.01)
    assert {name: own[3] for name, own in found.ranges.items()} == {"F_c": "N", "v_0": "m/s", "c": "N.s/m"}
    assert found.curve == pytest.approx(law["shape"]["value"], abs=0.01 * F_C)
    assert {name: own[0] for name, own in found.ranges.items()} == pytest.approx({"F_c": 0, "v_0": V_0 / 10, "c": 0})


def test_what_the_models_own_parameters_may_add_is_not_the_laws(place: LawPlace) -> None:
    law = learned(lambda v: -F_C * np.tanh(v / V_0) + 1.5 * v, [[v] for v in KNOTS.tolist()])
    found = typed_law("-F_c*tanh(v/v_0)", place, law)
    assert {name: own[2] for name, own in found.ranges.items()} == pytest.approx({"F_c": F_C, "v_0": V_0}, rel=0.01)
    assert found.curve == pytest.approx(law["shape"]["value"], abs=0.01 * F_C)


def test_usual_values_follow_a_curve_that_changes_sign_with_another_variable(place: LawPlace) -> None:
    """Dry friction, learned as the sign of the velocity times a curve over the way: 0.4 N less 0.5 N/m of it."""
    law = learned(lambda x: -(F_C - 0.5 * x))
    law |= {"depends_on": "force.x", "factor": "sign(v)", "sign_of": "v", "sign_width": V_0 / 10}
    law["shape"]["argument_unit"] = "m"
    found = typed_law("-(F_c - b*x)*tanh(v/0.002)", place, law)
    assert {name: own[2] for name, own in found.ranges.items()} == pytest.approx({"F_c": F_C, "b": 0.5}, rel=0.01)
    assert found.curve == pytest.approx(law["shape"]["value"], abs=0.01 * F_C)
    assert typed_law("-c*x", place, law).curve == pytest.approx(np.zeros(KNOTS.size))  # no part of it turns


def test_what_was_chosen_stays_and_the_others_follow(place: LawPlace) -> None:
    law = learned(lambda v: -F_C * np.tanh(v / V_0))
    found = typed_law("-F_c*tanh(v/v_0)", place, law, {"v_0": (0.01, 0.1, 0.05, "m/s"), "gone": (0, 1, 1, "1")})
    assert found.ranges["v_0"] == (0.01, 0.1, 0.05, "m/s")
    assert found.ranges["F_c"][2] > F_C  # a wider sign change has to be higher
    assert "gone" not in found.ranges


def test_a_law_of_another_variable_has_no_curve_but_its_parameters(place: LawPlace) -> None:
    found = typed_law("-k_3*x^3", place, learned(np.tanh))
    assert found.curve is None
    assert found.ranges == {"k_3": (0.0, 1000.0, 1.0, "N/m3")}  # a guess may be far off
    assert typed_law("-k_3*x^3", place).ranges == found.ranges


def test_a_root_of_a_ratio_follows_the_learned_curve(place: LawPlace) -> None:
    law = learned(lambda v: -F_C * np.sign(v) * np.sqrt(np.abs(v) / V_0))
    found = typed_law("-F_n*sign(v)*sqrt(abs(v)/v_n)", place, law)
    assert {name: own.unit for name, own in found.ranges.items()} == {"F_n": "N", "v_n": "m/s"}
    size = found.ranges["F_n"].usual / np.sqrt(found.ranges["v_n"].usual)
    assert size == pytest.approx(F_C / np.sqrt(V_0), rel=0.01)  # only this quotient acts


@pytest.mark.parametrize(
    ("law", "at", "said"),
    [
        ("-F_c*tan(v)", 5, "tan is no function"),
        ("-F_c*tanh(v", 11, "law"),
        ("f = -F_c*v; g", 12, "law"),
        ("v - 2*x", 0, "- takes m/s and m together"),
        ("-F*tanh(v) + x", 0, "tanh is given m/s"),
        ("-F + v", 0, r"\+ takes N and m/s together"),
        ("-C*sqrt(v)", 1, "the parameter C: .* is no unit of Modelica; .* under a root a ratio, as in Q_n"),
        ("-C*v^(1/2)", 1, "the parameter C: .* is no unit of Modelica"),
        ("-c*v^n", 0, r"\^ is given m/s; divide by a width"),
        ("-c*v^(2^30)", 0, "a power of 30 is no law"),
        ("", 0, "law"),
    ],
)
def test_a_mistake_has_its_place(place: LawPlace, law: str, at: int, said: str) -> None:
    with pytest.raises(LawRefused, match=said) as refused:
        typed_law(law, place)
    assert refused.value.place == at


def test_a_slot_that_the_model_has_not_is_refused(place: LawPlace) -> None:
    with pytest.raises(BadInput, match=r"Toy\.Mass has no slot nowhere"):
        LawPlace.of("Toy.Mass", "nowhere", place.libraries)
