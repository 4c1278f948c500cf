"""The thesis' numbers of flow and ripple, from a calculation of its own and from the FMU."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache

import numpy as np

import fmu_build
from pysim.io import read_model
from pysim.simulate import Rodas, simulate
from pysim.types import Experiment, Record
from validation.findings import Finding
from validation.pump_flow.kinematics import LITRES, SPEED, Geometry

FLOWS = "HydraulicTestBench.Validation.PumpFlow"
STEADY = "HydraulicTestBench.Examples.SteadyFlow"
TOPS = {7: 1.006, 8: 2.937, 9: 0.6392, 10: 1.891, 13: 0.349}  # l/min above the mean
REVOLUTION = 2 * np.pi / SPEED


@cache
def turned(pistons: int = 9) -> Record:
    """One revolution of the three descriptions of the flow, at 1450 rpm and 15 degrees."""
    model = read_model(fmu_build.build(FLOWS, overrides={"N_p": pistons}))
    names = ("kinematic.theta", "kinematic.QPA", "kinematic.QPB", "kinematic.DQPA", "kinematic.DQPB")
    recorded = (*names, "simplified.DQPA", "mean.QPA", "r_0")
    return simulate(model, Experiment(np.linspace(0, REVOLUTION, 7201), recorded), solver=Rodas(rtol=1e-8, atol=1e-8))


@cache
def swept() -> Record:
    """The command slowly from stop to stop."""
    names = ("pump.alphaCMD", "pump.alphaPercent", "pump.QActual", "Q_theory")
    model = read_model(fmu_build.build(STEADY))
    return simulate(model, Experiment(np.linspace(0, 100, 4001), names), solver=Rodas(rtol=1e-7, atol=1e-7))


def run() -> Iterator[Finding]:
    """Known answers, the FMU at every angle of the shaft, and the stop."""
    pump = Geometry()
    top, spike = pump.ripple()
    for what, found, printed, digits, unit in (
        ("mean flow", pump.mean * LITRES, 102.95, 2, "l/min"),
        ("r_0", pump.r_0 * 1e3, 44.44, 2, "mm"),
        ("spike below the mean", -spike * LITRES, -2.04, 2, "l/min"),
        ("psi", top / (spike * (1 - 2 / np.pi)), 0.8634, 4, ""),
        *((f"top with {n} pistons", Geometry(n).ripple()[0] * LITRES, value, 4 if n == 9 else 3, "l/min")
          for n, value in TOPS.items()),
    ):  # fmt: skip
        own = what not in ("mean flow", "top with 9 pistons")  # all but these two are not printed in the thesis
        text = f"{what}: {found:.5g}, off {printed} by"
        yield Finding(text, abs(found - printed), 0.5 * 10.0**-digits, unit, regression=own)
    for pistons in TOPS:
        yield _fmu(pistons)
    yield from _stop()


def _fmu(pistons: int) -> Finding:
    """Away from where a port opens or closes within a sample."""
    record, pump = turned(pistons), Geometry(pistons)
    pitch = np.pi / pistons if pistons % 2 else 2 * np.pi / pistons
    phase = np.mod(record["kinematic.theta"] - pump.opens, pitch)
    clear = np.minimum(phase, pitch - phase) > 1e-6
    exact = pump.flow(record["kinematic.theta"][clear], pump.largest)[0]
    off = np.abs(record["kinematic.QPA"][clear] - exact).max() / pump.mean
    return Finding(f"FMU against the calculation over a revolution, {pistons} pistons", float(off), 1e-8, "of the mean")


def _stop() -> Iterator[Finding]:
    record = swept()
    flow, theory = record["pump.QActual"], record["Q_theory"]
    share = 100 * float(flow.max()) / Geometry().mean
    exact = 100 * np.rad2deg(np.arctan(0.95 * np.tan(np.deg2rad(15)))) / 15
    yield Finding(f"steady flow ends at {share:.2f} percent, off the stop by", abs(share - exact), 0.1, "percent")
    inside = np.abs(record["pump.alphaCMD"]) < 94
    off = 100 * float(np.abs(flow - theory)[inside].max()) / Geometry().mean
    yield Finding("steady flow off the theoretical one before the stop", off, 0.5, "percent of the largest")
