"""Best linear approximations of systems whose gain, noise and distortion are known exactly."""

from collections.abc import Callable

import numpy as np
import pytest
from scipy import stats

from pysim.identify.multisine import (
    DropPeriods,
    Periods,
    best_linear_approximation,
    distortion_p_value,
    fast_approximation,
    gain_interval,
    gain_radius,
    robust_approximation,
    smooth_approximation,
)
from pysim.types import BadInput, BestLinearApproximation
from tests.pysim.identify.multisine.systems import (
    AMPLITUDE,
    FULL,
    ODD,
    A,
    B,
    cubic_gain,
    from_rest,
    gain,
    line_noise,
    measure,
    product_power,
    through,
    with_free_lines,
)
from tests.pysim.identify.seeds import at_most, seeds

SIGMA = 0.03
FREE = with_free_lines(ODD, seed=11)
STEADY = DropPeriods(0)


def robust(seed: int) -> BestLinearApproximation:
    return robust_approximation(measure(FREE, realisations=5, periods=3, noise=SIGMA, seed=seed), transient=STEADY)


def fast(seed: int) -> BestLinearApproximation:
    return fast_approximation(measure(FREE, realisations=1, periods=4, noise=SIGMA, seed=seed))


def smooth(seed: int) -> BestLinearApproximation:
    # the gain must be smooth against the window: few lines, closely spaced
    return smooth_approximation(measure(FULL, realisations=1, periods=4, noise=SIGMA, seed=seed), order=4, width=11)


METHODS = pytest.mark.parametrize("method", [robust, fast, smooth])


@seeds(60)
@METHODS
def test_on_a_linear_system_the_gain_is_unbiased_and_its_intervals_cover(
    method: Callable[[int], BestLinearApproximation], runs: int
) -> None:
    results = [method(seed) for seed in range(runs)]
    true = gain(np.round(results[0].frequency * 2).astype(int))
    errors = np.array([r.gain - true for r in results])
    size = np.sqrt(np.mean(np.abs(errors) ** 2, axis=0))
    assert np.max(np.abs(errors.mean(axis=0)) / size) < 4.2 / np.sqrt(runs)  # the largest of some 40 complex means
    inside = [np.mean(np.abs(e) < gain_radius(r)) for e, r in zip(errors, results, strict=True)]
    known = 0.015 * np.sqrt(60 / runs)  # of some 2000 errors in 60 runs, those of one run partly together
    assert np.mean(inside) == pytest.approx(0.95, abs=known)
    magnitude = [np.abs(np.abs(r.gain) - np.abs(true)) < gain_interval(r)[0] for r in results]
    phase = [np.abs(np.angle(r.gain / true)) < gain_interval(r)[1] for r in results]
    assert np.mean(magnitude) == pytest.approx(0.95, abs=known)
    assert np.mean(phase) == pytest.approx(0.95, abs=known)


@seeds(100)
@METHODS
def test_no_distortion_is_seen_on_a_linear_system(method: Callable[[int], BestLinearApproximation], runs: int) -> None:
    """The alarm at 5 percent goes off in at most 5 percent of the runs."""
    results = [method(seed) for seed in range(300, 300 + runs)]
    for name in ("on_lines", "even", "odd"):
        levels = [getattr(r, name) for r in results]
        if levels[0] is None:
            assert method is smooth
            continue
        if method is fast and name == "on_lines":
            continue  # that of the odd lines, pooled
        assert sum(distortion_p_value(level) < 0.05 for level in levels) <= at_most(0.05, runs)
        mean = np.array([np.mean(level.variance) for level in levels])
        assert abs(np.mean(mean)) < 4 * np.std(mean) / np.sqrt(runs)  # no bias to either side


