"""The filter against the inverse Cholesky factor of the noise's covariance, written out."""

import numpy as np
import pytest

from pysim.diagnose.adapter import Residual
from pysim.diagnose.noise import Noise
from pysim.diagnose.whiten import whitened, whitening
from pysim.identify.greybox.harmonics import regressors
from tests.pysim.diagnose.logs import RATE, sines, wave

NOISE = Noise(0.4, 0.7, 0.03, 0.5)
MAP = {("data", "y"): NOISE}


def covariance(time: np.ndarray) -> np.ndarray:
    lags = np.abs(time[:, None] - time)
    return NOISE.white**2 * np.eye(time.size) + NOISE.coloured**2 * np.exp(-lags / NOISE.memory)


def test_a_log_is_whitened_exactly_from_its_first_sample() -> None:
    target = wave(np.zeros(60), 0.5)
    rows = np.random.default_rng(1).standard_normal((60, 3))
    triangle = np.linalg.cholesky(covariance(target.measured.time) / NOISE.told**2)
    assert whitening(target, MAP).of(rows) == pytest.approx(np.linalg.solve(triangle, rows), rel=1e-10)


def test_another_rate_is_the_same_noise() -> None:
    slow = wave(np.zeros(20), 0.5, interval=0.011)
    rows = np.random.default_rng(2).standard_normal((20, 1))
    triangle = np.linalg.cholesky(covariance(slow.measured.time) / NOISE.told**2)
    assert whitening(slow, MAP).of(rows) == pytest.approx(np.linalg.solve(triangle, rows), rel=1e-10)


def test_a_start_that_is_left_out_leaves_a_log_that_begins_later() -> None:
    target = wave(np.zeros(60), 0.5)
    rows = np.random.default_rng(3).standard_normal((60, 2))
    made = whitening(target, MAP, 10 / RATE)
    later = target.measured.time[10:]
    triangle = np.linalg.cholesky(covariance(later) / NOISE.told**2)
    assert made.size == 50
    assert made.of(rows) == pytest.approx(np.linalg.solve(triangle, rows[10:]), rel=1e-10)


def test_harmonics_are_whitened_with_the_noise_of_their_log() -> None:
    target = sines(np.zeros, 0.5)
    made = whitening(target, MAP)
    rows = np.random.default_rng(4).standard_normal((made.size, 2))
    wanted, place = [], 0
    for log in target.logs:
        q, _ = np.linalg.qr(regressors(log.phase, log.count))
        triangle = np.linalg.cholesky(q.T @ covariance(log.measured.time) @ q / NOISE.told**2)
        wanted.append(np.linalg.solve(triangle, rows[place : place + q.shape[1]]))
        place += q.shape[1]
    assert place == made.size
    assert made.of(rows) == pytest.approx(np.concatenate(wanted), rel=1e-8)


def test_white_noise_as_told_changes_nothing_and_slopes_go_along() -> None:
    target = sines(np.zeros, 0.5)
    plain, coloured = whitening(target, {}), whitening(target, MAP)
    residual = Residual(np.arange(plain.size, dtype=float), np.ones((plain.size, 2)))
    assert whitened(plain, residual).values == pytest.approx(residual.values)
    found = whitened(coloured, residual)
    assert found.slopes[:, 1] == pytest.approx(coloured.of(residual.slopes)[:, 1])
