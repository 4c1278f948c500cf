"""Gains against chance: on linear models everything can be worked out another way."""

import math
from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy import signal, stats

from pysim.diagnosis.candidate import Models
from pysim.diagnosis.rivals import (
    Rows,
    effective,
    left_out_error,
    of,
    p_value,
    penalised,
    rows,
    samples,
    shares_of_blocks,
    tolerance,
)
from tests.pysim.diagnosis.plants import given, measured, refitted

Array = NDArray[np.float64]


def made(residual: Array, slopes: Array | None = None, **more: object) -> Rows:
    """Rows of one series in order, of level 1 and in one block, where nothing else is said."""
    n = residual.size
    fields: dict[str, object] = {
        "residual": residual,
        "jacobian": np.zeros((n, 0)) if slopes is None else slopes,
        "level": np.ones(n),
        "series": np.zeros(n, dtype=np.intp),
        "blocks": np.zeros(n, dtype=np.intp),
        "ordered": frozenset({0}),
    }
    return Rows(**{**fields, **more})  # type: ignore[arg-type]


def autoregressive(rng: np.random.Generator, n: int, kept: float, count: int = 1) -> Array:
    """(count, n) of variance 1, each number the one before times `kept` and something new; stationary."""
    drawn = rng.standard_normal((count, n + 200))
    own = signal.lfilter([math.sqrt(1 - kept**2)], [1.0, -kept], drawn, axis=1)
    return np.asarray(own[:, 200:])


def gain_of(table: Array, more: Array, values: Array) -> tuple[float, Array, Array]:
    """n/2 log of two sums of squares of linear regressions, and what the larger and the smaller one leave."""
    left = [values - t @ np.linalg.lstsq(t, values, rcond=None)[0] for t in (table, np.column_stack([table, more]))]
    smaller, larger = left
    return values.size / 2 * math.log((smaller @ smaller) / (larger @ larger)), larger, smaller


def test_the_chance_of_a_gain_is_that_of_the_f_test_of_a_linear_regression() -> None:
    rng = np.random.default_rng(1)
    n, found = 40, []
    for _ in range(1500):
        table, more, values = rng.standard_normal((n, 3)), rng.standard_normal((n, 2)), rng.standard_normal(n)
        gain, larger, smaller = gain_of(table, more, values)
        ratio = (smaller @ smaller - larger @ larger) / 2 / (larger @ larger / (n - 5))
        found.append(p_value(gain, 2, n, 5, 1.0))
        assert found[-1] == pytest.approx(stats.f.sf(ratio, 2, n - 5), rel=1e-9)
    assert stats.kstest(found, "uniform").pvalue > 0.01


def test_coloured_residuals_name_nothing_more_often_than_white_ones() -> None:
    """Every draw has nothing to find, but noise and regressor remember; a fifth of all would be found by raw n."""
    rng = np.random.default_rng(2)
    n, count = 1000, 1000
    noise, change = autoregressive(rng, n, 0.7, count), autoregressive(rng, n, 0.8, count)
    table = np.ones((n, 1))
    found, raw = 0, 0
    for values, column in zip(noise, change, strict=True):
        gain, larger, smaller = gain_of(table, column[:, None], values)
        inflated = effective(made(larger), smaller - larger)
        found += p_value(gain, 1, n, 2, inflated) < 0.05
        raw += p_value(gain, 1, n, 2, 1.0) < 0.05
    assert raw > 0.2 * count
    low, high = stats.binom.ppf([1e-3, 1 - 1e-3], count, 0.05)
    assert low <= found <= high


def test_doubled_samples_say_what_single_ones_say() -> None:
    assert p_value(14.0, 2, 600, 5, 2.0) < 1.0
    one, twice = p_value(7.0, 2, 300, 5, 1.0), p_value(14.0, 2, 600, 5, 2.0)
    assert twice == pytest.approx(one, rel=1e-12)
    assert penalised(14.0, 2, 2.0, 600) == pytest.approx(2 * penalised(7.0, 2, 1.0, 300), rel=1e-12)


def test_too_few_independent_samples_are_no_evidence() -> None:
    assert p_value(1e3, 1, 100, 6, 20.0) == 1.0
    assert p_value(1e6, 1, 100, 6, 1.0) < 1e-100  # such a gain is not an overflow


def test_the_penalty_is_that_of_schwarz() -> None:
    """Twice the penalised gain is the difference of two BIC = n log(RSS/n) + p log(n)."""
    rng = np.random.default_rng(3)
    n = 80
    table, more, values = rng.standard_normal((n, 2)), rng.standard_normal((n, 3)), rng.standard_normal(n)
    gain, larger, smaller = gain_of(table, more, values)
    small, large = (n * math.log(rest @ rest / n) + p * math.log(n) for rest, p in ((smaller, 2), (larger, 5)))
    assert penalised(gain, 3, 1.0, n) == pytest.approx((small - large) / 2, rel=1e-9)


@pytest.mark.parametrize(("a", "b"), [(0.0, 0.9), (0.6, 0.6), (0.9, 0.5), (0.9, 0.95)])
def test_lambda_of_two_autoregressions(a: float, b: float) -> None:
    """Their autocorrelations are a^k and b^k, so lambda is 1 + 2 sum (a b)^k."""
    rng = np.random.default_rng(4)
    n = 400_000
    rest, change = autoregressive(rng, n, a)[0], autoregressive(rng, n, b)[0]
    expected = (1 + a * b) / (1 - a * b)
    assert effective(made(rest), change) == pytest.approx(expected, rel=0.05)


