"""Finding the excited lines, and sorting the others."""

import numpy as np
import pytest

from pysim.identify.multisine import Periods, excited_lines, find_excited, lines_of
from pysim.identify.multisine.lines import chosen_lines
from pysim.types import BadInput
from tests.pysim.identify.multisine.systems import ODD, measure, with_free_lines


def test_free_lines_are_sorted_by_parity() -> None:
    lines = lines_of(np.array([3, 5, 9, 11]))
    assert lines.are_odd
    np.testing.assert_array_equal(lines.even, [2, 4, 6, 8, 10, 12])
    np.testing.assert_array_equal(lines.odd, [7])
    assert not lines_of(np.array([1, 2, 3])).are_odd


@pytest.mark.parametrize("excited", [[1], [0, 1], [3, 3], [5, 4]])
def test_refuses_no_lines(excited: list[int]) -> None:
    with pytest.raises(BadInput, match="at least two excited harmonics"):
        lines_of(np.array(excited))


@pytest.mark.parametrize("quantum", [0.0, 0.02])
def test_excited_lines_are_found_in_any_shape_of_spectrum(quantum: float) -> None:
    rng = np.random.default_rng(3)
    excited = with_free_lines(ODD, seed=4)
    amplitude = quantum * rng.random(255)
    amplitude[excited - 1] = 1 / np.sqrt(excited)  # 20 dB from the lowest to the highest
    np.testing.assert_array_equal(find_excited(amplitude), excited)


def test_all_lines_excited_are_found_too() -> None:
    np.testing.assert_array_equal(find_excited(np.ones(40)), np.arange(1, 41))


def test_refuses_a_spectrum_without_lines() -> None:
    with pytest.raises(BadInput, match="does not show which lines"):
        find_excited(1 / np.arange(1.0, 400.0))
    with pytest.raises(BadInput, match="stands still"):
        find_excited(np.zeros(40))


def test_the_command_of_every_realisation_must_show_the_same_lines() -> None:
    same = measure(with_free_lines(ODD, seed=1), realisations=2, periods=2, seed=0)
    np.testing.assert_array_equal(excited_lines(same).excited, with_free_lines(ODD, seed=1))
    other = measure(with_free_lines(ODD, seed=2), realisations=1, periods=2, seed=0)
    mixed = Periods(np.concatenate([same.values, other.values]), same.names, same.units, same.period)
    with pytest.raises(BadInput, match="excite different lines"):
        excited_lines(mixed)


def test_named_lines_are_held_against_the_samples_of_a_period() -> None:
    """N = 512: the highest line is 255, and no free line is looked for above it."""
    data = measure(ODD, realisations=1, periods=2, seed=0)
    lines = chosen_lines(data, np.array([251, 255]))
    np.testing.assert_array_equal(lines.even, [250, 252, 254])
    np.testing.assert_array_equal(chosen_lines(data, None).excited, ODD)
    with pytest.raises(BadInput, match="line 256 is not below half of 512 samples"):
        chosen_lines(data, np.array([1, 256]))
