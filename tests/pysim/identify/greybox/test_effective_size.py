"""Inflation by colour, against the variance of a sum of autoregressive noise in closed form."""

import numpy as np
import pytest

from pysim.identify.greybox.effective_size import inflation


def autoregressive(memory: float, size: int, seed: int) -> np.ndarray:
    draws, noise, last = np.random.default_rng(seed).normal(size=size), np.empty(size), 0.0
    for i, draw in enumerate(draws):
        noise[i] = last = memory * last + draw
    return noise[:, None]


def test_the_mean_of_autoregressive_noise() -> None:
    """Bartlett: (1 + a)/(1 - a) times the variance of white noise."""
    noise = [autoregressive(0.6, 20000, seed) for seed in range(4)]
    assert inflation(noise, [np.ones_like(one) for one in noise]) == pytest.approx(1.6 / 0.4, rel=0.1)


def test_two_colours_at_once() -> None:
    """The product of correlations a^k b^k."""
    left = [autoregressive(0.8, 40000, 1)]
    assert inflation(left, [autoregressive(0.5, 40000, 2)]) == pytest.approx(1.4 / 0.6, rel=0.15)


def test_white_residuals_are_worth_their_number_and_a_change_weighs_its_channel() -> None:
    white, slow = autoregressive(0.0, 20000, 3), autoregressive(0.9, 20000, 4)
    assert inflation([white], [np.ones_like(white)]) < 1.2
    both = np.hstack([white, slow])
    change = np.hstack([np.ones_like(white), np.zeros_like(white)])
    assert inflation([both], [change]) < 1.2


def test_a_memory_of_thousands_of_samples_is_followed_to_its_end() -> None:
    """The definition, with correlations summed up directly; in parts of the log, as many as it takes."""
    rest, change = autoregressive(0.9995, 9000, 5)[:, 0], autoregressive(0.9, 9000, 6)[:, 0]
    of_rest, of_change = (np.correlate(row, row, "full")[row.size - 1 :] for row in (rest, change))
    end = int(np.argmax(of_rest <= 0))
    assert end > 1024
    expected = 1 + 2 * float(of_rest[1:end] @ of_change[1:end]) / of_rest[0] / of_change[0]
    assert inflation([rest[:, None]], [change[:, None]]) == pytest.approx(expected, rel=1e-10)
