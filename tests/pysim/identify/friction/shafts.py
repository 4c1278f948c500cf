"""A shaft test with known friction: thesis Table 6.2, a slow swing, the pulse sensor, noise on torque and timing."""

from dataclasses import dataclass
from functools import cache

import numpy as np
from numpy.typing import NDArray

import fmu_build
from pysim.identify.friction import ShaftTest, friction_torque, pulse_speed, pulse_times
from pysim.io import read_model
from pysim.simulate import Rodas, simulate
from pysim.types import Experiment, Record, Signal

Array = NDArray[np.float64]

TRUTH = np.array([13.8806, 8.3593, 14.8939, 54.8258])  # r, omega_0, tau_c, tau_s
INERTIA = 0.0733


@dataclass(frozen=True)
class Swing:
    """What the simulated bench did, before any noise: the record and the command."""

    record: Record
    command: Signal


@cache
def simulated(seconds: float = 60.0, rate: float = 250.0) -> Swing:
    """The driven shaft of the library under a sine of 50 rad/s that lasts the whole time."""
    model = read_model(fmu_build.build("HydraulicTestBench.Mechanics.DrivenShaft"))
    command = Signal(np.zeros(1), np.zeros((1, 4)), np.array([[[50.0, 0.0, 2 * np.pi / seconds, 0.0]]]))
    names = ("T_s", "theta", "omega", "omega_s")
    times = np.arange(0.0, seconds, 1 / rate)
    solver = Rodas(rtol=1e-7, atol=1e-7)
    return Swing(simulate(model, Experiment(times, names, {"omega_ref": command}), solver=solver), command)


def measured(swing: Swing, seed: int, *, torque_noise: float = 0.5, jitter: float = 20e-6) -> ShaftTest:
    """A log of it: noise in N.m on the torque, in s on each pulse."""
    rng = np.random.default_rng(seed)
    record = swing.record
    edges = pulse_times(record.time, record["theta"], record["omega"])
    edges = np.sort(edges + rng.normal(0.0, jitter, edges.size))
    speed = pulse_speed(edges, record.time, swing.command.value(record.time))
    torque = record["T_s"] + rng.normal(0.0, torque_noise, record.time.size)
    return ShaftTest("swing", record.time, speed, torque)


def closed_form(speed: Array) -> Array:
    """Friction of Table 6.2."""
    return friction_torque(TRUTH, speed)
