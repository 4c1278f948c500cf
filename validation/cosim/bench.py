"""The rig's FMU under two Python controllers, against the same rig with the controllers inside."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache

import numpy as np
from numpy.typing import NDArray

import fmu_build
from pysim.cosim import Run, System, cosimulate
from pysim.io import read_model
from pysim.rig import rig_member, rig_system
from pysim.simulate import Rodas, simulate
from pysim.types import Experiment, Model, Record, Signal
from validation.findings import Finding

Array = NDArray[np.float64]

STEP = 1e-3  # s, of the controllers and of the communication
TIMES: Array = STEP * np.arange(0, 3001, dtype=np.float64)
SOLVER = Rodas(rtol=1e-7, atol=1e-7)
SPEED = Signal.lines([0.2, 0.5, 1.5, 2.0], [0.0, 60.0, 60.0, -40.0])  # rad/s
LOAD = Signal.steps([0.0, 1.0, 2.4], [0.0, 50e5, -20e5])  # Pa

# Name in the rig -> what it is; commands are the controllers' and change at their samples only.
CONTINUOUS = {"omega": "speed", "pS": "supply pressure", "pL": "load pressure"}
SAMPLED = {"omegaS": "speed by pulses", "alphaCMD": "pump command", "u_ref": "valve command"}
# Our solver steps the model exchange FMU just as it steps the monolithic one, from sample to sample; in co-simulation
# the FMU's own integrator has rtol 1e-6.
LIMITS = {"model-exchange": 1e-9, "co-simulation": 1e-4}


def experiment(times: Array = TIMES) -> Experiment:
    """Speed up, load on, through standstill and backwards."""
    inputs = {"speed.reference": SPEED, "load.speed": SPEED, "load.reference": LOAD}
    return Experiment(times, tuple(f"rig.{name}" for name in (*CONTINUOUS, *SAMPLED)), inputs)


def rig_model(fmi: int) -> Model:
    """The open rig."""
    return read_model(fmu_build.build("HydraulicTestBench.LoadCircuit.Rig", fmi=fmi))


def system(fmi: int, interface: str) -> System:
    """Rig and controllers."""
    return rig_system(rig_member(rig_model(fmi), interface=interface, solver=SOLVER))


@cache
def monolithic() -> Record:
    """One FMU with the controllers inside, by the native loop."""
    model = read_model(fmu_build.build("HydraulicTestBench.LoadCircuit.SampledTestBench"))
    names = tuple(f"rig.{name}" for name in (*CONTINUOUS, *SAMPLED))
    whole = Experiment(TIMES, names, {"omegaS_ref": SPEED, "pL_ref": LOAD})
    return simulate(model, whole, solver=SOLVER)


@cache
def coupled(fmi: int = 2, interface: str = "model-exchange") -> Record:
    """The co-simulation."""
    return cosimulate(system(fmi, interface), experiment(), step=STEP)


def findings() -> Iterator[Finding]:
    """Differences at the same communication point, of a signal's range; a sample's delay would show as 1e-2 or more."""
    known = monolithic()
    for fmi in (2, 3):
        for interface, limit in LIMITS.items():
            record = coupled(fmi, interface)
            for name, text in (CONTINUOUS | SAMPLED).items():
                worst = _difference(record[f"rig.{name}"], known[f"rig.{name}"], sign=name == "omegaS")
                claim = f"rig, FMI {fmi} {interface}: {text} against the monolithic model"
                yield Finding(claim, worst, limit, "of its range", regression=True)
    yield _late()
    yield _repeated()


def _difference(found: Array, known: Array, *, sign: bool) -> float:
    """Largest, at the same sample. The pulses' speed takes its sign from the command: by an event at the sample itself
    in the monolithic model, within the next step in co-simulation. With `sign` either of the two samples will do."""
    off = np.abs(found - known)
    if sign:
        off[1:] = np.minimum(off[1:], np.abs(found[1:] - known[:-1]))
    return float(off.max() / np.ptp(known))


def _late() -> Finding:
    """That the comparison would see one sample: the monolithic commands moved by one differ by more than the limit."""
    worst = min(
        np.abs(np.diff(monolithic()[f"rig.{name}"])).max() / np.ptp(monolithic()[f"rig.{name}"]) for name in SAMPLED
    )
    claim = "rig: limit of the comparison over what one sample more would make"
    return Finding(claim, 1e-4 / float(worst), 0.1, "", regression=True)


def _repeated() -> Finding:
    with Run(system(2, "co-simulation"), experiment(), step=STEP) as run:
        run.advance(1.234)
        kept = run.save()
        run.advance()
        first = run.record()
        run.restore(kept)
        run.advance()
        again = run.record()
    worst = float(np.abs(first.values - again.values).max())
    return Finding("rig: saved at 1.234 s and run on twice, largest difference", worst, 0.0, "", regression=True)
