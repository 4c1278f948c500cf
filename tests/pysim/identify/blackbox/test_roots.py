"""Poles and zeros of a fit: order, doubt, and pairs that cancel."""

import numpy as np
import pytest

from pysim.identify.blackbox import Structure, fit_transfer_function
from pysim.types import NoteCode
from tests.pysim.identify.blackbox.systems import exact, from_roots, noisy, pairs

F = np.geomspace(0.2, 20, 30)


def test_sorted_by_magnitude_with_both_of_a_pair() -> None:
    fit = fit_transfer_function(exact(from_roots([-9.0], [-70.0, *pairs(-5 + 30j)], 1e3), F), Structure(3, 1))
    np.testing.assert_allclose([p.value for p in fit.poles], [-5 - 30j, -5 + 30j, -70], rtol=1e-6)
    np.testing.assert_allclose([z.value for z in fit.zeros], [-9], rtol=1e-6)
    assert fit.cancelling == ()


def test_too_high_an_order_cancels_and_says_so() -> None:
    function = from_roots([], pairs(-5 + 30j), 900.0)
    fits = [fit_transfer_function(noisy(function, F, 0.01, seed), Structure(3, 1)) for seed in range(6)]
    assert sum(bool(fit.cancelling) for fit in fits) >= 5
    for fit in fits:
        assert (NoteCode.CANCELLING in [note.code for note in fit.notes]) == bool(fit.cancelling)
    right = fit_transfer_function(noisy(function, F, 0.01, seed=1), Structure(2))
    assert right.cancelling == ()


def test_without_noise_what_is_too_much_is_not_determined() -> None:
    fit = fit_transfer_function(exact(from_roots([], pairs(-5 + 30j), 900.0), F), Structure(3, 1))
    assert set(fit.undetermined) == {"b0", "a2", "a1", "a0"}
    lost = [pole for pole in fit.poles if not np.isfinite(pole.covariance).all()]
    assert len(lost) == 1
    lead, *others = fit.estimates()  # of any such pair of pole and zero
    assert lead.value == pytest.approx(900.0)
    assert lead.std < 1e-6
    assert all(np.isinf(e.std) for e in others)