def test_noise_level_and_variance_follow_the_textbook() -> None:
    """var(noise of G) = sigma_Y^2 / |U|^2 / P per realisation, and another 1 / M for the mean."""
    m, p = 4, 6
    bla = robust_approximation(measure(FREE, realisations=m, periods=p, noise=SIGMA, seed=3), transient=STEADY)
    assert bla.noise is not None
    assert bla.noise_variance is not None
    true = line_noise(SIGMA, p) / AMPLITUDE**2
    degrees = 2 * m * (p - 1)
    low, high = stats.chi2.ppf([0.0005, 0.9995], degrees * FREE.size) / (degrees * FREE.size)
    assert low < np.mean(bla.noise.variance) / true < high
    inside = np.mean((bla.noise.low < true) & (bla.noise.high > true))
    assert inside >= stats.binom.ppf(0.001, FREE.size, 0.95) / FREE.size
    np.testing.assert_allclose(bla.noise_variance, bla.noise.variance / m)
    assert stats.kstest(bla.noise.variance / true * degrees, stats.chi2(degrees).cdf).pvalue > 0.001


CUBE = 0.4
LINES = with_free_lines(np.arange(1, 48, 2), seed=5)  # 18 lines or so: the exact sums over products stay short


def test_cubic_gain_and_distortion_are_exact() -> None:
    """1 + a (3 sigma^2 - 3/4 A^2), and every product's power on its line; distortion on odd lines only."""
    m = 400
    data = measure(LINES, realisations=m, periods=2, noise=0.01, seed=6, respond=lambda u: u + CUBE * u**3)
    bla = robust_approximation(data, transient=STEADY)
    true = cubic_gain(LINES, CUBE)
    assert np.all(np.abs(true - 1) > 0.1)
    assert np.max(np.abs(bla.gain - true) / np.sqrt(bla.variance)) < 3.7  # of 18 circular errors, 1e-5 each beyond
    power = {k: CUBE**2 * v / AMPLITUDE**2 for k, v in product_power(LINES, 3).items()}
    assert bla.on_lines is not None
    assert bla.odd is not None
    assert bla.even is not None
    for level in (bla.on_lines, bla.odd):
        expected = np.array([power[k] for k in np.round(level.frequency * 2).astype(int)])
        # products share phases, so a power of many realisations scatters a little more than a chi-square does
        np.testing.assert_allclose(level.variance, expected, rtol=0.35)
        assert np.mean(level.variance) == pytest.approx(np.mean(expected), rel=0.05)
        assert distortion_p_value(level) < 1e-12
    assert distortion_p_value(bla.even) > 0.01
    # the share of the distortion in the gain's variance: (sigma_n^2 / P + sigma_S^2) / M
    assert bla.total is not None
    np.testing.assert_allclose(bla.variance, bla.total.variance / m)
    whole = np.mean([power[k] for k in LINES]) + line_noise(0.01, 2) / AMPLITUDE**2
    assert np.mean(bla.total.variance) == pytest.approx(whole, rel=0.05)


def test_square_leaves_the_gain_alone_and_appears_on_even_lines() -> None:
    data = measure(LINES, realisations=200, periods=2, noise=0.01, seed=7, respond=lambda u: u + 0.3 * u**2)
    bla = robust_approximation(data, transient=STEADY)
    np.testing.assert_allclose(bla.gain, 1.0, atol=5 * np.sqrt(line_noise(0.01, 2) / 200) / AMPLITUDE)
    assert bla.even is not None
    assert bla.odd is not None
    assert bla.on_lines is not None
    power = {k: 0.3**2 * v / AMPLITUDE**2 for k, v in product_power(LINES, 2).items()}
    even = np.round(bla.even.frequency * 2).astype(int)
    expected = np.array([power[k] for k in even])
    assert np.mean(bla.even.variance) == pytest.approx(np.mean(expected), rel=0.05)
    np.testing.assert_allclose(bla.even.variance, expected, rtol=0.5)
    assert distortion_p_value(bla.even) < 1e-12
    assert min(distortion_p_value(bla.odd), distortion_p_value(bla.on_lines)) > 0.01
    assert bla.distortion is not None
    assert np.mean(bla.distortion.variance) == pytest.approx(np.mean(expected), rel=0.15)
    assert bla.mean == pytest.approx(0.3 * AMPLITUDE**2 / 2 * LINES.size, abs=5e-4)


