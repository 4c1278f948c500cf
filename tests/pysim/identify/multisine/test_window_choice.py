"""The ranking finds the window whose gain is closest to the true one, or nearly so."""

import numpy as np
import pytest
from scipy.signal import lfilter

from pysim.identify.multisine import LocalPolynomial, local_polynomial_approximation, rank_local_polynomials
from pysim.identify.multisine.window_choice import CANDIDATES
from pysim.types import BadInput, Record
from tests.pysim.identify.multisine.test_local_polynomial import gain, run

BAND = (2.0, 30.0)


def true_error(record: Record, settings: LocalPolynomial) -> float:
    bla = local_polynomial_approximation(record, ("u", "y"), band=BAND, settings=settings)
    return float(np.mean(np.abs(bla.gain - gain(bla.frequency)) ** 2))


@pytest.mark.parametrize(("n", "noise"), [(600, 0.001), (2000, 0.02), (6000, 0.3)])
def test_the_best_is_close_to_the_best_there_is(n: int, noise: float) -> None:
    record = run(n, noise=noise, seed=1)
    ranking = rank_local_polynomials(record, ("u", "y"), band=BAND)
    assert len(ranking) == len(CANDIDATES)
    assert ranking[0].relative_error == 1.0
    errors = {settings: true_error(record, settings) for settings in CANDIDATES}
    assert errors[ranking[0].settings] < 2.0 * min(errors.values())
    assert errors[ranking[-1].settings] > 3.0 * min(errors.values())


def test_noise_asks_for_wide_windows_and_a_short_record_for_narrow_ones() -> None:
    noisy = rank_local_polynomials(run(6000, noise=0.3, seed=2), ("u", "y"), band=BAND)[0].settings
    clean = rank_local_polynomials(run(600, noise=0.001, seed=2), ("u", "y"), band=BAND)[0].settings
    assert noisy.half_width >= 20
    assert clean.half_width < noisy.half_width


def test_the_left_out_line_is_predicted_as_by_leaving_it_out() -> None:
    """Against the plain way: solve each window again without its middle line."""
    from pysim.identify.multisine.local_polynomial import prepare, solve
    from pysim.identify.multisine.window_choice import _left_out

    settings = LocalPolynomial(2, 5)
    spectra = prepare(run(400, noise=0.1, seed=3), ("u", "y"), (10.0, 12.0), settings)
    u, y = spectra.drive, spectra.answers[:, 0]
    fit = solve(u, spectra.answers, spectra.chosen, settings)
    for i, k in enumerate(spectra.chosen):
        r = np.delete(np.arange(-5, 6), 5)
        x = (r / 5.0)[:, None] ** np.arange(3)
        rows = np.hstack([x * u[k + r][:, None], x])
        theta = np.linalg.lstsq(rows, y[k + r], rcond=None)[0]
        expected = y[k] - (theta[0] * u[k] + theta[3])
        assert _left_out(fit, u[spectra.chosen], y[spectra.chosen], settings)[i] == pytest.approx(expected)


def test_candidates_that_do_not_fit_are_left_out() -> None:
    u = np.random.default_rng(0).standard_normal(40)
    record = Record(0.01 * np.arange(40), np.column_stack([u, lfilter([1.0], [1.0], u)]), ("u", "y"), ("1", "1"))
    ranking = rank_local_polynomials(record, ("u", "y"), band=(5.0, 40.0))
    assert {c.settings.half_width for c in ranking} == {4, 6, 9}  # 19 lines in all
    with pytest.raises(BadInput, match="record longer"):
        rank_local_polynomials(record, ("u", "y"), candidates=[LocalPolynomial(2, 60)], band=(5.0, 40.0))
    with pytest.raises(BadInput, match="no candidate"):
        rank_local_polynomials(record, ("u", "y"), candidates=[])
