"""Formulas for tables: laws put in come out, also where refitting hides part of them, and noise stays without one."""

import numpy as np
import pytest

from pysim.diagnose.locating.formula import formula
from pysim.types import Effect, EffectParameter

K = np.array([-0.3, -0.1, -0.04, -0.015, -0.005, -0.001, 0.0, 0.001, 0.005, 0.015, 0.04, 0.1, 0.3])
NONE = np.zeros((K.size, 0))
F_C = EffectParameter("F_c", "N", 0, 1e3, 50, 0.0, 0.0)
FRICTION = Effect("friction.coulomb", "pistonForce", "E.F", (F_C,))


def found(values, absorbed=NONE, *, noise=0.5, argument="pistonForce.v", units=("m/s", "N"), **more):
    covariance = noise**2 * np.eye(K.size)
    return formula(K, values, covariance, absorbed, argument=argument, unit_in=units[0], unit_out=units[1], **more)


def test_dry_friction_is_known_by_name() -> None:
    said = found(-80 * np.sign(K), slot="pistonForce", catalogue=[FRICTION])
    assert (said.form, said.effect) == ("sign", "friction.coulomb")
    assert said.text == "-80 N sign(pistonForce.v)"


def test_the_name_belongs_to_its_slot() -> None:
    assert found(-80 * np.sign(K), slot="elsewhere", catalogue=[FRICTION]).effect == ""


@pytest.mark.parametrize("hidden", [0.0, 300.0])
def test_what_refitting_absorbs_does_not_hide_the_law(hidden: float) -> None:
    line = (K / np.linalg.norm(K))[:, None]
    values = -80 * np.sign(K) + hidden * K
    said = found(values - line @ (line.T @ values), line)
    assert said.form == "sign"
    shown = values - line @ (line.T @ values) + line @ said.along
    np.testing.assert_allclose(shown, -80 * np.sign(K), atol=1.0)


def test_a_direction_that_the_data_leave_open_hides_nothing_else() -> None:
    line = (K / np.linalg.norm(K))[:, None]
    covariance = 0.5**2 * np.eye(K.size) + 1e22 * line @ line.T
    assert np.linalg.eigvalsh(covariance)[0] < 0  # by rounding
    names = {"argument": "pistonForce.v", "unit_in": "m/s", "unit_out": "N"}
    assert formula(K, -80 * np.sign(K) + 300 * K, covariance, NONE, **names).form == "sign"


def test_a_dead_band_is_a_saturation_of_slope_minus_one() -> None:
    said = found(-np.clip(K, -0.015, 0.015), noise=1e-4, argument="spoolOpening.s", units=("1", "1"))
    assert said.form == "saturation"
    assert said.text.endswith("a dead band")


def test_a_cube_has_its_unit() -> None:
    said = found(-2.4e4 * K**3, noise=1.0, argument="pistonForce.x", units=("m", "N"))
    assert (said.form, said.text) == ("cube", "-2.4e+04 N/m3 pistonForce.x^3")


def test_a_law_that_is_not_in_the_library_has_no_formula() -> None:
    assert found(np.cos(60 * np.arcsinh(K / 0.01)), noise=1e-3).text == ""


def test_what_is_wholly_absorbed_is_no_formula() -> None:
    line = (K / np.linalg.norm(K))[:, None]
    assert found(1e-9 * np.ones(K.size) * np.sign(K), line, noise=10.0).text == ""