@pytest.mark.parametrize("power", [2, 3])
def test_the_fast_method_tells_even_from_odd_with_one_realisation(power: int) -> None:
    data = measure(FREE, realisations=1, periods=4, noise=0.01, seed=8, respond=lambda u: u + 0.1 * u**power)
    bla = fast_approximation(data)
    assert bla.even is not None
    assert bla.odd is not None
    seen, unseen = (bla.even, bla.odd) if power == 2 else (bla.odd, bla.even)
    assert distortion_p_value(seen) < 1e-12
    assert distortion_p_value(unseen) > 0.01
    assert np.mean(seen.variance) > 30 * np.mean(np.abs(unseen.variance))


def test_the_fast_method_s_intervals_cover_the_gain_of_a_cubic() -> None:
    """What the free odd lines show stands for the scatter of the gain on the excited ones."""
    true, inside, ratio = cubic_gain(FREE, CUBE), [], []
    for seed in range(40):
        data = measure(FREE, realisations=1, periods=3, noise=0.01, seed=seed, respond=lambda u: u + CUBE * u**3)
        bla = fast_approximation(data, transient=STEADY)
        inside.append(np.abs(bla.gain - true) < gain_radius(bla))
        ratio.append(np.mean(np.abs(bla.gain - true) ** 2) / np.mean(bla.variance))
    assert np.mean(inside) == pytest.approx(0.95, abs=0.025)
    assert np.mean(ratio) == pytest.approx(1.0, rel=0.15)


def test_wiener_hammerstein_with_a_cubic() -> None:
    """G_1 a (3 sigma_x^2 - 3/4 |X_k|^2) G_2 with x the signal inside."""
    data = measure(LINES, realisations=300, periods=2, noise=1e-3, seed=9, respond=lambda u: through(through(u) ** 3))
    bla = robust_approximation(data, transient=STEADY)
    inner = gain(LINES)
    true = inner**2 * (cubic_gain(LINES, 1.0, np.abs(inner) * AMPLITUDE) - 1)
    assert np.max(np.abs(bla.gain - true) / np.sqrt(bla.variance)) < 3.7
    assert np.max(np.sqrt(bla.variance) / np.abs(true)) < 0.15


def test_on_a_full_grid_neighbours_tell_the_distortion() -> None:
    f = lambda u: u + 0.2 * u**2 + CUBE * u**3  # noqa: E731
    many = robust_approximation(measure(FULL, realisations=200, periods=2, noise=0.01, seed=10, respond=f))
    singles = [
        smooth_approximation(measure(FULL, realisations=1, periods=4, noise=0.01, seed=s, respond=f), width=15)
        for s in range(40)
    ]
    assert many.distortion is not None
    means = [np.mean(one.distortion.variance) for one in singles if one.distortion is not None]
    # of a static system's single realisation the level is a draw with 50 percent standard deviation, 8 percent of 40
    assert np.mean(means) == pytest.approx(np.mean(many.distortion.variance), rel=0.25)
    assert all(one.on_lines is not None and distortion_p_value(one.on_lines) < 1e-12 for one in singles)
    assert singles[0].even is None
    assert singles[0].odd is None


def test_an_actuator_that_excites_other_lines_is_not_taken_for_distortion() -> None:
    """The input is what a distorting actuator made of the command; the plant behind it is linear."""
    data = measure(FREE, realisations=1, periods=4, noise=0.0, seed=12)
    u = data.values[0, 0, :, 0] + 0.1 * data.values[0, 0, :, 0] ** 2 + 0.05 * data.values[0, 0, :, 0] ** 3
    rng = np.random.default_rng(13)
    values = np.empty((1, 4, u.size, 2))
    values[..., 0], values[..., 1] = u, through(u) + 0.003 * rng.standard_normal((1, 4, u.size))
    bla = fast_approximation(Periods(values, ("u", "y"), ("V", "m"), 2.0), excited=FREE)
    assert bla.even is not None
    assert bla.odd is not None
    uncorrected = np.abs(np.fft.rfft(values[0, 0, :, 1])[2:98:2] * 2 / u.size / AMPLITUDE) ** 2
    # the gain between lines is interpolated: what is left is a hundredth at least
    assert np.mean(bla.even.variance) < np.mean(uncorrected) / 100


