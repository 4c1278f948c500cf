"""The test bench under its two continuous controllers: three FMI 2 FMUs and four wires, for every master alike."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache

import numpy as np

import fmu_build
from pysim.cosim import Connection, Jacobi, System, SystemFile
from pysim.cosim.members import Fmu
from pysim.io import read_model
from pysim.types import Experiment, Model

STEP = 2.0**-9  # s, some 2 ms: a whole number of nanoseconds, in which libcosim counts, and exact in binary
STEPS = 1024

_CLASSES = {"rig": "Rig", "speed": "SpeedController", "load": "LoadController"}
# References: 60 rad/s and 30 bar from standstill. Constants, because libcosim gives an input no signal.
STARTS: Mapping[str, Mapping[str, float]] = {
    "rig": {"alphaCMD_t": 0.0},
    "speed": {"omegaS_ref": 60.0},
    "load": {"pL_ref": 30e5, "omegaS_ref": 60.0},
}
WIRES = (
    ("speed.NormalizeSignal", "rig.alphaCMD"),
    ("load.limit1", "rig.u_ref"),
    ("rig.omegaS", "speed.omegaS"),
    ("rig.pL", "load.pL"),
)


@cache
def models() -> Mapping[str, Model]:
    """The FMUs by their names in the system."""
    return {
        name: read_model(fmu_build.build(f"HydraulicTestBench.LoadCircuit.{kind}")) for name, kind in _CLASSES.items()
    }


def coupled() -> SystemFile:
    """The same for our master; outputs are what a step leaves, as libcosim takes them."""
    members = tuple(Fmu(n, m, parameters=STARTS[n], feedthrough="none") for n, m in models().items())
    system = System(members, tuple(Connection(*wire) for wire in WIRES))
    times = np.asarray(STEP * np.arange(STEPS + 1), dtype=np.float64)
    experiment = Experiment(times, tuple(system.outputs))
    return SystemFile("Test bench", system, experiment, STEP, Jacobi(), None)


def output_names(model: Model) -> tuple[str, ...]:
    """Of one FMU, in the order of its ports."""
    return tuple(v.name for v in model.variables if v.causality == "output")
