"""The free set over time within 0.02 percent, 0.001 and 0.5 bar rms of the independent simulation."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from pysim.simulate import simulate
from pysim.thesis import pump_model, read_csv
from pysim.types import Experiment, Model, Record, Signal
from validation.findings import Finding
from validation.pump_time.cosimulation import cosimulate

Array = NDArray[np.float64]

# Column of the reference -> variable, limit of the rms difference, unit of the limit, its size in the FMU's unit
CHECKS = {
    "alpha_percent": ("alphaPercent", 0.02, "%", 1.0),
    "u": ("u", 0.001, "1", 1.0),
    "p1_Pa": ("p1", 0.5, "bar", 1e5),
    "p2_Pa": ("p2", 0.5, "bar", 1e5),
}
NAMES = tuple(variable for variable, *_ in CHECKS.values())
_FILE = Path(__file__).parents[1] / "reference" / "pump_time_response.csv"
_WAVES = np.array([[40.0, 0.4], [15.0, 2.3], [5.0, 7.1]])  # percent, Hz
_FADE_IN = 0.5  # s


def run() -> Iterator[Finding]:
    """Model exchange through the native loop and co-simulation by the FMU's own integrator, FMI 2 and FMI 3."""
    reference = reference_response()
    for fmi in (2, 3):
        model = pump_model("free", fmi=fmi)
        yield from _check(f"FMI {fmi}, model exchange", exchange(model, reference.time), reference)
        yield from _check(f"FMI {fmi}, co-simulation", cosimulate(model, command, reference.time, NAMES), reference)


def reference_response() -> Record:
    """The independent simulation, with the FMU's names and units."""
    rows = read_csv(_FILE)
    time = np.array([float(row["time_s"]) for row in rows])
    values = np.array([[float(row[column]) for column in CHECKS] for row in rows])
    return Record(time, values, NAMES, ("%", "1", "Pa", "Pa"), origin="independent simulation")


def command(t: Array) -> tuple[Array, Array]:
    """alphaCMD in percent and its rate in percent/s, (n_t,) each: three sines that fade in."""
    t = np.asarray(t, dtype=np.float64)
    amplitude, omega = _WAVES[:, 0], 2 * np.pi * _WAVES[:, 1]
    angle = t[..., None] * omega
    waves, slopes = (amplitude * np.sin(angle)).sum(axis=-1), (amplitude * omega * np.cos(angle)).sum(axis=-1)
    fade = np.exp(-t / _FADE_IN)
    return (1 - fade) * waves, (1 - fade) * slopes + fade / _FADE_IN * waves


def spline(times: Array) -> Signal:
    """The command as cubics that meet it in value and rate at `times`; 1 ms apart they are within 2e-7 percent."""
    return Signal.through(times, *command(times))


def exchange(model: Model, times: Array) -> Record:
    """Model exchange with the rate fed exactly."""
    signal = spline(np.arange(0.0, times[-1] + 1.5e-3, 1e-3))
    return simulate(model, Experiment(times, NAMES, {"alphaCMD": signal}, rates={"alphaCMD_t": "alphaCMD"}))


def _check(title: str, record: Record, reference: Record) -> Iterator[Finding]:
    for variable, limit, unit, size in CHECKS.values():
        rms = float(np.sqrt(np.mean((record[variable] - reference[variable]) ** 2))) / size
        yield Finding(f"{title}: rms difference of {variable}", rms, limit, unit)
