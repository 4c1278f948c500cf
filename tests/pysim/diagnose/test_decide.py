"""Chance, price and shares against closed forms."""

import math

import numpy as np
import pytest

from pysim.diagnose import decide
from pysim.identify.greybox.residuals import Point


def test_price_and_share() -> None:
    assert decide.price(2, 1000) == pytest.approx(2 * math.log(1000))
    assert decide.explained(30.0, 160.0, 100) == pytest.approx(0.5)
    assert decide.explained(80.0, 160.0, 100) == 1.0
    assert decide.explained(3.0, 90.0, 100) == 0.0  # nothing was avoidable


def test_inflation() -> None:
    residual = np.full(202, math.sqrt(1.2 * 200 / 202))
    point = Point(np.zeros(2), float(residual @ residual), residual, np.zeros((202, 2)))
    assert decide.inflation(point) == pytest.approx(1.2)
