"""True terms against the plant's own equations, and shares of a range by hand."""

import math

import numpy as np
import pytest

from pysim.effects import STANDARD_LIBRARY, read_catalogue
from pysim.types import Missing
from pysim.types.diagnosis import Shape
from validation.blind.benchmark.slots import SLOTS
from validation.blind.benchmark.terms import EXACT, NEARLY, covered, true_term
from validation.blind.plant.effects import STANDARD, draw_effect, told
from validation.blind.plant.equations import _force, _stiffness
from validation.blind.plant.quantities import Parameters, Strengths


def found(over: str, z: np.ndarray, unit_in: str, unit: str, half: float = 1.0, absorbed: np.ndarray | None = None):
    zero = np.zeros(z.size)
    shape = Shape(z, zero, zero - half, zero + half, unit_in, unit, np.zeros((0, 0)) if absorbed is None else absorbed)
    return Missing(over.rpartition(".")[0], 1.0, over, shape)


@pytest.mark.parametrize(
    ("effect", "over"),
    [(e, o) for e, o in EXACT if o.startswith("pistonForce") and e not in ("swash.bias",)],
)
def test_forces_are_those_of_the_plant(effect: str, over: str) -> None:
    strengths = Strengths(**draw_effect(effect, "middle", np.random.default_rng(1)))
    z = np.linspace(-0.02, 0.02, 41)
    x, v = (z, 0 * z) if over.endswith("x") else (0 * z, z)
    plant = [_force(float(a), float(b), 0.0, strengths) for a, b in zip(x, v, strict=True)]
    unit = "m" if over.endswith("x") else "m/s"
    np.testing.assert_allclose(true_term(effect, told(effect, strengths), found(over, z, unit, "N"), 1.0), plant)


def test_air_is_the_compressibility_that_the_plant_has_more() -> None:
    strengths, p = Strengths(air__eps=0.02), np.linspace(1e5, 170e5, 30)
    more = [1 / _stiffness(float(one), Parameters(), strengths) - 1 / Parameters().beta for one in p]
    np.testing.assert_allclose(true_term("oil.air", {"eps": 0.02}, found("oil.p", p, "Pa", "1/Pa"), 1.0), more)


def test_a_longer_stroke_has_smaller_forces_over_longer_ways() -> None:
    z = np.linspace(-0.02, 0.02, 5)
    got = true_term("spring.hardening", {"k_3": 2e6}, found("pistonForce.x", z, "m", "N"), 1.25)
    np.testing.assert_allclose(got, -2e6 * (z / 1.25) ** 3 / 1.25)


def test_no_function_of_something_else_is_told() -> None:
    z = np.linspace(-1.0, 1.0, 5)
    assert true_term("friction.coulomb", {"F_c": 1.0}, found("pistonForce.x", z, "m", "N"), 1.0) is None


def test_every_law_is_at_the_slot_of_its_effect() -> None:
    names = {e.name for e in read_catalogue(STANDARD_LIBRARY)}
    for effect, over in (*EXACT, *NEARLY):
        assert effect in names
        assert effect in STANDARD
        assert over.removeprefix("der(").startswith(f"{SLOTS[effect]}.")


def test_the_share_of_the_range_within_the_band() -> None:
    z = np.linspace(0.0, 1.0, 101)
    assert covered(found("a.b", z, "1", "1", half=0.5), z) == pytest.approx(51 / 101)


def test_any_amount_of_what_is_absorbed_may_be_there() -> None:
    z = np.linspace(-1.0, 1.0, 101)
    slope = (z / math.sqrt(float(z @ z)))[:, None]
    assert covered(found("a.b", z, "1", "1", 0.1, slope), 30 * z) == 1
    assert covered(found("a.b", z, "1", "1", 0.1, slope), 30 * z + np.sign(z)) < 1
