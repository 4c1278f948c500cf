"""Pairs that cancel: by distance, and by noise."""

import numpy as np

from pysim.identify.blackbox.cancellation import cancellations

NONE = np.zeros((2, 1), dtype=complex)


def test_by_distance_alone() -> None:
    poles, zeros = np.array([-1.0, -10.0 + 0j]), np.array([-10.005, -3.0 + 0j])
    assert cancellations(poles, zeros, NONE, NONE) == [(1, 0)]


def test_within_noise_and_not() -> None:
    poles, zeros = np.array([-1.0, -10.0 + 0j]), np.array([-10.5, -3.0 + 0j])
    wide, narrow = (np.array([[0.0], [size]], dtype=complex) for size in (0.4, 0.2))
    assert cancellations(poles, zeros, wide, NONE) == [(1, 0)]  # 1.25 standard deviations apart
    assert cancellations(poles, zeros, narrow, NONE) == []  # 2.5
    # two that move together are told apart whatever their common doubt
    assert cancellations(poles, zeros[:1], 10 * wide, 10 * wide[1:]) == []
    assert cancellations(poles, zeros[:1], 10 * wide, -10 * wide[1:]) == [(1, 0)]


def test_complex_pairs_count_once_and_never_with_real_ones() -> None:
    poles = np.array([-1 - 5j, -1 + 5j])
    zeros = np.array([-1.001 - 5j, -1.001 + 5j, -5.0])
    assert cancellations(poles, zeros, NONE, np.zeros((3, 1), dtype=complex)) == [(1, 1)]


def test_what_is_not_determined_cancels() -> None:
    poles, zeros = np.array([-1.0 + 0j]), np.array([-1.5 + 0j])
    assert cancellations(poles, zeros, np.array([[np.inf + 0j]]), np.array([[np.inf + 0j]])) == [(0, 0)]
