"""Linear models from the thesis' table and from the FMU, energy over a minute, controllers at rest, speed."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

import fmu_build
from pysim.io import read_model
from pysim.simulate import Rodas, simulate
from pysim.types import Experiment, Signal
from validation.findings import Finding
from validation.load_circuit import linear
from validation.load_circuit.crane import crane_minute, pulses
from validation.load_circuit.linearised import Linear, linearised

Complex = NDArray[np.complex128]

OPEN = "HydraulicTestBench.LoadCircuit.OpenTestBench"
CLOSED = "HydraulicTestBench.LoadCircuit.TestBench"
ENERGY = "HydraulicTestBench.Validation.BenchEnergy"
WORKING_POINT = {  # Eq. 5.29, and the closed circuit above its refill pressure
    "spool.u": 0.1,
    "volume_LA.p": 155e5,
    "volume_LB.p": 155e5,
    "volume_sA.p": 60e5,
    "volume_sB.p": 60e5,
}
PERCENT = 100 / np.deg2rad(15)  # of the pump's command per rad
PLATE = tuple(f"plate.z[{i}]" for i in range(1, 6))
VALVE = ("spool.u", "spool.u_t")
LOAD, SUPPLY = ("volume_LA.p", "volume_LB.p"), ("volume_sA.p", "volume_sB.p")
HERTZ = np.geomspace(0.1, 60, 60)


@dataclass(frozen=True)
class Way:
    """A transfer function of the thesis, and where the FMU has it: what is kept, all else held as a disturbance."""

    name: str
    formula: Callable[[Complex], Complex]
    kept: tuple[str, ...]
    of: str
    output: Mapping[str, float]
    scale: float = 1.0

    def ratio(self, model: Linear, hertz: NDArray[np.float64] = HERTZ) -> Complex:
        """FMU over formula."""
        s = (2j * np.pi * hertz).astype(np.complex128)
        return model.response(s, self.kept, self.of, self.output) * self.scale / self.formula(s)


WAYS = (
    Way("Eq. 5.14", linear.load_pressure, (*VALVE, *LOAD), "u_ref", {LOAD[0]: 1.0, LOAD[1]: -1.0}),
    Way("Eq. 5.15", linear.load_speed, (*VALVE, *LOAD, "inertiaS.w"), "u_ref", {"inertiaS.w": -1.0}),
    Way("Eq. 5.27", linear.supply_pressure, (*PLATE, *SUPPLY), "alphaCMD", {SUPPLY[0]: 1.0, SUPPLY[1]: -1.0}, PERCENT),
    Way("Eq. 5.28", linear.supply_speed, (*PLATE, *SUPPLY, "inertiaS.w"), "alphaCMD", {"inertiaS.w": 1.0}, PERCENT),
)


def run() -> Iterator[Finding]:
    """Where the linear models hold, where they don't, and the whole bench."""
    yield from _agree()
    yield from _depart()
    yield from _whole()
    yield from crane_minute()
    yield from pulses()


def at_working_point() -> Linear:
    """The open bench at the working point of Eq. 5.29."""
    return _at({})


def _at(changes: Mapping[str, float]) -> Linear:
    return linearised(fmu_build.build(OPEN), {**WORKING_POINT, **changes}, {"alphaCMD": 0.0, "u_ref": 0.1})


def _agree() -> Iterator[Finding]:
    """Rounding of Table 5.1: K_P by 0.7 percent, K_qp by 0.9, K_qu by 0.2."""
    model = _at({})
    for way in WAYS:
        off = np.abs(way.ratio(model) - 1).max()
        yield Finding(f"{way.name} from Table 5.1 against the FMU, 0.1 to 60 Hz", 100 * float(off), 1.0, "percent")


def _depart() -> Iterator[Finding]:
    """Each simplification where it does not hold, against what it should then be."""
    pressure, _, supply, _ = WAYS
    # a valve that refills holds its side: only the other one moves, and the difference at half the rate
    refilled = np.abs(supply.ratio(_at({"volume_sB.p": 24.5e5}), np.array([1.0])))[0]
    yield Finding(
        f"Eq. 5.27 while one side is refilled: {refilled:.3f} of it, off half by", abs(refilled - 0.5), 0.02, ""
    )
    loaded = _at({"volume_LA.p": 205e5, "volume_LB.p": 105e5})
    gain = np.abs(pressure.ratio(loaded, np.array([50.0])))[0]
    expected = float(np.sqrt(210 / 310))
    yield Finding(
        f"Eq. 5.14 at 100 bar of load: {gain:.3f}, off the root of 210/310 by", abs(gain - expected), 0.01, ""
    )
    states = {"rig.inertiaS.w": 10.0, "rig.volume_sA.p": 60e5, "rig.volume_sB.p": 60e5}
    shaft = linearised(fmu_build.build(CLOSED), states, {"omegaS_ref": 0.0})
    row = shaft.states.index("rig.inertiaS.w")
    slope = -0.0733 * shaft.a[row, row]
    law = -(54.8258 - 14.8939) / 8.3593 * np.exp(-10 / 8.3593)
    claim = f"slope of Eq. 5.38 at 10 rad/s is {slope:.2f} N.m.s/rad, not the c of 0.26; off its derivative by"
    yield Finding(claim, abs(slope - law), 0.01, "N.m.s/rad")


def _whole() -> Iterator[Finding]:
    """Steps of Section 6.4, and a minute of heave compensation."""
    model = read_model(fmu_build.build(CLOSED))
    inputs = {
        "omegaS_ref": Signal.lines([0, 0.1, 50], [0, 30, 30]),
        "pL_ref": Signal.lines([0, 0.1, 50], [0, 40e5, 40e5]),
    }
    rest = simulate(model, Experiment(np.array([40.0]), ("contOmega", "pL"), inputs), solver=Rodas())
    yield Finding("speed 40 s after a step to 30 rad/s: error", abs(float(rest["contOmega"][0]) - 30), 0.03, "rad/s")
    yield Finding("load pressure after a step to 40 bar: error", abs(float(rest["pL"][0]) / 1e5 - 40), 0.04, "bar")
    energy = read_model(fmu_build.build(ENERGY))
    names = ("error_s", "error_L", "error", "bench.rig.counter.count")
    minute = Experiment(np.arange(1.0, 60.001, 0.01), names)
    simulate(energy, minute, solver=Rodas())  # the first run loads and compiles
    started = time.process_time()
    record = simulate(energy, minute, solver=Rodas())
    factor = 60 / (time.process_time() - started)
    for name, what in zip(names, ("supply circuit", "load circuit", "shaft"), strict=False):
        off = 100 * float(np.abs(record[name]).max())
        yield Finding(f"energy balance of the {what} over a minute", off, 0.1, "percent of the work passed on")
    yield Finding(
        f"{record[names[3]][-1]:.0f} pulses; {factor:.0f} times faster than real time; short of 50",
        50 - factor,
        0,
        "",
    )
