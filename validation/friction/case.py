"""Table 6.2 found again from the virtual bench: once through the whole chain, and many times for the intervals."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

import fmu_build
from pysim.bench import Logger, Plan, Sensor, SteppedSines, run_plan
from pysim.identify.friction import (
    FRICTION_NAMES,
    FRICTION_UNITS,
    FrictionFit,
    ShaftColumns,
    ShaftTest,
    filtered_samples,
    fit_friction,
    pulse_samples,
    pulse_speed,
    pulse_times,
    shaft_tests,
)
from pysim.io import read_model
from pysim.simulate import Rodas, simulate
from pysim.types import Experiment, MeasuredSignal, Model, Record, Signal
from validation.findings import Finding

Array = NDArray[np.float64]

TABLE_6_2 = dict(zip(FRICTION_NAMES, (13.8806, 8.3593, 14.8939, 54.8258), strict=True))
INERTIA = 0.0733  # kg.m2, Table 5.1
TORQUE_NOISE = 0.5  # N.m: pressures to 0.5 bar on a motor of 60 cm3
JITTER = 20e-6  # s: teeth to 1e-3 rad at 50 rad/s
SWING, LENGTH = 50.0, 60.0  # rad/s, s
DRAWS = 400


def run() -> Iterator[Finding]:
    """The chain, the intervals, and what the thesis' filter makes of the same log."""
    model = read_model(fmu_build.build("HydraulicTestBench.Mechanics.DrivenShaft"))
    yield from _through_the_bench(model)
    record, direction = _simulated(model)
    yield from _sensors_agree(record, direction)
    yield from _intervals_hold(record, direction)
    yield from _held_speed(record, direction)


def _through_the_bench(model: Model) -> Iterator[Finding]:
    """Plan, FMU, pulses by the FMU's events, noise, data set, fit."""
    signals = (
        MeasuredSignal("omega_ref", "input", "rad/s", "command", "omega_ref"),
        MeasuredSignal("T_s", "output", "N.m", "supply torque", "T_s", noise=TORQUE_NOISE),
        MeasuredSignal("omega_s", "output", "rad/s", "speed by pulses", "omega_s"),
    )
    tests = SteppedSines(
        "omega_ref", ("T_s", "omega_s"), ((0.0, SWING),), (1 / 120,), periods=1, least=120.0, most=120.0
    )
    plan = Plan("shaft", "slow swing", "shaft", tuple(Sensor(s) for s in signals), (tests,), Logger(((1, 250.0),)))
    data = run_plan(model, plan, seed=1, solver=Rodas(rtol=1e-7, atol=1e-7)).dataset
    columns = ShaftColumns("omega_s", "T_s")
    fit = fit_friction([pulse_samples(test, INERTIA) for test in shaft_tests(data, columns)])
    for name, unit in zip(FRICTION_NAMES[1:], FRICTION_UNITS[1:], strict=True):
        low, high = fit.intervals[name]
        claim = f"virtual bench, {name} of Table 6.2: distance from the truth in half widths of its interval"
        yield Finding(claim, abs(fit.parameters[name] - TABLE_6_2[name]) / ((high - low) / 2), 2.0, "")
        yield Finding(f"virtual bench, {name}: half width of its interval", (high - low) / 2, 0.01 * high, unit)
    yield from _bounded(fit)


def _bounded(fit: FrictionFit) -> Iterator[Finding]:
    """The steepness has a lower end only, and a true one."""
    yield Finding("the steepness r has no upper end (0: none)", float(np.isfinite(fit.intervals["r"][1])), 0.0, "")
    yield Finding("lower end of r", fit.intervals["r"][0], TABLE_6_2["r"], "s/rad")


def _simulated(model: Model) -> tuple[Record, Array]:
    """One swing without noise, 250 Hz, and the command whose sign the sensor takes."""
    command = Signal(np.zeros(1), np.zeros((1, 4)), np.array([[[SWING, 0.0, 2 * np.pi / LENGTH, 0.0]]]))
    times = np.arange(0.0, LENGTH, 0.004)
    experiment = Experiment(times, ("T_s", "theta", "omega", "omega_s"), {"omega_ref": command})
    return simulate(model, experiment, solver=Rodas(rtol=1e-7, atol=1e-7)), command.value(times)


def _sensors_agree(record: Record, direction: Array) -> Iterator[Finding]:
    edges = pulse_times(record.time, record["theta"], record["omega"])
    difference = np.abs(pulse_speed(edges, record.time, direction) - record["omega_s"])
    yield Finding("pulse sensor by events in the FMU and from the angle", float(difference.max()), 1e-4, "rad/s")


def _measured(record: Record, direction: Array, seed: int) -> ShaftTest:
    rng = np.random.default_rng(seed)
    edges = pulse_times(record.time, record["theta"], record["omega"])
    edges = np.sort(edges + rng.normal(0.0, JITTER, edges.size))
    torque = record["T_s"] + rng.normal(0.0, TORQUE_NOISE, record.time.size)
    return ShaftTest(f"draw {seed}", record.time, pulse_speed(edges, record.time, direction), torque)


def _intervals_hold(record: Record, direction: Array) -> Iterator[Finding]:
    """How often the 95 percent intervals hold the truth."""
    hits, claimed = np.zeros(4), 0
    for seed in range(DRAWS):
        fit = fit_friction([pulse_samples(_measured(record, direction, seed), INERTIA)])
        claimed += "r" not in fit.bounded
        ends = [(*fit.intervals[name], TABLE_6_2[name]) for name in FRICTION_NAMES]
        hits += [low <= truth <= high for low, high, truth in ends]
    cover = 100 * hits / DRAWS
    for name, share in zip(FRICTION_NAMES[1:], cover[1:], strict=True):
        yield Finding(f"{DRAWS} draws, {name}: cover {share:.1f} percent, from 95", abs(share - 95), 4.0, "percent")
    pooled = float(cover[1:].mean())
    yield Finding(f"{DRAWS} draws, pooled cover {pooled:.2f} percent, from 95", abs(pooled - 95), 2.0, "percent")
    yield Finding(f"{DRAWS} draws, r below its one-sided lower end", 100 - float(cover[0]), 5.0, "percent")
    yield Finding(f"{DRAWS} draws, r claimed with two ends", 100 * claimed / DRAWS, 1.0, "percent")


def _held_speed(record: Record, direction: Array) -> Iterator[Finding]:
    """Zero-phase filter and Eq. 6.1 on the held speed: a steepness that is the filter's."""
    test = _measured(record, direction, 0)
    upper, missing = [], []
    for cutoff in (1.0, 5.0, 20.0):
        fit = fit_friction([filtered_samples(test, INERTIA, cutoff_hz=cutoff)], weighted=False)
        upper.append(fit.intervals["r"][1])
        missing.append(abs(fit.parameters["tau_s"] - TABLE_6_2["tau_s"]))
    claim = "by filter at 1 Hz, the steepness comes with an upper end, wrongly below the truth"
    yield Finding(claim, upper[0], TABLE_6_2["r"], "s/rad")
    yield Finding(
        "by filter, stiction misses by at least 3 N.m at 1, 5 and 20 Hz, short by", 3 - min(missing), 0, "N.m"
    )
