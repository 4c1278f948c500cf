"""The local fit on curves whose extremes are known."""

import numpy as np
import pytest

from pysim.identify.chirp.cycle_fit import Samples, fit_cycle, regressors


def samples(per_turn: float, turns: float = 12.0, noise: float = 0.0, seed: int = 0) -> Samples:
    angle = 0.3 + 2 * np.pi * np.arange(int(turns * per_turn)) / per_turn
    values = curve(angle) + noise * np.random.default_rng(seed).standard_normal(angle.size)
    return Samples(angle, values, np.full(angle.size, per_turn), np.zeros(angle.size))


def curve(angle: np.ndarray) -> np.ndarray:
    return 3.0 + (2.0 + 0.01 * angle) * np.sin(angle - 0.8) + 0.3 * np.cos(2 * angle)


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


def test_doubts_are_those_of_noise() -> None:
    found = []
    for seed in range(300):
        fit = fit_cycle(samples(25.0, noise=0.1, seed=seed), 30.0)
        extreme = fit.extreme(31.0 + 2.79, 1)  # type: ignore[union-attr]
        found.append((extreme.value, extreme.angle, extreme.value_deviation, extreme.angle_deviation))  # type: ignore[union-attr]
    value, angle, value_deviation, angle_deviation = np.array(found).T
    assert np.std(value) / 0.1 == pytest.approx(np.mean(value_deviation), rel=0.15)
    assert np.std(angle) / 0.1 == pytest.approx(np.mean(angle_deviation), rel=0.15)


def test_noise_lifts_a_top_by_what_is_told() -> None:
    quiet = fit_cycle(samples(10.0), 30.0).extreme(31.0 + 2.79, 1)  # type: ignore[union-attr]
    noise, values, lifts = 0.5, [], []
    for seed in range(4000):
        extreme = fit_cycle(samples(10.0, noise=noise, seed=seed), 30.0).extreme(31.0 + 2.79, 1)  # type: ignore[union-attr]
        values.append(extreme.value)  # type: ignore[union-attr]
        lifts.append(noise**2 * extreme.lift)  # type: ignore[union-attr]
    error = 3 * np.std(values) / np.sqrt(4000)
    assert quiet is not None
    assert np.mean(lifts) > 2 * error  # it can be seen at all
    assert np.mean(values) - quiet.value == pytest.approx(np.mean(lifts), abs=error)


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
