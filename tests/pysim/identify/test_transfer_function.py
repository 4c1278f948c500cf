"""Transfer functions against closed forms."""

import numpy as np
import pytest

from pysim.identify import TransferFunction, magnitude_db
from pysim.types import BadInput, SineTest

TEST = SineTest(0.0, 1.0, "u", "y")


def test_first_order_lag() -> None:
    f = np.array([0.1, 1.0, 10.0])
    response = TransferFunction((3.0,), (0.05, 1.0)).response(f, TEST)
    wT = 2 * np.pi * f * 0.05
    np.testing.assert_allclose(response.gain, 3 / np.sqrt(1 + wT**2))
    np.testing.assert_allclose(response.phase, -np.arctan(wT))
    np.testing.assert_allclose(magnitude_db(response, None), 20 * np.log10(3 / np.sqrt(1 + wT**2)))


def test_phase_goes_on_below_half_a_turn_even_on_a_coarse_grid() -> None:
    response = TransferFunction((1.0,), (1.0, 5.0, 10.0, 10.0, 5.0, 1.0)).response(np.array([1e-3, 1e3]), TEST)
    np.testing.assert_allclose(response.phase, [-5 * np.arctan(2e-3 * np.pi), -5 * np.arctan(2e3 * np.pi)])  # 1/(s+1)^5


def test_phase_of_a_zero_in_the_right_half_plane() -> None:
    f = np.geomspace(0.01, 100, 7)
    response = TransferFunction((-1.0, 1.0), (1.0, 1.0)).response(f, TEST)
    np.testing.assert_allclose(response.phase, -2 * np.arctan(2 * np.pi * f))
    np.testing.assert_allclose(response.gain, 1.0)


def test_agrees_with_the_unwrapped_angle_on_a_fine_grid() -> None:
    tf = TransferFunction((61788e6,), (1.0, 216.0, 89266.0, 12047e3, 1426e6, 61788e6))
    f = np.linspace(0.05, 40, 4000)
    np.testing.assert_allclose(tf.response(f, TEST).phase, np.unwrap(np.angle(tf.at(f))), atol=1e-9)


def test_refuses_a_denominator_of_nothing() -> None:
    with pytest.raises(BadInput, match="first coefficient"):
        TransferFunction((1.0,), (0.0, 1.0))


def test_dead_time_turns_the_phase_and_leaves_the_gain() -> None:
    f = np.array([0.1, 1.0, 30.0])
    lag, delayed = TransferFunction((3.0,), (0.05, 1.0)), TransferFunction((3.0,), (0.05, 1.0), dead_time=0.04)
    np.testing.assert_allclose(delayed.at(f), lag.at(f) * np.exp(-2j * np.pi * f * 0.04))
    before, after = (function.response(f, TEST) for function in (lag, delayed))
    np.testing.assert_allclose(after.gain, before.gain)
    np.testing.assert_allclose(after.phase, before.phase - 2 * np.pi * f * 0.04)  # far beyond half a turn, unwrapped
    with pytest.raises(BadInput, match="dead time"):
        TransferFunction((1.0,), (1.0,), dead_time=-0.01)


def test_poles_zeros_gain_and_stability() -> None:
    function = TransferFunction((2.0, 6.0), (1.0, 6.0, 25.0))  # zero -3; poles -3 +- 4j
    np.testing.assert_allclose(function.poles, [-3 - 4j, -3 + 4j])
    np.testing.assert_allclose(function.zeros, [-3])
    assert (function.gain, function.stable) == (6 / 25, True)
    integrator = TransferFunction((1.0,), (1.0, 0.0))
    assert (integrator.gain, integrator.stable) == (np.inf, False)
    assert TransferFunction((1.0,), (2.0,)).poles.size == 0


def test_leading_zeros_do_not_turn_the_phase() -> None:
    f = np.array([0.1, 1.0])
    plain, padded = (TransferFunction(b, (1.0, 1.0)).response(f, TEST) for b in ((-2.0,), (0.0, 0.0, -2.0)))
    np.testing.assert_allclose(padded.phase, plain.phase)
    assert TransferFunction((0.0, 1.0, 5.0), (1.0, 1.0)).zeros.tolist() == [-5.0]
