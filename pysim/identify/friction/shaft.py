"""Logs of a shaft between two motors: speed, and the torques on it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pysim.types import BadInput, Dataset, MeasuredRecord, MeasuredSignal, Record

Array = NDArray[np.float64]


@dataclass(frozen=True)
class ShaftColumns:
    """Which column is what. A gain turns it into torque: the motor's K = displacement / 2 pi for a pressure
    (thesis Eq. 5.8, 5.9), 1 for a torque."""

    speed: str
    supply: str
    load: str | None = None
    supply_gain: float = 1.0
    load_gain: float = 1.0


@dataclass(frozen=True)
class ShaftTest:
    """One log. The noises are standard deviations, or None where not stated.

    time (n_t,) s; speed (n_t,) rad/s as logged; torque (n_t,) N.m, supply minus load; name for messages.
    """

    name: str
    time: Array
    speed: Array
    torque: Array
    torque_noise: float | None = None
    speed_noise: float | None = None


def shaft_tests(dataset: Dataset, columns: ShaftColumns, *, use: str = "fit") -> tuple[ShaftTest, ...]:
    """Every log of a data set for that use.

    Raises:
        BadInput: a column that is not there, in another unit than it must have, or no log for that use.
    """
    speed = _signal(dataset, columns.speed, ("rad/s",), 1.0)
    supply = _signal(dataset, columns.supply, ("Pa", "N.m"), columns.supply_gain)
    load = None if columns.load is None else _signal(dataset, columns.load, ("Pa", "N.m"), columns.load_gain)
    stated = [_noise(supply, columns.supply_gain), 0.0 if load is None else _noise(load, columns.load_gain)]
    noise = None if None in stated else float(np.hypot(*stated))  # type: ignore[arg-type]
    tests = tuple(
        ShaftTest(record.source, *_series(record, columns), noise, _noise(speed, 1.0))
        for record in dataset.records
        if record.use == use and isinstance(record.data, Record)
    )
    if not tests:
        raise BadInput(f"data set {dataset.name!r} has no log over time to {use}; give a record with use = {use!r}")
    return tests


def _signal(dataset: Dataset, name: str, units: tuple[str, ...], gain: float) -> MeasuredSignal:
    signal = dataset.signal(name)
    if signal.unit not in units:
        raise BadInput(
            f"signal {name!r} is in {signal.unit}; it must be in {' or '.join(units)}, or others of its kind"
        )
    if signal.unit == "Pa" and gain == 1.0:
        raise BadInput(f"signal {name!r} is a pressure; give its motor's gain K in m3/rad, torque = K times pressure")
    return signal


def _noise(signal: MeasuredSignal, gain: float) -> float | None:
    """Of noise and resolution, in N.m or rad/s; None where the data set says nothing."""
    if signal.noise is None and signal.resolution is None:
        return None
    return abs(gain) * signal.deviation


def _series(record: MeasuredRecord, columns: ShaftColumns) -> tuple[Array, Array, Array]:
    """Time, speed and torque of one log."""
    data = record.data
    assert isinstance(data, Record)
    torque = columns.supply_gain * data[columns.supply]
    if columns.load is not None:
        torque = torque - columns.load_gain * data[columns.load]
    return data.time, data[columns.speed], torque
