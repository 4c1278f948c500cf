"""The fit against Table 6.2, with and without samples that see the steepness."""

import numpy as np
import pytest

from pysim.identify.friction import (
    FRICTION_BOUNDS,
    FRICTION_NAMES,
    FrictionSamples,
    filtered_samples,
    fit_friction,
    friction_torque,
    pulse_samples,
)
from pysim.types import BadInput
from tests.pysim.identify.friction.shafts import INERTIA, TRUTH, measured, simulated


def samples(speed: np.ndarray, noise: float, seed: int = 0) -> FrictionSamples:
    """Of Table 6.2 at those speeds, with independent noise in N.m."""
    rng, zero = np.random.default_rng(seed), np.zeros(speed.size)
    torque = friction_torque(TRUTH, speed) + rng.normal(0, noise, speed.size)
    return FrictionSamples(np.arange(speed.size) * 0.01, speed, zero, torque, np.full(speed.size, noise), zero)


def sees_all(seed: int) -> FrictionSamples:
    speed = np.random.default_rng(100 + seed).permutation(np.geomspace(0.01, 60, 400))
    return samples(speed * np.where(np.arange(400) % 2, 1, -1), 0.5, seed)


def test_exact_samples_give_exact_parameters() -> None:
    speed = np.concatenate([-np.geomspace(0.01, 60, 60), np.geomspace(0.01, 60, 60)])
    fit = fit_friction([samples(speed, 1e-9)])
    np.testing.assert_allclose(fit.vector, TRUTH, rtol=1e-6)
    assert fit.bounded == ()
    assert fit.at_bound == ()


def test_what_a_bound_stops_is_named() -> None:
    """With one parameter held at most at half of its true value the fit wants more of it than it may have."""
    speed = np.concatenate([-np.geomspace(0.01, 60, 60), np.geomspace(0.01, 60, 60)])
    place = FRICTION_NAMES.index("tau_c")
    bounds = {**FRICTION_BOUNDS, "tau_c": (0.0, 0.5 * TRUTH[place])}
    fit = fit_friction([samples(speed, 0.5)], bounds=bounds)
    assert "tau_c" in fit.at_bound
    assert fit.vector[place] == pytest.approx(bounds["tau_c"][1])


def test_intervals_cover_where_everything_is_seen() -> None:
    """30 draws of four 95 percent intervals: fewer than 23 of one parameter's 30 has a chance of 1e-4."""
    hits = np.zeros(4, int)
    for seed in range(30):
        fit = fit_friction([sees_all(seed)])
        assert fit.bounded == ()
        hits += [
            fit.intervals[n][0] <= true <= fit.intervals[n][1] for n, true in zip(FRICTION_NAMES, TRUTH, strict=True)
        ]
    assert hits.min() >= 23


def test_table_6_2_from_ten_pulses_with_the_steepness_bounded_not_claimed() -> None:
    fit = fit_friction([pulse_samples(measured(simulated(), 1), INERTIA)])
    for i, name in enumerate(FRICTION_NAMES[1:], start=1):
        low, high = fit.intervals[name]
        assert low - 0.5 * (high - low) < TRUTH[i] < high + 0.5 * (high - low), name  # one draw: 4 sigma
        assert high - low < 0.05 * TRUTH[i], name
    assert fit.bounded == ("r",)
    assert fit.intervals["r"][1] == np.inf
    assert 0.1 < fit.intervals["r"][0] < TRUTH[0]
    assert np.tanh(fit.parameters["r"] * fit.blind_below) > 0.999  # the value given does not bend what was seen
    assert 1 < fit.blind_below < 5


def test_what_the_held_speed_makes_of_the_thesis_way() -> None:
    """Filter, differentiate, Eq. 6.1: the steepness is the filter's, with two ends and far from the truth; stiction is
    newton metres too low."""
    test = measured(simulated(), 1)
    slow, fast = (fit_friction([filtered_samples(test, INERTIA, cutoff_hz=f)], weighted=False) for f in (1.0, 20.0))
    assert slow.intervals["r"][1] < 1.0
    assert fast.intervals["r"][0] > 1.0
    assert fast.intervals["tau_s"][1] < TRUTH[3] - 2
    assert not fast.weighted
    assert fast.effective < 0.5 * fast.residuals.size  # the filter's samples follow each other


def test_unweighted_fit_is_eq_6_1() -> None:
    """No sum of squared errors is smaller nearby."""
    data = sees_all(7)
    fit = fit_friction([data], weighted=False)
    least = np.sum((friction_torque(fit.vector, data.speed) - data.torque) ** 2)
    assert least == pytest.approx(np.sum(fit.residuals**2))
    for i in range(4):
        for factor in (0.99, 1.01):
            other = fit.vector * np.where(np.arange(4) == i, factor, 1.0)
            assert np.sum((friction_torque(other, data.speed) - data.torque) ** 2) > least


@pytest.mark.parametrize(
    ("speed", "bounds", "message"),
    [
        (np.ones(5), FRICTION_BOUNDS, "fewer than ten"),
        (np.linspace(20, 21, 50), FRICTION_BOUNDS, "all speeds are near 20.5 rad/s"),
        (np.geomspace(1, 60, 50), {**FRICTION_BOUNDS, "tau_c": (5.0, 5.0)}, "tau_c needs bounds"),
    ],
)
def test_refuses(speed: np.ndarray, bounds: dict[str, tuple[float, float]], message: str) -> None:
    with pytest.raises(BadInput, match=message):
        fit_friction([samples(speed, 0.5)], bounds=bounds)
