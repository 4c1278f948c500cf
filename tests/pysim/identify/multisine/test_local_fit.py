"""Batched least squares against numpy's own, one by one."""

import numpy as np
import pytest

from pysim.identify.multisine.local_fit import apart, local_fit, powers, windows
from pysim.types import BadInput


def test_agrees_with_single_problems() -> None:
    rng = np.random.default_rng(0)
    k = rng.standard_normal((5, 9, 4)) + 1j * rng.standard_normal((5, 9, 4))
    k[..., 1] *= 1e6  # badly scaled columns cost nothing
    y = rng.standard_normal((5, 9, 2)) + 1j * rng.standard_normal((5, 9, 2))
    fit = local_fit(k, y)
    assert fit.degrees == 5
    for i in range(5):
        expected = np.linalg.lstsq(k[i], y[i], rcond=None)[0]
        np.testing.assert_allclose(fit.coefficients[i], expected, rtol=1e-9)
        left = y[i] - k[i] @ expected
        np.testing.assert_allclose(fit.residual[i], left.T @ left.conj() / 5, atol=1e-12)
        np.testing.assert_allclose(fit.gram[i], np.linalg.inv(k[i].conj().T @ k[i]), rtol=1e-6, atol=1e-20)


def test_the_claimed_covariance_is_that_of_many_draws() -> None:
    rng = np.random.default_rng(1)
    k = np.repeat(rng.standard_normal((1, 8, 3)) + 1j * rng.standard_normal((1, 8, 3)), 4000, axis=0)
    noise = (rng.standard_normal((4000, 8, 1)) + 1j * rng.standard_normal((4000, 8, 1))) / np.sqrt(2)
    fit = local_fit(k, noise)
    seen = np.mean(np.abs(fit.coefficients[:, 0, 0]) ** 2)
    assert seen == pytest.approx(fit.gram[0, 0, 0].real, rel=0.07)  # 4000 draws: 1.6 percent each way
    assert np.mean(fit.residual.real) == pytest.approx(1.0, rel=0.04)


def test_windows_are_centred_inside_and_shifted_at_the_ends() -> None:
    at = windows(np.array([0, 5, 9]), np.arange(10), 5)
    np.testing.assert_array_equal(at, [[0, 1, 2, 3, 4], [3, 4, 5, 6, 7], [5, 6, 7, 8, 9]])
    between = np.array([1, 2, 4, 5, 7, 8, 10, 11])
    np.testing.assert_array_equal(between[windows(np.array([6]), between, 4)], [[4, 5, 7, 8]])
    np.testing.assert_array_equal(
        powers(np.array([[-2.0, 0.0, 1.0]]), 2)[0].real, [[1, -1, 1], [1, 0, 0], [1, 0.5, 0.25]]
    )


@pytest.mark.parametrize(
    ("k", "words"),
    [
        (np.ones((1, 3, 3)), "widen the window"),
        (np.ones((1, 5, 2)), "cannot be separated"),
        (np.zeros((1, 5, 2)), "no excitation"),
    ],
)
def test_refusals(k: np.ndarray, words: str) -> None:
    with pytest.raises(BadInput, match=words):
        local_fit(k.astype(complex), np.ones((1, k.shape[1], 1), dtype=complex))
    with pytest.raises(BadInput, match="does not fit"):
        windows(np.array([1]), np.arange(3), 4)


def test_windows_apart_share_no_line_and_are_centred() -> None:
    centres, lines = np.arange(20), np.arange(20)
    assert apart(windows(centres, lines, 5), centres) == (2, 7, 12, 17)
    assert apart(windows(centres, lines, 9), centres) == (4, 13)
    some = np.array([3, 4, 5, 6, 14, 15, 19])  # from 1, 2, 3, 4, 12, 13 and 15 on
    assert apart(windows(some, lines, 5), some) == (0, 4)
