"""The case's own arithmetic, on few runs; the claims themselves are tried by `pysim validate`."""

import numpy as np
import pytest

from pysim.identify.blackbox import THESIS_STRUCTURE, from_thesis_row
from validation.blackbox.case import judged, printed_rows, worst_coefficient
from validation.blackbox.coverage import BenchLog, Coverage, coverage
from validation.thesis import measured_responses


def test_rows_are_as_printed() -> None:
    assert (len(printed_rows("4.1")), len(printed_rows("4.3"))) == (18, 2)
    test, row = printed_rows("4.3")[1]
    assert (test.offset, test.amplitude) == (75.0, 10.0)
    assert row == {"b0": 81114.0, "a4": 231.0, "a3": 97740.0, "a2": 13468.0, "a1": 1630.0, "a0": 79655.0}


@pytest.mark.parametrize("weights", ["uniform", "relative"])
def test_rows_come_back_from_their_own_responses(weights: str) -> None:
    for response, (_, row) in zip(measured_responses()[9:], printed_rows("4.1")[9:], strict=True):
        assert worst_coefficient(response, row, weights) < 1e-6  # percent
    assert worst_coefficient(response, {**row, "a2": 1.01 * row["a2"]}, weights) == pytest.approx(0.990, abs=1e-3)


def test_a_drawn_response_is_the_true_one_within_its_covariance() -> None:
    test, row = printed_rows("4.1")[10]
    function = from_thesis_row(row)
    drawn = [BenchLog().response(function, test, np.random.default_rng(seed)) for seed in range(30)]
    sizes = []
    for response in drawn:
        error = response.values - function.at(response.frequency)
        assert response.covariance is not None
        pair = np.stack([error.real, error.imag], axis=1)
        sizes.append(np.einsum("fi,fij,fj->f", pair, np.linalg.inv(response.covariance), pair))
    assert np.mean(sizes) == pytest.approx(2.0, abs=4 * 2 / np.sqrt(30 * 19))  # chi square of two
    logs = BenchLog().times(0.1), BenchLog().times(30.0), BenchLog(samples=500).times(30.0)
    assert [log.size for log in logs] == [5001, 251, 500]


def test_coverage_counts_and_is_judged() -> None:
    test, row = printed_rows("4.1")[10]
    found = coverage(from_thesis_row(row), THESIS_STRUCTURE, test, runs=12, seed=1)
    assert found.names[:7] == ("b0", "a4", "a3", "a2", "a1", "a0", "gain")
    assert found.names[7:] == ("pole 0 Hz", "pole 2 Hz", "pole 2 damping", "pole 4 Hz", "pole 4 damping")
    assert np.all(found.inside >= 8)
    wrong = from_thesis_row({**row, "a0": 1.02 * row["a0"], "b0": 1.02 * row["b0"]})
    other = coverage(wrong, THESIS_STRUCTURE, test, runs=12, seed=1)
    np.testing.assert_array_equal(other.names, found.names)

    good = Coverage("x", ("a", "b"), np.array([475, 470]), 500)
    pooled, outside = judged("t", [good])
    assert pooled.holds
    assert (pooled.value, outside.value) == (pytest.approx(0.5), 0)
    bad = Coverage("x", ("a", "b"), np.array([455, 500]), 500)
    assert good.rare.min() > 0.1
    pooled, outside = judged("t", [bad])
    assert pooled.holds
    assert (outside.value, outside.holds) == (2, False)
    assert "x a, x b" in outside.claim