def test_lambda_of_two_logs_weighs_each_by_what_changes_in_it() -> None:
    rng = np.random.default_rng(5)
    n = 200_000
    rest = np.concatenate([autoregressive(rng, n, 0.8)[0], rng.standard_normal(n)])
    change = np.concatenate([autoregressive(rng, n, 0.5)[0], 3 * autoregressive(rng, n, 0.5)[0]])
    level = np.repeat([1.0, 7.0], n)
    found = made(rest * level, level=level, series=np.repeat([0, 1], n), ordered=frozenset({0, 1}))
    assert effective(found, change * level) == pytest.approx((1.4 / 0.6 + 9) / 10, rel=0.05)


def test_rows_of_a_cluster_count_together() -> None:
    """All of a cluster alike: lambda is its size; where they cancel, that of independent rows."""
    m, clusters = 8, 50
    signs = np.repeat(np.random.default_rng(6).choice([-1.0, 1.0], clusters), m)
    blocks = np.repeat(np.arange(clusters) % 24, m)
    alike = made(signs, blocks=blocks, ordered=frozenset())
    assert effective(alike, np.ones(m * clusters)) == pytest.approx(m)
    against = made(np.tile([1.0, -1.0], m * clusters // 2), blocks=blocks, ordered=frozenset())
    assert effective(against, np.ones(m * clusters)) == pytest.approx(1.0)


def test_what_changes_nothing_has_no_colour() -> None:
    assert effective(made(np.ones(100)), np.zeros(100)) == 1.0


def test_blocks_left_out_are_predicted_by_the_others() -> None:
    """On a linear model first order is exact: every block against a regression that was made without it."""
    rng = np.random.default_rng(7)
    n = 300
    blocks, level = rng.integers(0, 7, n).astype(np.intp), rng.uniform(0.2, 5.0, n)
    table = rng.standard_normal((n, 4)) * [1.0, 10.0, 0.1, 3.0]
    values = table @ [1.0, -0.2, 5.0, 0.3] + level * rng.standard_normal(n)
    other = rng.uniform(0.2, 5.0, n)  # level of the model that is compared
    best = np.linalg.lstsq(table / level[:, None], values / level, rcond=None)[0]
    found = left_out_error(made(values - table @ best, -table / level[:, None], level=level), blocks, other)
    for b in range(7):
        kept = blocks != b
        refit = np.linalg.lstsq(table[kept] / level[kept, None], values[kept] / level[kept], rcond=None)[0]
        missed = (values - table @ refit)[~kept] / other[~kept]
        assert found[b] == pytest.approx(missed @ missed / 2, rel=1e-5)


def test_a_model_without_parameters_is_as_wrong_as_it_is() -> None:
    rest, blocks = np.array([1.0, 2.0, 3.0]), np.array([0, 1, 1], dtype=np.intp)
    assert left_out_error(made(rest), blocks, np.ones(3)) == pytest.approx([0.5, 6.5])


@pytest.mark.parametrize("kept", [0.0, 0.8])
def test_the_difference_of_two_gains_scatters_as_far_as_its_tolerance(kept: float) -> None:
    rng = np.random.default_rng(8)
    n, count = 500, 3000
    apart, level = 0.3 * autoregressive(rng, n, 0.6)[0], 2.0
    noise = level * autoregressive(rng, n, kept, count)
    gains = np.sum(noise**2 - (noise + level * apart) ** 2, axis=1) / (2 * level**2)
    inflated = float(np.mean([effective(made(own, level=np.full(n, level)), level * apart) for own in noise[:200]]))
    reach = tolerance(inflated, level * apart, np.full(n, level), 2.0)
    assert reach == pytest.approx(2 * gains.std(), rel=0.1)


def test_shares_of_blocks_are_those_of_the_squares() -> None:
    change, level = np.array([2.0, 2.0, 6.0, 1.0]), np.array([2.0, 1.0, 2.0, 1.0])
    blocks = np.array([0, 0, 1, 3], dtype=np.intp)
    assert shares_of_blocks(change, level, blocks) == pytest.approx(np.array([5, 9, 0, 1]) / 15)
    assert shares_of_blocks(np.zeros(4), level, blocks).tolist() == [0.0] * 4


def test_rows_of_a_fit_are_its_samples_in_their_own_units() -> None:
    data = measured("axis", length=4.0)
    fit = refitted(Models(given("axis", data, (), initial="near rest")))
    found, point = rows(fit.candidate, fit.candidate.residuals(fit.simulation), fit.point), fit.point
    count = 2 * 2 * 200  # logs, signals, samples
    assert samples(fit) == found.residual.size == count
    assert found.residual.size < point.residual.size  # without what is known of initial states
    for k, own in enumerate(([0, 2], [1, 3])):  # the position in both logs, then the current
        rest = found.residual[np.isin(found.series, own)]
        assert rest @ rest == pytest.approx(point.squares[k])
    assert found.ordered == {0, 1, 2, 3}


def test_models_are_compared_sample_by_sample_however_long_the_logs_are() -> None:
    """A fit alone reduces long logs to triangles, of which those of two models have nothing in common."""
    data, answers = measured("mass", {"mass.drag": {"c_2": 1.0}}, fit=(1,), length=12.0), []
    for longest in (200_000, 100):
        own = given("mass", data, ("mass.drag",))
        noise = replace(own.treatment.noise, whole=longest)
        models = Models(replace(own, treatment=replace(own.treatment, noise=noise)))
        base, drag = refitted(models), refitted(models, "mass.drag", values={("mass.drag", "c_2"): 0.5})
        apart = of(base).residual - of(drag).residual
        answers.append((apart.size, effective(of(drag), apart)))
    assert answers[0][0] == answers[1][0] == 600
    assert answers[0][1] == pytest.approx(answers[1][1])
