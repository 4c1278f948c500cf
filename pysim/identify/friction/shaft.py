"""Logs of a shaft between two motors: speed, and the torques on it."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pysim.identify.columns import declared_noise
from pysim.io.prepare import refuse_missing_in
from pysim.types import BadInput, Dataset, MeasuredRecord, MeasuredSignal, Record

Array = NDArray[np.float64]


@dataclass(frozen=True)
class ShaftColumns:
    """Names of the columns, and gains to torque: the motor's K = displacement / 2 pi for a pressure (thesis Eq. 5.8,
    5.9), 1 for a torque."""

    speed: str
    supply: str
    load: str | None = None
    supply_gain: float = 1.0
    load_gain: float = 1.0


@dataclass(frozen=True)
class ShaftTest:
    """One log. The noises are standard deviations, or None if not specified.

    time (n_t,) s; speed (n_t,) rad/s as logged; torque (n_t,) N.m, supply minus load; name for messages;
    torque_rounding N.m, standard deviation due to quantisation alone, a lower bound of the noise.
    """

    name: str
    time: Array
    speed: Array
    torque: Array
    torque_noise: float | None = None
    speed_noise: float | None = None
    torque_rounding: float = 0.0


def shaft_tests(dataset: Dataset, columns: ShaftColumns, *, use: str = "fit") -> tuple[ShaftTest, ...]:
    """Every log of a data set with that use.

    Raises:
        BadInput: a column that is missing, in a wrong unit or with a noise of zero, or no log with that use.
    """
    speed = _signal(dataset, columns.speed, ("rad/s",), 1.0)
    supply = _signal(dataset, columns.supply, ("Pa", "N.m"), columns.supply_gain)
    load = None if columns.load is None else _signal(dataset, columns.load, ("Pa", "N.m"), columns.load_gain)
    torques = [(supply, columns.supply_gain), *([] if load is None else [(load, columns.load_gain)])]
    stated = [_times(gain, declared_noise(dataset, signal.name)) for signal, gain in torques]
    noise = None if None in stated else float(np.linalg.norm(stated))  # type: ignore[arg-type]
    rounding = float(np.linalg.norm([gain * (signal.resolution or 0.0) / math.sqrt(12) for signal, gain in torques]))
    own = speed.deviation if speed.noise is not None or speed.resolution is not None else None
    tests = tuple(
        ShaftTest(record.source, *_series(dataset, record, columns), noise, own, rounding)
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


def _times(gain: float, noise: float | None) -> float | None:
    """Noise of a torque in N.m, from that of its column; None if it is not specified."""
    return None if noise is None else abs(gain) * noise


def _series(dataset: Dataset, record: MeasuredRecord, columns: ShaftColumns) -> tuple[Array, Array, Array]:
    """Time, speed and torque of one log."""
    data = record.data
    assert isinstance(data, Record)
    used = (columns.speed, columns.supply, *(() if columns.load is None else (columns.load,)))
    refuse_missing_in(dataset, record, data, used)
    torque = columns.supply_gain * data[columns.supply]
    if columns.load is not None:
        torque = torque - columns.load_gain * data[columns.load]
    return data.time, data[columns.speed], torque
