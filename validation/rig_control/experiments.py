"""Runs of the rig that the case, its pictures and its numbers share."""

from __future__ import annotations

import time
from collections.abc import Iterator, Mapping
from functools import cache

import fmu_build
from pysim.control import CompensatedLoadController, LoadController
from pysim.control.tuning import TABLE_6_1
from pysim.cosim import System, cosimulate
from pysim.cosim.members import Fmu
from pysim.io import read_model
from pysim.rig import HeaveFigures, HeaveTest, StepTest, heave_figures, load_controllers, rig_member, rig_system
from pysim.types import Model, Record
from validation.findings import Finding

DT = 1e-3


@cache
def model(name: str, fmi: int = 2) -> Model:
    """A class of the library, built."""
    return read_model(fmu_build.build(f"HydraulicTestBench.{name}", fmi=fmi))


@cache
def step(test: StepTest) -> Record:
    """A step test under the thesis' controllers at 1 kHz."""
    return cosimulate(rig_system(rig_member(model("LoadCircuit.Rig")), dt=DT), test.experiment(), step=DT)


def crane_system(load: LoadController | CompensatedLoadController | None = None) -> System:
    """Crane, rig and two controllers at 1 kHz."""
    return rig_system(
        rig_member(model("LoadCircuit.Rig")), dt=DT, load=load, crane=Fmu("crane", model("Crane.IdealCompensation"))
    )


@cache
def heave(test: HeaveTest) -> Mapping[str, Record]:
    """Load controllers in the same wave: MATLAB's gains, the thesis', its valve turned round, more gain, both."""
    tuned = LoadController(DT, *TABLE_6_1["load"]["MATLAB tuned"])
    loads = {"MATLAB tuned": tuned, **load_controllers(DT)}
    return {label: cosimulate(crane_system(load), test.experiment(), step=DT) for label, load in loads.items()}


def heave_numbers(test: HeaveTest) -> Mapping[str, HeaveFigures]:
    """What each of the records is worth."""
    return {label: heave_figures(record, test) for label, record in heave(test).items()}


def cost(seconds: float = 30.0) -> Iterator[Finding]:
    """The whole rig with crane and two Python controllers at 1 kHz, a row every 2 ms; the best of three runs."""
    test = HeaveTest(length=seconds)
    system, experiment = crane_system(), test.experiment()
    span = float(experiment.times[-1])
    factors = []
    for _ in range(3):
        started = time.process_time()
        cosimulate(system, experiment, step=DT)
        factors.append(span / (time.process_time() - started))
    claim = (
        f"rig, crane and two Python controllers at 1 kHz: {max(factors):.0f} times faster than real time; short of 30"
    )
    yield Finding(claim, 30 - max(factors), 0.0, "")
