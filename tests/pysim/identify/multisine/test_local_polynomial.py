"""The local polynomial method against its theory: exactness, order, noise and coverage."""

import numpy as np
import pytest
from scipy import stats
from scipy.signal import lfilter

from pysim.identify.multisine import LocalPolynomial, gain_radius, local_polynomial_approximation
from pysim.identify.multisine.local_polynomial import solve
from pysim.types import BadInput, BestLinearApproximation, Record
from tests.pysim.identify.multisine.systems import A, B
from tests.pysim.identify.seeds import at_least, at_most, seeds

STEP = 0.01


def run(n: int, *, noise: float, seed: int, colour: tuple[float, ...] = (1.0,)) -> Record:
    """A record from rest with a random input; the noise is white, or filtered."""
    rng = np.random.default_rng(seed)
    u = rng.standard_normal(n)
    v = lfilter(colour, 1.0, rng.standard_normal(n + len(colour)))[len(colour) :]
    return Record(STEP * np.arange(n), np.column_stack([u, lfilter(B, A, u) + noise * v]), ("u", "y"), ("V", "m"))


def gain(frequency: np.ndarray) -> np.ndarray:
    z = np.exp(-2j * np.pi * frequency * STEP)
    return np.polyval(B[::-1], z) / np.polyval(A[::-1], z)


@pytest.mark.parametrize("order", [0, 1, 2, 3])
def test_exact_where_gain_and_transient_are_polynomials(order: int) -> None:
    rng = np.random.default_rng(order)
    k = np.arange(80) / 40
    g, t = (np.polyval(rng.standard_normal(order + 1) + 1j * rng.standard_normal(order + 1), k) for _ in range(2))
    u = rng.standard_normal(80) + 1j * rng.standard_normal(80)
    fit = solve(u, (g * u + t)[:, None], np.arange(80), LocalPolynomial(order, order + 3))
    np.testing.assert_allclose(fit.coefficients[:, 0, 0], g, atol=1e-9)
    np.testing.assert_allclose(fit.coefficients[:, order + 1, 0], t, atol=1e-9)
    np.testing.assert_allclose(fit.residual, 0.0, atol=1e-18)
    wrong = solve(u, ((g + 0.1 * k ** (order + 1)) * u)[:, None], np.arange(80), LocalPolynomial(order, order + 3))
    assert np.max(wrong.residual.real) > 1e-12


@pytest.mark.parametrize("order", [0, 1, 2, 3])
def test_the_error_falls_with_the_records_length_as_the_theory_says(order: int) -> None:
    """O((n / N)^(R + 1)) for the interpolation, one power better in symmetric windows where R is even."""
    sizes = (1000, 2000, 4000, 8000)
    settings = LocalPolynomial(order, order + 3)

    def error(n: int) -> float:
        errors = []
        for seed in range(6):
            bla = local_polynomial_approximation(
                run(n, noise=0.0, seed=seed), ("u", "y"), band=(2.0, 30.0), settings=settings
            )
            errors.append(np.mean(np.abs(bla.gain - gain(bla.frequency)) ** 2))
        return float(np.sqrt(np.mean(errors)))

    slope = -np.polyfit(np.log(sizes), np.log([error(n) for n in sizes]), 1)[0]
    assert slope > order + 0.8
    assert slope < order + 3


def test_beats_the_hann_window_at_leakage() -> None:
    n = 2000
    record = run(n, noise=0.0, seed=3)
    bla = local_polynomial_approximation(record, ("u", "y"), band=(2.0, 30.0))
    window = np.hanning(n + 1)[:n]
    u, y = (np.fft.rfft(window * record[name])[1:] for name in ("u", "y"))
    smooth = np.ones(13)
    spectral = np.convolve(y * u.conj(), smooth, "same") / np.convolve(np.abs(u) ** 2, smooth, "same")
    at = np.round(bla.frequency * n * STEP).astype(int) - 1
    ours, theirs = (np.mean(np.abs(g - gain(bla.frequency)) ** 2) for g in (bla.gain, spectral[at]))
    assert ours < 1e-4 * theirs


