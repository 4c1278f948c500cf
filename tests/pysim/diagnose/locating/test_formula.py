"""Formulas for tables: laws put in come out, also where refitting hides part of them, and noise stays without one."""

import numpy as np
import pytest

from pysim.diagnose.locating.formula import formula

K = np.array([-0.3, -0.1, -0.04, -0.015, -0.005, -0.001, 0.0, 0.001, 0.005, 0.015, 0.04, 0.1, 0.3])
NONE = np.zeros((K.size, 0))


def found(values, absorbed=NONE, *, noise=0.5, argument="pistonForce.v", units=("m/s", "N"), **more):
    covariance = noise**2 * np.eye(K.size)
    return formula(K, values, covariance, absorbed, argument=argument, unit_in=units[0], unit_out=units[1], **more)


@pytest.mark.parametrize(
    ("values", "units", "form", "text"),
    [
        (-80 * np.sign(K), ("m/s", "N"), "sign", "-80 N sign(z)"),
        (-2.4e4 * K**3, ("m", "N"), "cube", "-2.4e+04 N/m3 z^3"),
        (
            -np.clip(K, -0.015, 0.015),
            ("1", "1"),
            "saturation",
            "-limit(z, +-0.0138), a dead band",
        ),  # the nearest width that is tried
        (30 * K * np.abs(K), ("m/s", "N"), "square", "30 N/(m/s)2 z abs(z)"),
        (5 * K, ("m", "N"), "linear", "5 N/m z"),
    ],
)
def test_a_law_that_was_put_in_comes_out_with_its_unit(
    values: np.ndarray, units: tuple[str, str], form: str, text: str
) -> None:
    said = found(values, noise=1e-3 * np.abs(values).max(), argument="z", units=units)
    assert (said.form, said.text) == (form, text)


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


def test_a_law_that_is_not_in_the_library_has_no_formula() -> None:
    assert found(np.cos(60 * np.arcsinh(K / 0.01)), noise=1e-3).text == ""


def test_what_is_wholly_absorbed_is_no_formula() -> None:
    line = (K / np.linalg.norm(K))[:, None]
    assert found(1e-9 * np.ones(K.size) * np.sign(K), line, noise=10.0).text == ""
