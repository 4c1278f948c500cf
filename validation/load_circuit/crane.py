"""A minute of crane operation on the whole rig: energy, speed, and the pulses one by one."""

from __future__ import annotations

import time
from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

import fmu_build
from pysim.io import read_model
from pysim.simulate import Rodas, simulate
from pysim.types import Experiment
from validation.findings import Finding

Array = NDArray[np.float64]

RIG = "HydraulicTestBench.Validation.CraneEnergy"
WINCH = "HydraulicTestBench.Validation.WinchEnergy"
SHAFT = "HydraulicTestBench.Validation.PulseSpeed"
COUNTER = "bench.rig.counter"
PITCH = 2 * np.pi / 10
ACCELERATION = 4.0  # rad/s^2, of PulseSpeed
SECOND = np.arange(0.0, 60.0005, 1e-3)
FACTOR = 50.0


def crane_minute() -> Iterator[Finding]:
    """The rig that follows the crane's references, and the crane with the closed circuit in its own winch."""
    rig = read_model(fmu_build.build(RIG))
    balances = {"error_s": "supply circuit", "error_L": "load circuit", "error": "shaft"}
    minute = Experiment(np.arange(1.0, 60.001, 0.01), (*balances, "passed"))
    simulate(rig, minute, solver=Rodas())  # the first run loads and compiles
    started = time.process_time()
    record = simulate(rig, minute, solver=Rodas())
    factor = 60 / (time.process_time() - started)
    for name, what in balances.items():
        off = 100 * float(np.abs(record[name]).max())
        yield Finding(f"crane operation, energy of the {what} over a minute", off, 0.1, "percent of the work passed on")
    claim = f"crane operation, {factor:.0f} times faster than real time in one thread; short of {FACTOR:g}"
    yield Finding(claim, FACTOR - factor, 0, "")
    winch = simulate(read_model(fmu_build.build(WINCH)), Experiment(minute.times, ("error",)), solver=Rodas())
    off = 100 * float(np.abs(winch["error"]).max())
    yield Finding(
        "crane's winch, energy of its closed circuit over a minute", off, 0.1, "percent of the work passed on"
    )


def pulses() -> Iterator[Finding]:
    """Times of the pulses against a closed form, and each pulse of the minute against the angle it stands for."""
    edges = _recorded(SHAFT, np.arange(0.0, 3.0, 1e-3), ("sensor.count", "sensor.t_pulse"), 1e-9)
    times = edges["sensor.t_pulse"][np.flatnonzero(np.diff(edges["sensor.count"])) + 1][1:]  # the first is the start
    expected = np.sqrt(2 * PITCH * np.arange(1, times.size + 1) / ACCELERATION)
    due = int(ACCELERATION / 2 * 2.999**2 / PITCH)
    yield Finding(f"even acceleration: {times.size} edges, not as many as due", abs(times.size - due), 0, "")
    yield Finding("even acceleration: time of an edge off its closed form", np.abs(times - expected).max(), 1e-8, "s")
    names = tuple(f"{COUNTER}.{name}" for name in ("count", "theta", "EventTheta", "EventOmega"))
    record = _recorded(RIG, SECOND, names, 1e-6)
    count, theta, at_pulse, speed = (record[name] for name in names)
    new = np.flatnonzero(np.diff(count)) + 1
    turned = np.abs(np.diff(np.concatenate([[0.0], at_pulse[new]])))
    late = np.abs((turned - PITCH) / speed[new]).max()
    again = recounted(theta)
    yield Finding(
        f"crane operation: {count[-1]:.0f} pulses, recounted from the angle", abs(count[-1] - again), 0, "off"
    )
    yield Finding("crane operation: time of a pulse off the angle it stands for", float(late), 1e-8, "s")


def recounted(theta: Array) -> int:
    """Pulses in samples (n,) rad of an angle that starts at 0: one for each pitch since the last, either way."""
    last, count = 0.0, 0
    for angle in theta:
        while abs(angle - last) > PITCH:
            last += PITCH * np.sign(angle - last)
            count += 1
    return count


def _recorded(name: str, times: Array, recorded: tuple[str, ...], tolerance: float) -> dict[str, Array]:
    run = Experiment(times, recorded)
    record = simulate(read_model(fmu_build.build(name)), run, solver=Rodas(rtol=tolerance, atol=tolerance))
    return {name: record[name] for name in recorded}
