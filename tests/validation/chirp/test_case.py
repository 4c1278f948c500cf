"""The chirp case's helpers; the claims themselves are redone by `python3 run.py validate chirp`."""

import numpy as np
import pytest

from pysim.types import MeasuredRecord, Record
from validation.chirp.case import CHIRP, FREQUENCIES, NOISE, STEP, _disturbed


def test_the_sweep_is_slow_enough_for_its_lowest_frequency() -> None:
    # the second extreme of the first pair is 1.25 turns behind the onset
    assert np.sqrt(CHIRP.start_hz**2 + 2.5 * CHIRP.rate) < FREQUENCIES[0]
    assert CHIRP.stop_hz > FREQUENCIES[-1]


def test_the_disturbed_log_has_noise_and_steps() -> None:
    values = np.column_stack([np.zeros(20000), np.full(20000, 50.0)])
    record = MeasuredRecord("a", "chirp", "fit", Record(np.arange(20000.0), values, ("u", "y"), ("%", "%")))
    data = _disturbed(record, seed=3).data
    assert isinstance(data, Record)
    assert np.std(data["y"]) == pytest.approx(np.hypot(NOISE, STEP / np.sqrt(12)), rel=0.03)
    steps = data["y"] / STEP
    np.testing.assert_allclose(steps, np.round(steps), atol=1e-9)
    np.testing.assert_array_equal(data["u"], 0.0)
