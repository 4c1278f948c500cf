"""Realisations are told by their spectra."""

import numpy as np

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