def test_a_known_reference_removes_the_bias_of_input_noise() -> None:
    m, p, sigma = 200, 2, 4.0
    rng = np.random.default_rng(14)
    clean = measure(ODD, realisations=m, periods=p, noise=0.0, seed=15)
    u, y = clean.values[..., 0], clean.values[..., 1]
    noisy = np.stack([u + sigma * rng.standard_normal(u.shape), y, u], axis=-1)
    with_reference = robust_approximation(Periods(noisy, ("u", "y", "r"), ("V", "m", "V"), 2.0), transient=STEADY)
    alone = Periods(noisy[..., :2], ("u", "y"), ("V", "m"), 2.0)
    without = robust_approximation(alone, excited=ODD, transient=STEADY)
    true = gain(ODD)
    good = np.abs(with_reference.gain - true) ** 2 / with_reference.variance
    assert np.mean(good) == pytest.approx(1.0, abs=0.5)
    assert np.mean(np.abs(without.gain - true) ** 2) > 2 * np.mean(np.abs(with_reference.gain - true) ** 2)
    assert with_reference.noise is not None
    expected = line_noise(sigma, p) / AMPLITUDE**2 * np.abs(true) ** 2
    np.testing.assert_allclose(np.mean(with_reference.noise.variance / expected), 1.0, rtol=0.1)


def test_in_a_feedback_loop_the_reference_gives_the_plant_and_the_input_does_not() -> None:
    """u = r - C y, y = G u + v: noise that comes back through the loop biases Y / U towards -1 / C."""
    m, p = 200, 3
    rng, loop = np.random.default_rng(16), 2.0
    spectra = np.fft.rfft(measure(ODD, realisations=m, periods=1, seed=17).values[:, 0, :, 0], axis=1)
    g = gain(np.arange(spectra.shape[1]))
    values = np.empty((m, p, 512, 3))
    for i in range(p):
        v = np.fft.rfft(5.0 * rng.standard_normal((m, 512)), axis=1)
        y = (g * spectra + v) / (1 + loop * g)
        signals = (spectra - loop * y, y, spectra)
        values[:, i] = np.stack([np.fft.irfft(s, axis=1) for s in signals], axis=-1)
    bla = robust_approximation(Periods(values, ("u", "y", "r"), ("1", "1", "1"), 2.0), transient=STEADY)
    true = g[ODD]
    assert np.mean(np.abs(bla.gain - true) ** 2 / bla.variance) == pytest.approx(1.0, abs=0.5)
    alone = Periods(values[..., :2], ("u", "y"), ("1", "1"), 2.0)
    direct = robust_approximation(alone, excited=ODD, transient=STEADY)
    assert np.mean(np.abs(direct.gain - true) ** 2 / direct.variance) > 2.0


def test_a_start_from_rest_costs_no_period_and_makes_no_distortion() -> None:
    periods = from_rest(FREE, periods=3, noise=0.003, seed=18)
    good, bad = fast_approximation(periods), fast_approximation(periods, transient=STEADY)
    assert good.noise is not None
    assert bad.noise is not None
    true = line_noise(0.003, 3) / AMPLITUDE**2
    assert np.mean(good.noise.variance) == pytest.approx(1.15 * true, rel=0.2)  # 1.15: the polynomial's own share
    assert np.mean(bad.noise.variance) > 3 * true
    assert good.even is not None
    assert distortion_p_value(good.even) > 0.01


def test_the_method_follows_from_the_records() -> None:
    def name(lines: np.ndarray, realisations: int, periods: int = 2) -> str:
        data = measure(lines, realisations=realisations, periods=periods, noise=0.01, seed=19)
        return best_linear_approximation(data).method.split(":")[0]

    assert (name(FREE, 2), name(FREE, 1)) == ("robust", "fast")
    assert {name(FULL, 1), name(ODD, 1), name(FREE, 1, periods=1)} == {"local polynomial"}


