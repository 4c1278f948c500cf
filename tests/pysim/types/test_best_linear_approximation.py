"""Results that cannot be changed, and cannot be nonsense."""

from dataclasses import FrozenInstanceError, replace

import numpy as np
import pytest

from pysim.types import BadInput, BestLinearApproximation, Distortion, Level, MultisineTest

TEST = MultisineTest("u", "y", "V", "m", 1.0, 0.5, 2.0, 3, 4)
ROW = np.ones(3)
BLA = BestLinearApproximation(
    np.arange(1.0, 4.0), 2j * ROW, ROW, 4 * ROW, None, TEST, "robust", "a.txt", ROW, 0.0, float("nan")
)


def test_arrays_are_copies_nobody_can_change() -> None:
    frequency = np.arange(1.0, 4.0)
    bla = replace(BLA, frequency=frequency)
    frequency[0] = 7.0
    assert bla.frequency[0] == 1.0
    with pytest.raises(ValueError, match="read-only"):
        bla.gain[0] = 0.0
    with pytest.raises(FrozenInstanceError):
        bla.method = "x"  # type: ignore[misc]
    with pytest.raises(ValueError, match="read-only"):
        Level(ROW.cumsum(), ROW, ROW, ROW).variance[0] = 0.0


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"gain": np.ones(2)}, "gain needs shape"),
        ({"variance": np.array([1.0, np.nan, 1.0])}, "finite"),
        ({"frequency": np.array([1.0, 1.0, 2.0])}, "increase"),
        ({"frequency": np.array([0.0, 1.0, 2.0])}, "positive"),
    ],
)
def test_refusals(changes: dict[str, np.ndarray], words: str) -> None:
    with pytest.raises(BadInput, match=words):
        replace(BLA, **changes)  # type: ignore[arg-type]


def test_refuses_other_levels_and_tests() -> None:
    with pytest.raises(BadInput, match="low needs shape"):
        Level(ROW.cumsum(), ROW, np.ones(2), ROW)
    with pytest.raises(BadInput, match="increase"):
        Level(ROW, ROW, ROW, ROW)
    with pytest.raises(BadInput, match="u must move"):
        replace(TEST, rms=0.0)


def test_a_ratio_without_noise() -> None:
    power, noise = np.array([2.0, 1.0, 0.0]), np.array([1.0, 0.0, 0.0])
    level = Distortion(ROW.cumsum(), power - noise, ROW, ROW, power, noise, ROW, ROW)
    np.testing.assert_array_equal(level.ratio, [2.0, np.inf, 1.0])
