"""How far held-out records speak against a model, by hand."""

import numpy as np
import pytest

from pysim.diagnose.decide import disagreement


@pytest.mark.parametrize(
    ("before", "after", "deviations"),
    [
        ([0.0, 0.0], [3.0, 4.0], (25 - 0) / (2 * 5)),
        ([3.0, 4.0], [0.0, 0.0], -2.5),
        ([1.0, 2.0], [4.0, 6.0], (52 - 5) / (2 * 5)),
        ([1.0, -1.0], [-1.0, 1.0], 0.0),
        ([1.0, 2.0], [1.0, 2.0], 0.0),
    ],
)
def test_disagreement_is_the_difference_of_the_squares_over_its_standard_deviation(
    before: list[float], after: list[float], deviations: float
) -> None:
    assert disagreement(np.array(before), np.array(after)) == pytest.approx(deviations)


def test_where_the_former_model_is_true_it_is_half_the_distance_with_a_spread_of_one() -> None:
    """Residuals of the true model are white; those of the other are off by a fixed distance of 6."""
    noise, off = np.random.default_rng(2).standard_normal((4000, 9)), np.full(9, 2.0)
    found = np.array([disagreement(row, row + off) for row in noise])
    assert found.mean() == pytest.approx(6 / 2, abs=4 / np.sqrt(4000))
    assert found.std() == pytest.approx(1.0, abs=4 / np.sqrt(8000))
