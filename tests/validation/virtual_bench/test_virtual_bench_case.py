"""The case's helpers; the claims themselves are redone by `python3 run.py validate virtual-bench`."""

import numpy as np
import pytest

from pysim.identify import sine_fit
from pysim.io import read_dataset
from pysim.types import MeasuredSignal
from validation.virtual_bench.case import MEASUREMENTS, noise_of, true_parameters


def test_the_measurements_are_what_they_say() -> None:
    data = read_dataset(MEASUREMENTS / "bench-01")
    assert len(data.records) == 68
    slow = next(record for record in data.records if record.source == "frequency_response/O+25_A10/0.1Hz.txt")
    fit = sine_fit(slow.data.time, slow.data["alphaPercent"], 0.1, origin=2.0)  # type: ignore[union-attr,index]
    # a closed loop follows slowly; its offset is off by the valve's share, less than a percent
    assert (fit.amplitude, fit.offset) == (pytest.approx(10, abs=0.1), pytest.approx(25, abs=0.5))
    assert fit.residual == pytest.approx(noise_of(data.signal("alphaPercent")), rel=0.05)


def test_the_truth_in_the_models_names() -> None:
    parameters = true_parameters()
    assert len(parameters) == 13
    assert parameters["K_D"] == pytest.approx(0.22387, abs=1e-5)
    assert "K_d" not in parameters


def test_noise_and_quantisation_add_in_squares() -> None:
    signal = MeasuredSignal("y", "output", "%", "", "y", noise=0.3, resolution=0.4 * np.sqrt(12))
    assert noise_of(signal) == pytest.approx(0.5)
