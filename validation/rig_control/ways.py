"""FMI 2 and 3, both interfaces, three sampling times, against the model with the controllers inside."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pysim.cosim import cosimulate
from pysim.rig import HeaveTest, StepTest, rig_member, rig_system
from pysim.simulate import Rodas, simulate
from pysim.types import Experiment, Record, Signal
from validation.findings import Finding
from validation.rig_control.experiments import model

Array = NDArray[np.float64]

FINE = Rodas(rtol=1e-8, atol=1e-8)
CONTINUOUS, SAMPLED = ("rig.omega", "rig.pL", "rig.pS"), ("speed.alphaCMD", "load.u_ref")
DTS = (1e-4, 1e-3, 1e-2)
INTERFACES = ("model-exchange", "co-simulation")
DRUM = 0.03  # m, Data.Crane
_TEST = StepTest("load", 40e5, speed=30.0, at=1.5, length=1.5)
_TIMES = np.arange(301, dtype=np.float64) * 1e-2
_TOLERANCE = {"model-exchange": 1e-6, "co-simulation": 1e-5}  # of the largest value; the FMU's own solver has 1e-6
_IN_WAVES = {"model-exchange": 1e-6, "co-simulation": 5e-3}  # stick and slip lets the latter's error grow


def run() -> Iterator[Finding]:
    """Each way against the monolithic model at its sampling time; then what is left between sampling times."""
    speed, load = _TEST.reference("speed"), _TEST.reference("load")
    whole = {dt: _monolithic(speed, load, dt, _TIMES) for dt in DTS}
    for fmi in (2, 3):
        for way in INTERFACES:
            runs = {dt: _coupled(speed, load, fmi, way, dt, _TIMES) for dt in DTS}
            for dt, record in runs.items():
                yield from _against(f"FMI {fmi} {way}, {1e3 * dt:g} ms", record, whole[dt], way)
            yield from _between(f"FMI {fmi} {way}", runs, whole)
    yield from _in_waves()


def _against(named: str, record: Record, whole: Whole, way: str) -> Iterator[Finding]:
    off = max(_share(record[n] - whole.rows[n], whole.rows[n]) for n in CONTINUOUS)
    yield Finding(
        f"{named}: continuous parts off the monolithic model", off, _TOLERANCE[way], "of the largest", regression=True
    )
    near = max(_nearest(record[n], whole.after[n], whole.before[n]) for n in SAMPLED)
    yield Finding(f"{named}: commands off it, to one sample", near, _TOLERANCE[way], "of the largest", regression=True)


def _between(named: str, runs: Mapping[float, Record], whole: Mapping[float, Whole]) -> Iterator[Finding]:
    """The sampled controllers alone explain what 0.1, 1 and 10 ms differ by."""
    fine = DTS[0]
    for coarse in DTS[1:]:
        inside = whole[coarse].rows["rig.pL"] - whole[fine].rows["rig.pL"]
        coupled = runs[coarse]["rig.pL"] - runs[fine]["rig.pL"]
        claim = (
            f"{named}: load pressure at {1e3 * coarse:g} ms differs from that at 0.1 ms by up to "
            f"{np.abs(coupled).max() / 1e5:.2f} bar; not explained by the sampling"
        )
        yield Finding(claim, _share(coupled - inside, inside), 1e-3, "of it", regression=True)


def _in_waves() -> Iterator[Finding]:
    """Twenty seconds of heave with stick and slip, where small differences could grow."""
    speed, load = _drum_speed(HeaveTest(length=20.0)), Signal.lines([0.0, 1.0], [0.0, 105e5])
    times = np.arange(2301, dtype=np.float64) * 1e-2
    whole = _monolithic(speed, load, 1e-3, times).rows
    for way in INTERFACES:
        record = _coupled(speed, load, 2, way, 1e-3, times)
        off = max(_share(record[n] - whole[n], whole[n]) for n in CONTINUOUS)
        claim = f"20 s of heave with stick and slip, {way}: continuous parts off the monolithic model"
        yield Finding(claim, off, _IN_WAVES[way], "of the largest", regression=True)
        late = np.abs(record["rig.omegaS"] - whole["rig.omegaS"]) > _IN_WAVES[way] * np.abs(whole["rig.omegaS"]).max()
        longest = int(np.diff(np.flatnonzero(np.diff(np.concatenate([[0], late, [0]])))).max(initial=0))
        claim = f"{way}: rows in a row, 10 ms apart, whose pulses have another sign than the monolithic model's"
        yield Finding(claim, longest, 1, "", regression=True)


@dataclass(frozen=True)
class Whole:
    """The model with its controllers inside: at the rows, and half a sample after and before them."""

    rows: Record
    after: Record
    before: Record


def _monolithic(speed: Signal, load: Signal, dt: float, times: Array) -> Whole:
    def at(rows: Array) -> Record:
        names = (*CONTINUOUS, "rig.omegaS", *SAMPLED)
        run = Experiment(rows, names, {"omegaS_ref": speed, "pL_ref": load}, {"dt": dt})
        return simulate(model("LoadCircuit.SampledTestBench"), run, solver=FINE)

    return Whole(at(times), at(times + dt / 2), at(np.append(0.0, times[1:] - dt / 2)))


def _coupled(speed: Signal, load: Signal, fmi: int, way: str, dt: float, times: Array) -> Record:
    rig = rig_member(model("LoadCircuit.Rig", fmi), interface=way, solver=FINE)
    inputs = {"speed.reference": speed, "load.reference": load, "load.speed": speed}
    run = Experiment(times, (*CONTINUOUS, "rig.omegaS", *SAMPLED), inputs)
    return cosimulate(rig_system(rig, dt=dt), run, step=dt)


def _drum_speed(test: HeaveTest) -> Signal:
    """Reference of the speed, Eq. 5.50, as a signal of its own."""
    velocity = test.velocity()
    return Signal(velocity.starts, -velocity.cubics / DRUM, velocity.sines * np.array([-1 / DRUM, 1, 1, 1]))


def _share(difference: Array, of: Array) -> float:
    return float(np.abs(difference).max() / np.abs(of).max())


def _nearest(found: Array, after: Array, before: Array) -> float:
    """Off the nearer of the two samples that a row lies between."""
    off = np.minimum(np.abs(found - after), np.abs(found - before))
    return float(off.max() / np.abs(after).max())
