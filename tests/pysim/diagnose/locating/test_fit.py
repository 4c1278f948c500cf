"""Tables fitted to first order, against closed forms, and where their knots stand."""

import numpy as np
import pytest

from pysim.diagnose.locating.fit import bends, knots, lines, solve
from pysim.diagnose.locating.laws import KNOTS


def test_knots_stand_closely_around_a_zero_that_is_crossed() -> None:
    k = knots(np.random.default_rng(1).uniform(-2, 2, 20_000))
    assert k.size == KNOTS
    assert np.all(np.diff(k) > 0)
    assert k[KNOTS // 2] == 0
    assert np.diff(k)[KNOTS // 2] < 0.05 * np.diff(k)[-1]
    assert (k[0], k[-1]) == pytest.approx((-2, 2), abs=0.03)


def test_knots_of_what_stays_on_one_side_follow_the_samples() -> None:
    z = 5 + np.abs(np.random.default_rng(1).standard_normal(20_000))
    k = knots(z)
    assert k[0] > 4.9
    assert np.diff(k)[0] < 0.5 * np.diff(k)[-1]


def test_knots_over_decades_are_closer_where_it_is_small() -> None:
    k = knots(np.random.default_rng(1).uniform(1.0, 50.0, 20_000))
    assert np.all(np.diff(np.diff(k)) > 0)
    assert (k[0], k[-1]) == pytest.approx((1.0, 50.0), rel=0.15)


def test_knots_of_a_constant_still_increase() -> None:
    assert np.all(np.diff(knots(np.full(100, 3.0))) > 0)


def test_a_straight_line_has_no_bends() -> None:
    k = knots(np.random.default_rng(1).uniform(-2, 2, 20_000))
    np.testing.assert_allclose(bends(k) @ (3 - 2 * k), 0, atol=1e-12)
    np.testing.assert_allclose(lines(k).T @ lines(k), np.eye(2), atol=1e-12)
    assert np.linalg.norm(bends(k) @ np.sign(k)) > 1


def hats(z: np.ndarray, k: np.ndarray) -> np.ndarray:
    return np.stack([np.interp(z, k, row) for row in np.eye(k.size)], axis=1)


@pytest.fixture
def samples() -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Noise of 1 and three times the sign of z; knots; what is measured less what a model without it gives."""
    rng = np.random.default_rng(2)
    z = rng.uniform(-2, 2, 4000)
    k = knots(z)
    return z, k, 3 * np.sign(z) + rng.standard_normal(z.size)


def test_values_and_their_doubt(samples) -> None:
    z, k, r = samples
    found = solve(r, -hats(z, k), k)
    far = np.abs(k) > 0.1
    error = (found.values - 3 * np.sign(k))[far] / np.sqrt(np.diag(found.covariance))[far]
    assert np.max(np.abs(error)) < 3.5
    assert found.left == pytest.approx(4000, rel=0.06)
    assert 2 < found.freedom < KNOTS


def test_where_nothing_is_missing_nothing_is_found() -> None:
    rng = np.random.default_rng(3)
    z, r = rng.uniform(-2, 2, 4000), rng.standard_normal(4000)
    k = knots(z)
    found = solve(r, -hats(z, k), k)
    assert np.max(np.abs(found.values)) < 0.3
    nothing = 0.5 * r.size * np.log(r @ r / r.size)
    assert found.loss > nothing - 2  # no evidence for a term


def test_a_term_has_evidence(samples) -> None:
    z, k, r = samples
    wrong = np.random.default_rng(4).permutation(z)
    right, other = solve(r, -hats(z, k), k), solve(r, -hats(wrong, k), k)
    assert right.loss < other.loss - 100
