"""Realisations are told by their spectra."""

import numpy as np
import pytest

from pysim.identify.multisine import Periods
from pysim.identify.multisine.groups import grouped_realisations
from tests.pysim.identify.multisine.systems import ODD, measure, with_free_lines


def single(
    seed: int, *, amplitude: float = 0.3, periods: int = 3, lines: np.ndarray = ODD, offset: float = 0.0
) -> Periods:
    data = measure(lines, realisations=1, periods=periods, noise=0.01, seed=seed, amplitude=amplitude)
    return Periods(data.values + np.array([offset, 0.0]), data.names, data.units, data.period, f"{seed}")


def test_grid_amplitude_and_offset_tell_tests_apart() -> None:
    records = [
        single(0),
        single(1, amplitude=0.6),
        single(2, periods=4),
        single(3, lines=with_free_lines(ODD, seed=1)),
        single(4, offset=5.0),
        single(5, amplitude=0.601),
    ]
    groups = grouped_realisations(records)
    assert [g.values.shape[:2] for g in groups] == [(2, 3), (2, 3), (1, 3), (1, 3)]
    assert [g.origin for g in groups] == ["0", "1", "3", "4"]
    np.testing.assert_array_equal(groups[0].values[1], records[2].values[0, 1:])


@pytest.mark.parametrize("amplitude", [0.1, 30.0])
def test_an_offset_counts_against_the_size_of_the_command(amplitude: float) -> None:
    first = single(0, amplitude=amplitude)
    size = float(np.std(first.values[..., 0]))
    near, far = (single(0, amplitude=amplitude, offset=share * size) for share in (0.05, 0.2))
    assert [group.values.shape[0] for group in grouped_realisations([first, near, far])] == [2, 1]
