"""Cost of a co-simulation step: our master, a plain FMPy loop, libcosim; the same FMI 2 FMUs and wires.

Two systems: the test bench under its controllers (three FMUs, of which the rig has most to compute), and a mass on a
spring (two FMUs with next to nothing to compute, so that the masters themselves show). CPU time of all threads, the
least of several turns in which the masters take turns, without start and end.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from importlib.util import find_spec
from pathlib import Path

import numpy as np
from fmpy.fmi2 import FMU2Slave

import fmu_build
from pysim.cosim import Connection, Run, System
from pysim.cosim.members import Fmu
from pysim.io import extracted, read_model
from pysim.types import Experiment, Model
from validation.findings import Finding
from validation.libcosim import bench
from validation.libcosim.case import MISSING

_TURNS, _STEPS = 5, 3000
_PAIR = Path(bench.__file__).parent / "Pair.mo"


@dataclass(frozen=True)
class Wired:
    """FMUs by name, the inputs and parameters that are set, and (output, input) of each wire."""

    about: str
    models: Mapping[str, Model]
    starts: Mapping[str, Mapping[str, float]]
    wires: Sequence[tuple[str, str]]


@cache
def systems() -> tuple[Wired, ...]:
    """Much and little to compute."""
    pair = {
        name: read_model(fmu_build.build(f"Pair.{kind}", libraries=[_PAIR]))
        for name, kind in (("mass", "Mass"), ("spring", "Spring"))
    }
    return (
        Wired("test bench", bench.models(), bench.STARTS, bench.WIRES),
        Wired("mass and spring", pair, {}, (("mass.v", "spring.v"), ("spring.F", "mass.F"))),
    )


def run() -> Iterator[Finding]:
    """The claim on this machine, as it is busy now; libcosim's figure stands beside it."""
    for wired in systems():
        masters = [_ours, _plain] + ([_libcosim] if find_spec("libcosimpy") else [])
        turns = [[master(wired) for master in masters] for _ in range(_TURNS)]
        best = 1e6 * np.min(turns, axis=0) / (_STEPS * len(wired.models))  # microseconds per step and member
        text = f"{wired.about}: {best[0]:.2f} us a step and member"
        yield Finding(f"{text}, of a plain FMPy loop's {best[1]:.2f} us", best[0] / best[1], 1.0, "")
        if len(best) < 3:
            yield Finding(f"{wired.about}: beside libcosim", float("nan"), 2.0, "", skipped=MISSING)
        else:
            yield Finding(f"{text}, of libcosim's {best[2]:.2f} us", best[0] / best[2], 2.0, "")


def _ours(wired: Wired) -> float:
    """CPU time in s, as of the other two."""
    members = tuple(Fmu(n, m, parameters=wired.starts.get(n, {}), feedthrough="none") for n, m in wired.models.items())
    system = System(members, tuple(Connection(*wire) for wire in wired.wires))
    experiment = Experiment(np.array([0.0, _STEPS * bench.STEP]), tuple(system.outputs))
    with Run(system, experiment, step=bench.STEP) as run:
        begun = time.process_time()
        run.advance()
        return time.process_time() - begun


def _plain(wired: Wired) -> float:
    """A loop as one writes it: read all, write what is wired, step all."""
    fmus = {name: _slave(name, model, wired.starts.get(name, {})) for name, model in wired.models.items()}
    models = wired.models
    reads = {name: [models[name][port].reference for port in bench.output_names(models[name])] for name in fmus}
    places = {(n, port): k for n in fmus for k, port in enumerate(bench.output_names(models[n]))}
    ends = [(*start.split(".", 1), *end.split(".", 1)) for start, end in wired.wires]
    wires = [(start, places[start, port], end, [models[end][target].reference]) for start, port, end, target in ends]
    begun = time.process_time()
    for step in range(_STEPS):
        values = {name: fmu.getReal(reads[name]) for name, fmu in fmus.items()}
        for start, place, end, reference in wires:
            fmus[end].setReal(reference, [values[start][place]])
        for fmu in fmus.values():
            fmu.doStep(step * bench.STEP, bench.STEP)
    took = time.process_time() - begun
    for fmu in fmus.values():
        fmu.freeInstance()
    return took


def _slave(name: str, model: Model, starts: Mapping[str, float]) -> FMU2Slave:
    stepping = model.abilities.stepping
    assert stepping is not None
    fmu = FMU2Slave(
        guid=model.token,
        modelIdentifier=stepping.library,
        unzipDirectory=str(extracted(model.path)),
        instanceName=name,
    )
    fmu.instantiate()
    fmu.setReal([model[variable].reference for variable in starts], list(starts.values()))
    fmu.setupExperiment(startTime=0.0)
    fmu.enterInitializationMode()
    fmu.exitInitializationMode()
    return fmu


def _libcosim(wired: Wired) -> float:
    from validation.libcosim import peer

    make: Callable[..., peer.Peer] = peer.wired
    execution = make(wired.models, wired.starts, wired.wires, bench.STEP)
    return execution.cpu_seconds(_STEPS)
