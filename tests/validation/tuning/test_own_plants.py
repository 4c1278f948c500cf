"""A plant taken from a linear model with two sides that are alike, where its transfer function is known."""

import numpy as np
import pytest

from validation.load_circuit.case import Way
from validation.load_circuit.linearised import Linear
from validation.tuning.own_plants import _plant, off_the_model

LAG, LEAK, GAIN = 0.05, 3.0, 7.0  # s, 1/s, 1/s
# A valve that lags, x' = (u - x) / LAG, fills one side and empties the other; both lose LEAK / 2 of their difference
A = np.array([[-1 / LAG, 0.0, 0.0], [GAIN, -LEAK / 2, LEAK / 2], [-GAIN, LEAK / 2, -LEAK / 2]])
MODEL = Linear(("x", "p1", "p2"), ("u",), A, np.array([[1 / LAG], [0.0], [0.0]]))
WAY = Way("made up", lambda s: s, ("x", "p1", "p2"), "u", {"p1": 1.0, "p2": -1.0}, scale=2.0)


def test_the_difference_of_two_sides_has_no_pole_at_zero() -> None:
    """2 u -> d: 2 GAIN * 2 / ((LAG s + 1) (s + LEAK))."""
    plant = _plant(MODEL, WAY, ("p1", "p2"), "Pa", "1")
    omega = np.geomspace(0.1, 300, 40)
    s = 1j * omega
    exact = 2 * 2 * GAIN / ((LAG * s + 1) * (s + LEAK))
    assert plant.response(omega) == pytest.approx(exact, rel=1e-9)
    assert sorted(plant.poles().real) == pytest.approx([-1 / LAG, -LEAK])
    assert off_the_model(MODEL, WAY, plant, omega) < 1e-9