def results(
    seeds: range, colour: tuple[float, ...] = (1.0,), band: tuple[float, float] = (1.0, 40.0)
) -> list[BestLinearApproximation]:
    records = [run(1500, noise=0.05, seed=s, colour=colour) for s in seeds]
    return [local_polynomial_approximation(record, ("u", "y"), band=band) for record in records]


@seeds(300)
def test_noise_and_coverage_at_a_single_line_over_many_records(runs: int) -> None:
    """q complex degrees of freedom: the level over the truth is chi-square distributed, the error circle F."""
    found, line = results(range(runs), band=(13.0, 15.0)), 10
    q = LocalPolynomial().degrees
    true = 4 * 0.05**2 / 1500
    level = np.array([f.total.variance[line] * f.amplitude[line] ** 2 for f in found if f.total is not None])
    assert stats.kstest(level / true * 2 * q, stats.chi2(2 * q).cdf).pvalue > 0.001
    inside = [abs(f.gain[line] - gain(f.frequency)[line]) < gain_radius(f)[line] for f in found]
    assert at_least(0.95, runs) <= np.sum(inside) <= at_most(0.95, runs)


def test_pooled_coverage_and_no_bias() -> None:
    found = results(range(20))
    errors = np.array([f.gain - gain(f.frequency) for f in found])
    inside = np.abs(errors) < [gain_radius(f) for f in found]
    assert np.mean(inside) == pytest.approx(0.95, abs=0.01)  # 11 700 errors, thirteen of which share data
    size = np.sqrt(np.mean(np.abs(errors) ** 2) / errors.size * 13)
    assert abs(np.mean(errors)) < 4 * size


def test_coloured_noise_is_followed() -> None:
    """Noise through 1 + z^-1 has |1 + exp(-jw)|^2 = 4 cos^2(w / 2) of the white one's power."""
    found = results(range(40), (1.0, 1.0))
    power = np.mean([f.total.variance * f.amplitude**2 for f in found if f.total is not None], axis=0)
    expected = 4 * 0.05**2 / 1500 * 4 * np.cos(np.pi * found[0].frequency * STEP) ** 2
    wide = expected > 0.02 * expected.max()
    ratio = (power / expected)[wide]
    assert np.mean(ratio) == pytest.approx(1.0, rel=0.03)
    assert np.std(ratio) < 3 * np.sqrt(1 / (7 * 40))


def test_a_reference_in_a_loop() -> None:
    rng = np.random.default_rng(4)
    n, loop = 6000, 3.0
    r, v = rng.standard_normal((2, n))
    # y = G u + v, u = r - loop y(t - 1)
    u, y = np.zeros(n), np.zeros(n)
    for i in range(n):
        x1, x2 = (y[i - 1] - v[i - 1], y[i - 2] - v[i - 2]) if i > 1 else (0.0, 0.0)
        u[i] = r[i] - 0.3 * loop * (y[i - 1] if i else 0.0)
        y[i] = B[0] * u[i] + B[1] * (u[i - 1] if i else 0.0) - A[1] * x1 - A[2] * x2 + v[i]
    record = Record(STEP * np.arange(n), np.column_stack([u, y, r]), ("u", "y", "r"), ("1", "1", "1"))
    wide = LocalPolynomial(2, 40)
    right = local_polynomial_approximation(record, ("u", "y", "r"), band=(2.0, 40.0), settings=wide)
    wrong = local_polynomial_approximation(record, ("u", "y"), band=(2.0, 40.0), settings=wide)
    chi = [np.mean(np.abs(f.gain - gain(f.frequency)) ** 2 / f.variance) for f in (right, wrong)]
    assert chi[0] == pytest.approx(1.0, abs=0.4)
    assert chi[1] > 5.0


