import numpy as np
import pytest

from pysim.rig import standstills


def test_spans_of_a_sine_in_closed_form() -> None:
    time = np.linspace(0, 10, 100_001)
    spans = standstills(time, 10 * np.sin(2 * np.pi * 0.2 * (time - 1.25)), below=0.5, least=0.01)
    half = np.arcsin(0.05) / (2 * np.pi * 0.2)
    wanted = [(c - half, c + half) for c in (1.25, 3.75, 6.25, 8.75)]
    assert spans == pytest.approx(np.array(wanted), abs=2e-4)


def test_short_spans_and_none() -> None:
    time = np.linspace(0, 1, 101)
    assert standstills(time, np.full(101, 3.0)).shape == (0, 2)
    assert standstills(time, np.zeros(101)).tolist() == [[0.0, 1.0]]
    assert standstills(time, np.where((time > 0.495) & (time < 0.525), 0.0, 3.0)).size == 0
