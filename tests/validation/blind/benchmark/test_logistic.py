"""Logistic regression: known numbers are found again with honest doubt, and separated data stay finite."""

import numpy as np
import pytest

from validation.blind.benchmark.logistic import rise


def test_drawn_from_a_known_curve() -> None:
    rng = np.random.default_rng(3)
    x = rng.uniform(-2, 6, 4000)
    hit = rng.uniform(size=x.size) < 1 / (1 + np.exp(-(-3.0 + 2.0 * x)))
    found = rise(x, hit)
    off = (np.array([found.level, found.slope]) - [-3.0, 2.0]) / np.sqrt(np.diag(found.covariance))
    assert np.abs(off).max() < 3
    assert found.where(0.5) == pytest.approx(1.5, abs=0.1)
    assert found.share(np.array([found.where(0.95)]))[0] == pytest.approx(0.95)
    low, high = found.band(np.array([1.5]))
    assert low[0] < 0.5 < high[0]
    assert high[0] - low[0] < 0.1


def test_by_hand_for_two_groups() -> None:
    """Two values of x: the curve goes through both shares."""
    x, hit = np.repeat([0.0, 1.0], [400, 400]), np.tile([True, False, False, False], 200)
    hit[400:] = ~hit[400:]
    assert rise(x, hit).share(np.array([0.0, 1.0])) == pytest.approx([0.25, 0.75], abs=1e-3)


def test_separated_data_stay_finite() -> None:
    found = rise(np.array([0.0, 1.0, 2.0, 3.0]), np.array([False, False, True, True]))
    assert 1.2 < found.where(0.5) < 1.8
    assert np.isfinite(found.band(np.array([0.0, 3.0]))).all()
    level = rise(np.array([0.0, 1.0]), np.array([True, True]))
    assert level.share(np.array([0.5]))[0] > 0.8