def test_the_band_is_where_the_input_is() -> None:
    n = 3000
    rng = np.random.default_rng(5)
    spectrum = np.zeros(n // 2 + 1, dtype=complex)
    spectrum[60:450] = np.exp(2j * np.pi * rng.random(390))  # 2 to 15 Hz
    u = np.fft.irfft(spectrum * n / 20, n) + 1e-6 * rng.standard_normal(n)
    record = Record(STEP * np.arange(n), np.column_stack([u, lfilter(B, A, u)]), ("u", "y"), ("V", "m"))
    bla = local_polynomial_approximation(record, ("u", "y"))
    assert bla.frequency[0] == pytest.approx(2.0, abs=0.3)
    assert bla.frequency[-1] == pytest.approx(15.0, abs=0.3)
    assert bla.test.period == pytest.approx(n * STEP)
    assert bla.noise is None


def swept() -> Record:
    """A chirp from 5 to 15 Hz of 20 s through the system; what is left of it outside the sweep is smooth leakage."""
    time = STEP * np.arange(2000)
    u = np.sin(2 * np.pi * (5 * time + 0.25 * time**2))
    y = lfilter(B, A, u) + 0.01 * np.random.default_rng(6).standard_normal(time.size)
    return Record(time, np.column_stack([u, y]), ("u", "y"), ("1", "1"))


def test_lines_at_which_a_chirp_is_as_smooth_as_a_transient_are_left_out(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    bla = local_polynomial_approximation(swept(), ("u", "y"))
    assert 4.0 < bla.frequency[0] < 6.0
    assert 14.0 < bla.frequency[-1] < 16.0
    error = np.abs(bla.gain / gain(bla.frequency) - 1)
    assert np.median(error) < 0.1
    assert np.max(error) < 1.5  # at the very ends
    with pytest.raises(BadInput, match="as smooth there as a transient"):
        local_polynomial_approximation(swept(), ("u", "y"), band=(25.0, 35.0))
    monkeypatch.setattr("pysim.identify.multisine.local_polynomial._ROUGH", 0.0)
    whole = local_polynomial_approximation(swept(), ("u", "y"))
    assert np.max(np.abs(whole.gain / gain(whole.frequency) - 1)) > 100


def test_refusals() -> None:
    record, names = run(400, noise=0.1, seed=0), (("u", "y"), ("1", "1"))
    with pytest.raises(BadInput, match=r"no lines from 60 to 70 Hz, the record has them from 0\.25 to 49\.75"):
        local_polynomial_approximation(record, ("u", "y"), band=(60.0, 70.0))
    with pytest.raises(BadInput, match="12 lines do not fill a window of 13"):
        local_polynomial_approximation(Record(record.time[:26], record.values[:26], *names), ("u", "y"))
    with pytest.raises(BadInput, match="each once"):
        local_polynomial_approximation(record, ("u", "u"))
    with pytest.raises(BadInput, match="at least 3 lines"):
        LocalPolynomial(2, 2)
    with pytest.raises(BadInput, match="name the columns"):
        local_polynomial_approximation(record, ("u",))
    still = Record(record.time, np.column_stack([np.ones(400), record["y"]]), ("u", "y"), ("1", "1"))
    with pytest.raises(BadInput, match="stands still"):
        local_polynomial_approximation(still, ("u", "y"))
    jittered = Record(record.time + 0.004 * (np.arange(400) % 2), record.values, ("u", "y"), ("1", "1"))
    with pytest.raises(BadInput, match="equal intervals"):
        local_polynomial_approximation(jittered, ("u", "y"))


@pytest.mark.parametrize("level", [0.0, 3.7])
def test_an_output_that_stands_still_is_refused(level: float) -> None:
    record = run(600, noise=0.0, seed=0)
    still = Record(record.time, np.column_stack([record["u"], np.full(600, level)]), ("u", "y"), ("V", "m"))
    with pytest.raises(BadInput, match=f"multisine: y stands still at {level:g}; there is no response"):
        local_polynomial_approximation(still, ("u", "y"))
