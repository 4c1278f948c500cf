import numpy as np
import pytest

from pysim.identify.greybox.identifiability import identifiability, whole_exponents

KEYS = ("L", "A", "m", "c")


def slopes_without(direction: list[float], seed: int = 1) -> np.ndarray:
    """Rows that are blind for one direction."""
    n = np.array(direction) / np.linalg.norm(direction)
    return np.random.default_rng(seed).normal(size=(50, len(direction))) @ (np.eye(len(direction)) - np.outer(n, n))


def test_an_exact_direction_is_named_with_whole_exponents() -> None:
    found = identifiability(KEYS, slopes_without([1, -1, -2, 0]))
    (direction,) = found.directions
    assert dict(direction.exponents) == {"L": 1, "A": -1, "m": -2}
    assert direction.spread == np.inf


def test_two_exact_directions_are_told_apart() -> None:
    rows = np.random.default_rng(2).normal(size=(50, 2)) @ np.array([[1, 1, 0, 0], [0, 0, 1, 2.0]])
    found = identifiability(KEYS, rows)
    assert sorted(tuple(sorted(d.exponents)) for d in found.directions) == [("A", "L"), ("c", "m")]


def test_a_loose_direction_is_told_with_its_spread() -> None:
    rows = np.array([[100.0, 0, 0, 0], [0, 100, 0, 0], [0, 0, 1, 1], [0, 0, 0.5, -0.5]])
    found = identifiability(KEYS, rows)
    assert dict(found.directions[0].exponents) == pytest.approx({"m": 1, "c": -1}) or dict(
        found.directions[0].exponents
    ) == pytest.approx({"m": -1, "c": 1})
    assert found.directions[0].spread == pytest.approx(1.0)
    assert identifiability(KEYS, 100 * rows).directions == ()


def test_exponents_that_are_no_fractions_stay_as_they_are() -> None:
    assert whole_exponents(("a", "b"), np.array([1.0, -1.4142])) == {"a": 1.0, "b": -1.414}
    assert whole_exponents(("a", "b"), np.array([0.3, 0.2])) == {"a": 1.5, "b": 1.0}
