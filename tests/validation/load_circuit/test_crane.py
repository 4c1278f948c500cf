"""The recount of pulses, on angles whose pulses can be told by hand."""

import numpy as np

from validation.load_circuit.crane import PITCH, recounted


def test_one_pulse_for_each_pitch_since_the_last_either_way() -> None:
    assert recounted(np.linspace(0, 5.5 * PITCH, 1000)) == 5
    there_and_back = np.concatenate([np.linspace(0, 2.5, 500), np.linspace(2.5, 0, 500)]) * PITCH
    assert recounted(there_and_back) == 2 + 1  # back from 2.5 it takes until 1, and 0 is not passed
    assert recounted(np.array([0.0, 0.9, -0.9, 0.9]) * PITCH) == 0


def test_a_long_step_loses_none() -> None:
    assert recounted(np.array([0.0, 3.2]) * PITCH) == 3
