"""How wide an interval is drawn and told."""

import pytest
from scipy.stats import norm

from pysim.identify import HALF_95


def test_nineteen_of_twenty_normal_errors_are_inside() -> None:
    assert norm.cdf(HALF_95) - norm.cdf(-HALF_95) == pytest.approx(0.95, abs=1e-7)
