"""The method behind the sensitivities: order conditions, stability, interpolant, nonlinear stages."""

import dataclasses

import numpy as np
import pytest

from pysim.simulate import Esdirk, simulate
from pysim.thesis import pump_model
from pysim.types import Experiment, Signal
from tests.pysim.simulate.fixture_fmus import STIFF

_METHOD = Esdirk().method()
_A, _C = _METHOD.a, _METHOD.c


def order_defects(b: np.ndarray) -> np.ndarray:
    """Left minus right sides of the eight conditions of orders 1 to 4 (Hairer, Norsett, Wanner I, II.2)."""
    left = [
        b.sum(),
        b @ _C,
        b @ _C**2,
        b @ _A @ _C,
        b @ _C**3,
        (b * _C) @ (_A @ _C),
        b @ _A @ _C**2,
        b @ _A @ _A @ _C,
    ]
    return np.array(left) - [1, 1 / 2, 1 / 3, 1 / 6, 1 / 4, 1 / 8, 1 / 12, 1 / 24]


def test_weights_meet_the_order_conditions():
    np.testing.assert_allclose(order_defects(_METHOD.b), 0, atol=1e-15)
    embedded = _METHOD.b - _METHOD.error[:-1]
    np.testing.assert_allclose(order_defects(embedded)[:4], 0, atol=1e-15)
    assert np.abs(order_defects(embedded)[4:]).min() > 1e-4  # order 3 and no more: it shows the error of order 4


def test_stages_have_order_two_and_end_with_the_step():
    np.testing.assert_allclose((_A @ _C)[1:], _C[1:] ** 2 / 2, atol=1e-15)
    np.testing.assert_array_equal(_A[-1], _METHOD.b)
    assert _C[-1] == 1.0
    assert _C.max() == 1.0
    np.testing.assert_allclose(np.diag(_A)[1:], _METHOD.gamma, rtol=0)


def amplification(z: complex) -> complex:
    """R(z) of x' = lambda x, z = h lambda."""
    return 1 + z * _METHOD.b @ np.linalg.solve(np.eye(6) - z * _A, np.ones(6))


def test_method_is_l_stable():
    assert abs(amplification(-1e9)) < 1e-6
    axis = [abs(amplification(1j * y)) for y in np.logspace(-1, 4, 500)]  # with no pole to its left, this bounds all
    assert max(axis) <= 1 + 1e-12


@pytest.mark.parametrize("theta", [0.1, 0.37, 0.5, 0.9, 1.0])
def test_interpolant_has_order_four_inside_the_step(theta):
    b = _METHOD.dense[:-1] @ theta ** np.arange(1, 5)
    got = [b.sum(), b @ _C, b @ _C**2, b @ _C**3, b @ _A @ _C**2, b @ _A @ _C]
    want = [theta, theta**2 / 2, theta**3 / 3, theta**4 / 4, theta**4 / 12, theta**3 / 6]
    np.testing.assert_allclose(got, want, atol=1e-14)


def test_interpolant_leaves_and_arrives_with_the_slopes_of_the_ends():
    np.testing.assert_allclose(_METHOD.dense[:-1, 0], np.eye(6)[0], atol=1e-13)
    np.testing.assert_allclose(_METHOD.dense[:-1] @ np.arange(1, 5), np.eye(6)[-1], atol=1e-13)


@pytest.mark.parametrize("degree", [0, 1])
def test_prediction_of_a_stage_is_exact_for_what_its_points_can_carry(degree):
    for i in range(2, 6):
        assert _METHOD.predict[i] @ _C**degree == pytest.approx(_C[i] ** degree, abs=1e-13)


@pytest.mark.parametrize("rate", [1.0, 1e3, 1e6])
def test_stiff_and_nonlinear_equations_are_solved(fixture_model, rate):
    times = np.linspace(0, 10, 41)
    experiment = Experiment(times, ("x", "y"), overrides={"rate": rate})
    record = simulate(fixture_model(STIFF), experiment, solver=Esdirk(1e-7, 1e-7))
    np.testing.assert_allclose(record["x"], np.sin(times), atol=2e-6)
    np.testing.assert_allclose(record["y"], 1 / (1 + times), rtol=2e-6)
    assert record.statistics["steps"] < 1500  # explicit, the stiffest would take millions


def test_without_directional_derivatives_steps_are_as_long():
    """The Jacobian is then a difference from points that Newton has only nearly reached."""
    pump = pump_model("free")
    bare = dataclasses.replace(pump, abilities=dataclasses.replace(pump.abilities, directional_derivatives=False))
    experiment = Experiment(np.array([0.0, 0.1]), ("alphaPercent",), {"alphaCMD": Signal.constant(50.0)})
    exact, differences = (simulate(model, experiment, solver=Esdirk()) for model in (pump, bare))
    assert differences.statistics["steps"] < 1.1 * exact.statistics["steps"]
    np.testing.assert_allclose(differences.values, exact.values, rtol=1e-4)
