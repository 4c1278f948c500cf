"""The local fit on curves whose extremes are known."""

import numpy as np
import pytest

from pysim.identify.chirp.cycle_fit import Extreme, Samples, fit_cycle, regressors
from tests.pysim.identify.seeds import seeds


def samples(per_turn: float, turns: float = 12.0, noise: float = 0.0, seed: int = 0) -> Samples:
    angle = 0.3 + 2 * np.pi * np.arange(int(turns * per_turn)) / per_turn
    values = curve(angle) + noise * np.random.default_rng(seed).standard_normal(angle.size)
    return Samples(angle, values, np.full(angle.size, per_turn), np.zeros(angle.size))


def curve(angle: np.ndarray) -> np.ndarray:
    return 3.0 + (2.0 + 0.01 * angle) * np.sin(angle - 0.8) + 0.3 * np.cos(2 * angle)


def top(given: Samples) -> Extreme:
    """The top next to 33.8 rad."""
    fit = fit_cycle(given, 30.0)
    assert fit is not None
    extreme = fit.extreme(31.0 + 2.79, 1)
    assert extreme is not None
    return extreme


@pytest.mark.parametrize("per_turn", [9.3, 25.0, 250.0])
@pytest.mark.parametrize("sign", [1, -1])
def test_finds_the_extreme_between_samples(per_turn: float, sign: int) -> None:
    fit = fit_cycle(samples(per_turn), 30.0)
    assert fit is not None
    start = 30.0 + float(np.remainder(0.5 * np.pi * sign + 0.8 - 30.0 + np.pi, 2 * np.pi) - np.pi)
    extreme = fit.extreme(start, sign)
    assert extreme is not None
    fine = np.linspace(start - 1.5, start + 1.5, 300001)
    best = fine[np.argmax(sign * curve(fine))]
    assert extreme.angle == pytest.approx(best, abs=2e-5)
    assert extreme.value == pytest.approx(curve(np.array([best]))[0], abs=1e-9)
    assert fit.phase == pytest.approx(-0.8, abs=1e-6)


@seeds(300)
def test_doubts_are_those_of_noise(runs: int) -> None:
    tops = [top(samples(25.0, noise=0.1, seed=seed)) for seed in range(runs)]
    known = 3 / np.sqrt(2 * runs)  # three standard errors of a standard deviation, relative
    assert np.std([t.value for t in tops]) / 0.1 == pytest.approx(np.mean([t.value_deviation for t in tops]), rel=known)
    assert np.std([t.angle for t in tops]) / 0.1 == pytest.approx(np.mean([t.angle_deviation for t in tops]), rel=known)


def test_noise_lifts_a_top_by_what_is_told() -> None:
    """Each noise comes with either sign: what is odd in it, all but the lift, cancels."""
    pairs = [[top(samples(10.0, noise=noise, seed=seed)) for noise in (0.5, -0.5)] for seed in range(200)]
    found = np.array([np.mean([t.value for t in pair]) for pair in pairs]) - top(samples(10.0)).value
    lift = np.mean([0.5**2 * t.lift for pair in pairs for t in pair])
    error = 3 * np.std(found) / np.sqrt(len(pairs))
    assert lift > 2 * error  # it can be seen at all
    assert np.mean(found) == pytest.approx(lift, abs=error)


def test_regressors_derivatives_are_limits_of_differences() -> None:
    angle, h = np.linspace(1.0, 9.0, 40), 1e-5
    for order in (1, 2):
        central = (regressors(angle + h, 5.0, 4.0, 3, order - 1) - regressors(angle - h, 5.0, 4.0, 3, order - 1)) / (
            2 * h
        )
        np.testing.assert_allclose(regressors(angle, 5.0, 4.0, 3, order), central, atol=1e-7)


def test_says_where_it_cannot() -> None:
    some = samples(25.0)
    assert fit_cycle(some, 1.0) is None
    fit = fit_cycle(some, 30.0)
    assert fit is not None
    assert fit.extreme(30.0 + float(np.remainder(-0.5 * np.pi + 0.8 - 30.0, 2 * np.pi)), 1) is None  # a bottom
