"""From a data set's columns to torque: gains, noises, and what is refused."""

from dataclasses import replace

import numpy as np
import pytest

from pysim.identify.friction import ShaftColumns, shaft_tests
from pysim.types import BadInput, Dataset, MeasuredRecord, MeasuredSignal, Record

GAIN = 9.5493e-6  # m3/rad, thesis Table 5.1


def dataset(unit: str = "Pa", use: str = "fit") -> Dataset:
    time = np.arange(5.0)
    values = np.column_stack([np.full(5, 30.0), np.full(5, 40e5), np.full(5, 10e5)])
    signals = (
        MeasuredSignal("omega_s", "output", "rad/s", "speed", "omega_s"),
        MeasuredSignal("p_s", "input", unit, "supply", "p_s", noise=1e4, resolution=2e4),
        MeasuredSignal("p_L", "input", unit, "load", "p_L", noise=2e4),
    )
    record = Record(time, values, ("omega_s", "p_s", "p_L"), ("rad/s", unit, unit))
    return Dataset("bench", "", "shaft", signals, (MeasuredRecord("a.txt", "other", use, record),))


def test_pressures_become_torque() -> None:
    (test,) = shaft_tests(dataset(), ShaftColumns("omega_s", "p_s", "p_L", GAIN, 2 * GAIN))
    np.testing.assert_allclose(test.torque, GAIN * 40e5 - 2 * GAIN * 10e5)
    np.testing.assert_allclose(test.speed, 30.0)
    assert test.torque_noise == pytest.approx(np.hypot(GAIN * np.hypot(1e4, 2e4 / np.sqrt(12)), 2 * GAIN * 2e4))
    assert test.name == "a.txt"


def test_a_load_that_is_not_logged_is_none() -> None:
    (test,) = shaft_tests(dataset("N.m"), ShaftColumns("omega_s", "p_s"))
    np.testing.assert_allclose(test.torque, 40e5)


def told(**of_supply: float | None) -> Dataset:
    data = dataset()
    speed, supply, load = data.signals
    return replace(data, signals=(speed, replace(supply, **of_supply), load))


def test_a_resolution_alone_tells_no_noise() -> None:
    columns = ShaftColumns("omega_s", "p_s", None, GAIN)
    (test,) = shaft_tests(told(noise=None, resolution=1e3), columns)
    assert test.torque_noise is None
    assert test.torque_rounding == pytest.approx(GAIN * 1e3 / np.sqrt(12))
    (test,) = shaft_tests(told(noise=None), ShaftColumns("omega_s", "p_s", "p_L", GAIN, GAIN))
    assert test.torque_noise is None
    with pytest.raises(BadInput, match="'p_s': a noise of 0 gives no weight"):
        shaft_tests(told(noise=0.0, resolution=None), columns)


@pytest.mark.parametrize(
    ("data", "columns", "message"),
    [
        (dataset(), ShaftColumns("omega_s", "p_s"), "is a pressure; give its motor's gain"),
        (dataset(), ShaftColumns("p_s", "p_s", None, GAIN), "must be in rad/s"),
        (dataset("V"), ShaftColumns("omega_s", "p_s"), "is in V; it must be in Pa or N.m"),
        (dataset(), ShaftColumns("speed", "p_s"), "no signal 'speed'"),
        (dataset(use="validate"), ShaftColumns("omega_s", "p_s", None, GAIN), "no log over time to fit"),
    ],
)
def test_refuses(data: Dataset, columns: ShaftColumns, message: str) -> None:
    with pytest.raises(BadInput, match=message):
        shaft_tests(data, columns)
