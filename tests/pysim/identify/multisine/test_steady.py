"""Spectra of the steady state: their noise is the true one, and transients leave no trace in them."""

import numpy as np
import pytest

from pysim.identify.multisine import DropPeriods, LocalTransient
from pysim.types import BadInput
from tests.pysim.identify.multisine.systems import AMPLITUDE, FULL, from_rest, gain, line_noise, measure

SIGMA = 0.05


@pytest.mark.parametrize("transient", [DropPeriods(0), DropPeriods(1), LocalTransient(), LocalTransient(3, 16)])
def test_noise_is_unbiased_with_the_degrees_it_claims(transient: DropPeriods | LocalTransient) -> None:
    periods = 4
    spectra = transient.spectra(measure(FULL, realisations=3, periods=periods, noise=SIGMA, seed=0))
    assert spectra.noise is not None
    kept = periods - transient.count if isinstance(transient, DropPeriods) else periods
    inside = slice(20, 200)
    estimate = spectra.noise[inside, 1, 1].real / line_noise(SIGMA, kept)
    if isinstance(transient, LocalTransient):
        # the polynomial takes some of the noise with it into the lines: 1 + k0 (K^H K)^-1 k0^H
        x = np.array([r for r in range(-40, 41) if r % periods])
        x = x[np.argsort(np.abs(x), kind="stable")][: transient.lines] / 8
        k = x[:, None] ** np.arange(transient.order + 1)
        estimate = estimate / (1 + np.linalg.inv(k.T @ k)[0, 0])
    degrees = spectra.degrees[20]
    independent = 180 / spectra.span
    assert np.mean(estimate) == pytest.approx(1.0, abs=4 / np.sqrt(degrees * independent))
    assert np.var(estimate) == pytest.approx(1 / degrees, rel=0.6)
    np.testing.assert_allclose(spectra.noise[:, 0, 0].real, 0.0, atol=1e-20)  # the input is known


def test_the_cleaned_lines_scatter_as_claimed() -> None:
    runs, claimed, errors = 40, [], []
    for seed in range(runs):
        spectra = LocalTransient().spectra(measure(FULL, realisations=1, periods=3, noise=SIGMA, seed=seed))
        assert spectra.noise is not None
        claimed.append(spectra.noise[FULL - 1, 1, 1].real)
        errors.append(np.abs(spectra.values[0, FULL - 1, 1] - gain(FULL) * spectra.values[0, FULL - 1, 0]) ** 2)
    # 2400 squares of circular errors know their mean to 2 percent
    assert np.mean(errors) == pytest.approx(float(np.mean(claimed)), rel=0.08)


def test_a_transient_is_taken_off() -> None:
    periods = from_rest(FULL, periods=3, noise=0.0, seed=1)
    true = gain(FULL)

    def error(transient: DropPeriods | LocalTransient) -> float:
        spectra = transient.spectra(periods)
        found = spectra.values[0, FULL - 1, 1] / spectra.values[0, FULL - 1, 0]
        return float(np.max(np.abs(found - true)) / np.max(np.abs(true)))

    left = error(DropPeriods(0))
    assert left > 1e-3
    assert error(LocalTransient(2, 8)) < left / 100
    assert error(LocalTransient(4, 10)) < left / 5000
    assert error(DropPeriods(1)) < 1e-12  # over within half a period


def test_the_transient_polynomial_gets_better_with_longer_periods() -> None:
    """The remainder goes with (1 / periods' length)^(order + 1) and one power more where the window is symmetric."""
    from tests.pysim.identify.multisine import systems

    errors = []
    for n in (256, 512, 1024):
        rng = np.random.default_rng(5)
        lines = np.arange(n // 16, n // 8)  # the same band
        u = np.tile(systems.multisine(lines, rng, n), 3)
        y = systems.lfilter(systems.B, systems.A, u)
        p = systems.Periods(np.stack([u, y], -1).reshape(1, 3, n, 2), ("u", "y"), ("1", "1"), n / 256)
        spectra = LocalTransient(2, 8).spectra(p)
        found = spectra.values[0, lines - 1, 1] / spectra.values[0, lines - 1, 0]
        errors.append(np.sqrt(np.mean(np.abs(found - gain(lines, n)) ** 2)))
    slopes = np.log2(np.array(errors[:-1]) / errors[1:])
    assert np.all(slopes > 3.0)


def test_amplitudes_are_those_of_the_multisine() -> None:
    spectra = DropPeriods(0).spectra(measure(FULL, realisations=2, periods=2, seed=2))
    np.testing.assert_allclose(np.abs(spectra.values[:, FULL - 1, 0]), AMPLITUDE, rtol=1e-12)
    np.testing.assert_allclose(spectra.frequency[FULL - 1], FULL / 2.0)
    np.testing.assert_allclose(np.abs(spectra.values[:, FULL[-1] :, 0]), 0.0, atol=1e-12)


def test_one_period_has_no_noise_estimate_and_no_transient() -> None:
    periods = measure(FULL, realisations=2, periods=1, seed=3)
    assert DropPeriods(0).spectra(periods).noise is None
    with pytest.raises(BadInput, match="record two or more"):
        LocalTransient().spectra(periods)
    with pytest.raises(BadInput, match="at least 4 lines"):
        LocalTransient(2, 3)
