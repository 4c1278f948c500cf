"""Formulas for tables: laws put in come out, also where refitting hides part of them, and noise stays without one."""

import re
from collections.abc import Callable

import numpy as np
import pytest

from pysim.diagnose.locating.formula import formula

K = np.array([-0.3, -0.1, -0.04, -0.015, -0.005, -0.001, 0.0, 0.001, 0.005, 0.015, 0.04, 0.1, 0.3])
NONE = np.zeros((K.size, 0))


def found(values, absorbed=NONE, *, noise=0.5, argument="pistonForce.v", units=("m/s", "N"), **more):
    covariance = noise**2 * np.eye(K.size)
    return formula(K, values, covariance, absorbed, argument=argument, unit_in=units[0], unit_out=units[1], **more)


WIDE, ABOVE = 0.04, np.abs(K) + 0.002  # about the width of a law; places on one side of zero


@pytest.mark.parametrize(
    ("k", "law", "form", "amounts"),
    [
        (K, lambda z: 2 + 0 * z, "constant", [2]),
        (K, lambda z: 5 * z, "linear", [5]),
        (K, lambda z: 30 * z * np.abs(z), "square", [30]),
        (K, lambda z: -2.4e4 * z**3, "cube", [-2.4e4]),
        (K, lambda z: -80 * np.sign(z), "sign", [-80]),
        (K, lambda z: 3 * np.tanh(z / WIDE), "sign", [3, WIDE]),
        (K, lambda z: np.sign(z) * (2 + 3 * np.exp(-np.abs(z) / WIDE)), "sign and fall", [2, 3, WIDE]),
        (K, lambda z: 7 * (z - np.clip(z, -WIDE, WIDE)), "beyond", [7, WIDE]),
        (K, lambda z: 2 + 30 * z, "constant and linear", [2, 30]),
        (K, lambda z: -5 * z + 90 * z**3, "linear and cube", [-5, 90]),
        (K, lambda z: 2 + 3 * np.sign(z), "constant and sign", [2, 3]),
        (np.unique(ABOVE), lambda z: 4 / (z + WIDE), "falling", [4, WIDE]),
        (np.unique(ABOVE), lambda z: 4 / (z + WIDE) ** 2, "falling", [4, WIDE]),
    ],
)
def test_a_law_that_was_put_in_comes_out_with_its_numbers(
    k: np.ndarray, law: Callable[[np.ndarray], np.ndarray], form: str, amounts: list[float]
) -> None:
    values = law(k)
    covariance = (1e-3 * np.abs(values).max()) ** 2 * np.eye(k.size)
    said = formula(k, values, covariance, np.zeros((k.size, 0)), argument="z", unit_in="1", unit_out="N")
    assert said.form == form
    told = [float(word) for word in re.findall(r"-?\d+(?:\.\d+)?(?:e[+-]\d+)?", said.text.replace("+-", ""))]
    for amount in amounts:  # widths are tried in steps of a third, and amounts beside them give way a little
        assert min(abs(word / amount - 1) for word in told) < (0.25 if len(amounts) > 1 else 0.01)


@pytest.mark.parametrize(
    ("values", "units", "text"),
    [
        (-2.4e4 * K**3, ("m", "N"), "-2.4e+04 N/m3 z^3"),
        (30 * K * np.abs(K), ("m/s", "N"), "30 N/(m/s)2 z abs(z)"),
        (-np.clip(K, -0.015, 0.015), ("1", "1"), "-limit(z, +-0.0138), a dead band"),  # of the widths that are tried
    ],
)
def test_a_formula_has_units(values: np.ndarray, units: tuple[str, str], text: str) -> None:
    assert found(values, noise=1e-3 * np.abs(values).max(), argument="z", units=units).text == text


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