def test_the_method_follows_from_the_periods_that_are_left() -> None:
    data = measure(FREE, realisations=1, periods=2, noise=0.01, seed=19)
    bla = best_linear_approximation(data, transient=DropPeriods(1))
    assert bla.method.startswith("local polynomial")
    assert (bla.test.periods, bla.noise) == (1, None)
    np.testing.assert_array_equal(bla.gain, smooth_approximation(data, transient=DropPeriods(1)).gain)
    with pytest.raises(BadInput, match=r"the one period left .* record more, or leave out fewer"):
        fast_approximation(data, transient=DropPeriods(1))


def test_free_lines_tell_even_from_odd_on_an_odd_grid_only() -> None:
    """With even lines excited, u^3 falls on even lines too."""
    lines = np.setdiff1d(FULL, [7, 12, 21, 30, 44])
    data = measure(lines, realisations=3, periods=2, noise=0.01, seed=23, respond=lambda u: u + 0.2 * u**3)
    bla = robust_approximation(data)
    assert bla.even is None
    assert bla.odd is None
    assert bla.distortion is bla.on_lines


def test_what_was_done_is_kept() -> None:
    data = measure(FREE, realisations=2, periods=3, noise=0.01, seed=20, respond=lambda u: through(u) + 5.0)
    bla = robust_approximation(data)
    assert (bla.test.input, bla.test.output, bla.test.input_unit, bla.test.output_unit) == ("u", "y", "V", "m")
    assert bla.test.rms == pytest.approx(AMPLITUDE * np.sqrt(FREE.size / 2))
    assert (bla.test.realisations, bla.test.periods, bla.test.offset) == (2, 3, pytest.approx(0.0, abs=1e-9))
    assert abs(bla.mean - 5.0) < 5 * np.sqrt(bla.mean_variance)
    np.testing.assert_allclose(bla.amplitude, AMPLITUDE)
    np.testing.assert_allclose(bla.frequency, FREE / 2.0)


def test_odd_lines_without_free_ones_are_odd_distortion_themselves() -> None:
    bla = robust_approximation(measure(ODD, realisations=3, periods=2, noise=0.01, seed=21))
    assert bla.odd is bla.on_lines
    assert bla.even is not None


def test_one_period_shows_the_total_alone() -> None:
    bla = robust_approximation(measure(FREE, realisations=3, periods=1, noise=0.01, seed=22))
    assert bla.total is not None
    assert (bla.noise, bla.on_lines, bla.even, bla.odd, bla.distortion, bla.noise_variance) == (None,) * 6


@pytest.mark.parametrize(
    ("lines", "periods", "words"), [(FULL, 3, "odd lines with some of them left free"), (FREE, 1, "one period")]
)
def test_the_fast_method_refuses(lines: np.ndarray, periods: int, words: str) -> None:
    with pytest.raises(BadInput, match=words):
        fast_approximation(measure(lines, realisations=1, periods=periods, noise=0.01, seed=0))


def test_refuses_what_cannot_be() -> None:
    data = measure(FREE, realisations=1, periods=2, noise=0.01, seed=0)
    with pytest.raises(BadInput, match="one realisation does not scatter"):
        robust_approximation(data)
    with pytest.raises(BadInput, match="sample faster"):
        robust_approximation(data, excited=np.array([1, 256]))


@pytest.mark.parametrize(("realisations", "periods"), [(1, 2), (3, 2), (1, 1)])
def test_an_output_that_stands_still_is_refused(realisations: int, periods: int) -> None:
    data = measure(FREE, realisations=realisations, periods=periods, seed=0, respond=lambda u: 0 * u + 3.7)
    for method in (best_linear_approximation, smooth_approximation):
        with pytest.raises(BadInput, match=r"multisine: y stands still at 3\.7; there is no response"):
            method(data)


def test_an_output_that_stands_still_but_for_periods_left_out_is_refused() -> None:
    values = np.array(measure(FREE, realisations=1, periods=3, seed=0).values)
    values[:, 1:, :, 1] = 3.7
    with pytest.raises(BadInput, match="stands still"):
        best_linear_approximation(Periods(values, ("u", "y"), ("V", "m"), 2.0), transient=DropPeriods(1))


def test_the_system_of_these_tests_is_stable() -> None:
    assert np.max(np.abs(np.roots(A))) < 0.8
    assert len(B) == 2
