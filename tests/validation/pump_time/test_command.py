"""The command of the time response, and the cubics that stand for it."""

import numpy as np

from validation.pump_time.case import command, reference_response, spline


def test_rate_is_the_derivative() -> None:
    t = np.linspace(0.01, 5.0, 700)
    h = 1e-5
    central = (command(t + h)[0] - command(t - h)[0]) / (2 * h)
    np.testing.assert_allclose(command(t)[1], central, atol=1e-4)  # h^2/6 times the third derivative, 4.5e5 %/s^3


def test_cubics_stay_with_the_command() -> None:
    signal = spline(np.arange(0.0, 5.0015, 1e-3))
    t = np.random.default_rng(5).uniform(0.0, 5.0, 3000)
    value, rate = command(t)
    np.testing.assert_allclose(signal.value(t), value, atol=2e-7)
    np.testing.assert_allclose(signal.derivative(t), rate, atol=1e-3)


def test_reference_starts_at_rest_in_si_units() -> None:
    reference = reference_response()
    assert reference.time.shape == (2501,)
    assert [reference[name][0] for name in reference.names] == [0.0, 0.0, 8.5e6, 8.5e6]
