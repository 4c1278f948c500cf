"""Intervals of an optimum with orthogonal columns, by hand; quantiles are those of printed tables."""

import numpy as np
import pytest

from pysim.identify.greybox.evaluation import Evaluation
from pysim.identify.greybox.uncertainty import Uncertainty, misfit, uncertainty
from tests.pysim.identify.greybox.functions import space

NORMAL, NORMAL_ONE_SIDED, STUDENT_8 = 1.959964, 1.644854, 2.306004  # 95 percent


def optimum() -> Evaluation:
    """Ten residuals of size 2; a unit of the first parameter moves them by 1 in all, one of the second by 2."""
    jacobian = np.zeros((10, 2))
    jacobian[:4, 0], jacobian[4:8, 1] = 0.5, 1.0
    return Evaluation(np.array([5.0, -3.0]), 40.0, np.full(10, 2.0), jacobian)


def found(*, scale: float = 1.0, told: bool = True, lower: list[float] | None = None) -> Uncertainty:
    return uncertainty(space([5.0, -3.0], lower), optimum(), scale=scale, told=told)


def test_two_fitted_numbers_are_two_degrees_of_freedom_less() -> None:
    assert misfit(optimum()) == pytest.approx(np.sqrt(40 / 8))


@pytest.mark.parametrize(
    ("scale", "told", "quantile"), [(1.0, True, NORMAL), (3.0, True, NORMAL), (1.0, False, STUDENT_8)]
)
def test_intervals_are_quantiles_times_standard_deviations(scale: float, told: bool, quantile: float) -> None:
    first, second = found(scale=scale, told=told).estimates
    assert (first.std, second.std) == (pytest.approx(scale), pytest.approx(scale / 2))
    assert first.interval == pytest.approx((5 - quantile * scale, 5 + quantile * scale), rel=1e-6)
    assert second.interval == pytest.approx((-3 - quantile * scale / 2, -3 + quantile * scale / 2), rel=1e-6)


def test_the_covariance_of_orthogonal_columns_is_diagonal() -> None:
    np.testing.assert_allclose(found(scale=2.0).covariance, np.diag([4.0, 1.0]), atol=1e-12)


def test_at_a_bound_the_interval_has_one_side() -> None:
    first, _ = found(lower=[5.0, -np.inf]).estimates
    assert first.at == "lower"
    assert first.interval == pytest.approx((5.0, 5 + NORMAL_ONE_SIDED), rel=1e-6)
