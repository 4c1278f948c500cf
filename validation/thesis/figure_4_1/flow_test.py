"""The flow test of thesis Section 4.1 on a pump whose stop and drive are known, and both found again from its logs."""

from __future__ import annotations

from functools import cache
from pathlib import Path

import numpy as np

import fmu_build
from pysim.identify.greybox import Parameter, fit, problem
from pysim.io import read_model
from pysim.simulate import Rodas, simulate
from pysim.types import Dataset, Experiment, Fit, MeasuredRecord, MeasuredSignal, Model, Record, Signal
from validation.pump_flow.kinematics import LITRES

PRINTED = 1450.0  # rpm, thesis Section 3.1.2
SYNCHRONOUS = 1500.0  # rpm, of four poles at 50 Hz: no induction motor drives faster
DRIVE = 1490.0  # rpm of the plant: little slip, as without load
STROKE = 0.95  # of the stroke, where the stop of the plant is
RPM = 60 / (2 * np.pi)
HELD = {"omega": PRINTED / RPM, "pump.stroke_share": 1.0, "pump.V_d_max": 71e-6}
FREE = {
    "omega": (PRINTED / RPM, 140.0, 165.0),
    "pump.stroke_share": (0.97, 0.8, 1.0),
    "pump.V_d_max": (71e-6, 60e-6, 80e-6),
}
_TOUCH = 1.0  # N, of some 6 kN that the cylinder pushes with
_RANGES = ((2.0, 18.0), (40.0, 100.0))  # % of the command in which the small and the large flow meter read
_RATE = 0.5  # %/s of the command: slow against every time constant of the pump
_SAMPLING = 5.0  # Hz
_NOISE = 0.3 / LITRES  # m3/s, chosen: 0.3 percent of the largest flow
_SEED = 1


def model() -> Model:
    """The pump block on its drive, to be compiled once."""
    return read_model(fmu_build.build("FlowTest", libraries=[Path(__file__).parent / "FlowTest.mo"]))


@cache
def sweep(stroke: float = STROKE, low: float = 0.0, high: float = 100.0) -> Record:
    """The command from one percentage to another, slowly, with the drive of the plant."""
    length = (high - low) / _RATE
    times = np.arange(0.0, length + 0.5 / _SAMPLING, 1 / _SAMPLING)
    command = Signal.lines([0.0, length], [low, high])
    experiment = Experiment(
        times,
        ("alphaCMD", "Q", "f_stop"),
        {"alphaCMD": command},
        {"omega": DRIVE / RPM, "pump.stroke_share": stroke},
        rates={"alphaCMD_t": "alphaCMD"},
    )
    return simulate(model(), experiment, solver=Rodas(rtol=1e-7, atol=1e-7))


@cache
def logged() -> Dataset:
    """What both flow meters log: each in its range, with noise; nothing between 20 and 40 l/min."""
    rng, records = np.random.default_rng(_SEED), []
    whole = sweep()
    for low, high in _RANGES:
        kept = (whole["alphaCMD"] >= low) & (whole["alphaCMD"] <= high)
        values = np.column_stack([whole["alphaCMD"][kept], whole["Q"][kept] + _NOISE * rng.standard_normal(kept.sum())])
        time = whole.time[kept] - whole.time[kept][0]
        data = Record(time, values, ("alphaCMD", "Q"), ("%", "m3/s"), origin="simulated")
        records.append(MeasuredRecord(f"{low:g} to {high:g} %", "stochastic", "fit", data))
    signals = (
        MeasuredSignal("alphaCMD", "input", "%", "command", "alphaCMD"),
        MeasuredSignal("Q", "output", "m3/s", "flow", "Q", noise=_NOISE),
    )
    return Dataset("flow", "steady flow without load, two flow meters", "pump", signals, tuple(records))


@cache
def fitted(*names: str) -> Fit:
    """Some of the parameters from the logs; the others held at 1450 rpm, the whole stroke and 71 cm3."""
    free = [Parameter(name, start=s, lower=low, upper=high) for name, (s, low, high) in FREE.items() if name in names]
    fixed = {name: value for name, value in HELD.items() if name not in names}
    return fit(problem(model(), [logged()], free, fixed=fixed))


def end_of_rise(record: Record) -> float:
    """The command in % from which on the flow grows less than half as fast as in the mean; 100 if it never does."""
    command, flow = record["alphaCMD"], record["Q"]
    slope = np.gradient(flow, command)
    slow = np.flatnonzero((slope < 0.5 * np.median(slope)) & (command > command[0] + 1.0))
    return float(command[slow[0]]) if slow.size else 100.0


def contact(record: Record) -> float:
    """The command in % from which on the end stop pushes, 100 if it never does."""
    pushes = np.flatnonzero(np.abs(record["f_stop"]) > _TOUCH)
    return float(record["alphaCMD"][pushes[0]]) if pushes.size else 100.0
