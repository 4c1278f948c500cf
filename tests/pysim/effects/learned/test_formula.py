"""Formulas of curves whose shape is known, and of curves that are none."""

import math
from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray

from pysim.effects.learned import SHAPES, Formula, Shape, curve_basis, formulas
from pysim.types import EffectParameter
from pysim.types.answer import LearnedLaw
from pysim.types.factor import Factor, Form

Array = NDArray[np.float64]
KNOTS = np.linspace(-20e-3, 20e-3, 9)  # m


def learned(h: Callable[[Array], Array], sd: float, seed: int = 0, knots: Array = KNOTS) -> LearnedLaw:
    """A curve regressed on 2000 noisy values of h, each coefficient known to about `sd`."""
    rng = np.random.default_rng(seed)
    z = rng.uniform(knots[0], knots[-1], 2000)
    noise = sd * math.sqrt(2000 / knots.size)
    basis = curve_basis(z, knots)
    inverse: Array = np.asarray(np.linalg.inv(basis.T @ basis), dtype=np.float64)
    c = inverse @ basis.T @ (h(z) + noise * rng.standard_normal(z.size))
    return LearnedLaw("pistonForce", Factor(Form.VARIABLE, "v"), "x", knots, c, inverse * noise**2, 0.5, "m", "N.s/m")


def within(found: Formula, **right: float) -> None:
    """Every parameter is within three of its standard deviations."""
    deviations = np.sqrt(np.diag(found.covariance))
    assert {p.name for p in found.parameters} == set(right)
    for one, deviation in zip(found.parameters, deviations, strict=True):
        assert abs(one.default - right[one.name]) < 3 * deviation, one
        assert deviation < 0.2 * abs(right[one.name]), one


@pytest.mark.parametrize(
    ("h", "shapes", "right"),
    [
        (lambda z: 1e4 + 4e7 * z**2, ("constant", "square"), {"a_1": 1e4, "a_2": 4e7}),
        (lambda z: 3e5 * z, ("line",), {"a_1": 3e5}),
        (lambda z: 1e9 * z**3, ("cube",), {"a_1": 1e9}),
        (lambda z: 5e5 * np.abs(z), ("size",), {"a_1": 5e5}),
        (lambda z: 3e3 * np.tanh(z / 4e-3), ("smooth sign",), {"a_1": 3e3, "w_1": 4e-3}),
        (lambda z: 8e3 * np.exp(-((z / 6e-3) ** 2)), ("bell",), {"a_1": 8e3, "w_1": 6e-3}),
        (lambda z: 4e5 * np.maximum(z - 5e-3, 0), ("from a place on",), {"a_1": 4e5, "w_1": 5e-3}),
    ],
)
def test_known_shapes_come_back_within_their_intervals(
    h: Callable[[Array], Array], shapes: tuple[str, ...], right: dict[str, float]
) -> None:
    law = learned(h, sd=150.0)
    best = formulas(law)[0]
    assert best.shapes == shapes
    within(best, **right)
    z = np.linspace(-20e-3, 20e-3, 50)
    assert best(z) == pytest.approx(h(z), abs=0.05 * float(np.ptp(h(z))))


def test_what_the_model_absorbs_is_no_part_of_the_formula() -> None:
    law = replace(learned(lambda z: -9e3 + 4e7 * z**2, sd=150.0), absorbed=np.ones((9, 1)))
    best = formulas(law)[0]
    assert best.shapes == ("square",)
    within(best, a_1=4e7)
    assert best.absorbed / 3 == pytest.approx([-9e3], rel=0.05)  # along a direction of length 1


def test_a_turbulent_flow_is_a_signed_root() -> None:
    knots = 1e7 * np.sinh(np.linspace(-2, 2, 11)) / math.sinh(2)
    law = learned(lambda p: 2e-9 * np.sign(p) * np.sqrt(np.abs(p)), 5e-8, knots=knots)
    (first, *_) = formulas(replace(law, argument="dp", argument_unit="Pa", unit="m3/s"))
    assert first.shapes == ("signed root",)
    assert first.parameters[0].default == pytest.approx(2e-9, rel=0.05)
    assert first.text("dp") == f"{first.parameters[0].default:.3g}*sign(dp)*sqrt(abs(dp))"


def test_noise_has_no_formula() -> None:
    assert [k for k in range(30) if formulas(learned(np.zeros_like, 100.0, seed=k))] == []


def test_a_curve_of_no_known_shape_has_no_formula() -> None:
    assert formulas(learned(lambda z: 3e3 * np.sin(z / 2.5e-3), sd=30.0)) == ()


def test_there_are_twenty_shapes_of_size_one() -> None:
    assert len({shape.name for shape in SHAPES}) == len(SHAPES) == 20


def test_units_of_amounts_are_those_of_the_curve_over_powers_of_the_argument() -> None:
    best = formulas(learned(lambda z: 1e4 + 4e7 * z**2, sd=150.0))[0]
    assert [p.unit for p in best.parameters] == ["N.s/m", "N.s/m3"]
    assert best.text("x") == f"{best.parameters[0].default:.3g} + {best.parameters[1].default:.3g}*x^2"


def test_a_written_formula_is_smooth_where_its_shape_has_a_kink() -> None:
    best = formulas(learned(lambda z: 5e5 * np.abs(z), sd=150.0))[0]
    fine = np.linspace(-1e-4, 1e-4, 2001)
    slopes = np.diff(best(fine)) / np.diff(fine)
    assert np.max(np.abs(np.diff(slopes))) < 0.01 * np.ptp(slopes)
    assert best.written("x") == f"a_1*sqrt(x^2 + {best.kink**2:.6g})"


@pytest.mark.parametrize("shape", SHAPES, ids=lambda shape: shape.name)
def test_the_slope_of_every_shape_is_its_derivative(shape: Shape) -> None:
    amount = EffectParameter("a_1", "1", -10, 10, 1, 2.0, 0.0)
    width = EffectParameter("w_1", "1", 0.1, 10, 1, 0.7, None)
    expression = f"a_1*({shape.form.replace('w', 'w_1')})"
    one = Formula((shape.name,), expression, (amount, width), np.eye(2), 0.05, np.zeros(0), 0.0, 1.0)
    slope = replace(one, expression=one.slope("z"))
    z = np.linspace(-1.5, 1.5, 40)
    assert slope(z) == pytest.approx((one(z + 1e-5) - one(z - 1e-5)) / 2e-5, rel=1e-5, abs=1e-6)


@pytest.mark.parametrize(
    ("h", "shape", "right"),
    [
        (lambda t: 8.5e3 * t, "line", {"a_1": 8.5e3}),
        (lambda t: -6e5 * np.exp(-t / 50), "decay", {"a_1": -6e5, "w_1": 50}),
    ],
)
def test_a_drift_is_named_though_the_model_absorbs_a_level_that_is_a_little_tilted(
    h: Callable[[Array], Array], shape: str, right: dict[str, float]
) -> None:
    """A large constant and as much of the tilted level would be a line, and the size of a time is the time."""
    knots = np.linspace(0, 150, 9)
    tilted = 1 + 0.05 * np.linspace(-1, 1, 9)
    law = learned(h, sd=1e3, knots=knots)
    keep = np.eye(9) - np.outer(tilted, tilted) / (tilted @ tilted)
    law = replace(law, covariance=keep @ law.covariance @ keep, absorbed=tilted[:, None] / np.linalg.norm(tilted))
    best = formulas(replace(law, argument="time", argument_unit="s", unit="Pa"))[0]
    assert best.shapes == (shape,)
    within(best, **right)
