"""What a step costs, beside a plain loop over FMPy's calls with the same controllers."""

from __future__ import annotations

import time
from collections.abc import Iterator

import numpy as np
from fmpy.fmi2 import FMU2Slave
from numpy.typing import NDArray

from pysim.control import LoadController, SpeedController
from pysim.cosim import Run, System
from pysim.io import extracted
from pysim.types import Record
from validation.cosim.bench import CONTINUOUS, LOAD, SAMPLED, SPEED, STEP, TIMES, experiment, rig_model, system
from validation.findings import Finding

Array = NDArray[np.float64]

_TURNS = 7
_OUTPUTS = (*CONTINUOUS, *SAMPLED)


def plain_loop() -> tuple[Array, float]:
    """What somebody would write by hand: values (n_t, n_y), and CPU time of the loop in s."""
    model = rig_model(2)
    fmu = FMU2Slave(
        guid=model.token, modelIdentifier=model.abilities.library, unzipDirectory=str(extracted(model.path)),
        instanceName="rig",
    )  # fmt: skip
    fmu.instantiate()
    fmu.setupExperiment(startTime=0.0, stopTime=float(TIMES[-1]))
    fmu.enterInitializationMode()
    fmu.exitInitializationMode()
    values = _loop(fmu, {name: model[name].reference for name in (*_OUTPUTS, "alphaCMD_t")})
    fmu.terminate()
    fmu.freeInstance()
    return values


def _loop(fmu: FMU2Slave, reference: dict[str, int]) -> tuple[Array, float]:
    read = [reference[name] for name in _OUTPUTS]
    write = [reference[name] for name in ("alphaCMD", "u_ref", "alphaCMD_t")]
    speed, load = SpeedController(STEP), LoadController(STEP)
    speeds, loads = SPEED.value(TIMES).tolist(), LOAD.value(TIMES).tolist()
    rows = np.empty((TIMES.size, len(read)))
    begin = time.process_time()
    for number in range(TIMES.size):
        outputs = fmu.getReal(read)
        alpha, _ = speed.step(number * STEP, (speeds[number], outputs[3]))
        opening, _ = load.step(number * STEP, (loads[number], outputs[2], speeds[number]))
        fmu.setReal(write, [alpha, opening, 0.0])
        rows[number] = (*outputs[:4], alpha, opening)
        if number < TIMES.size - 1:
            fmu.doStep(number * STEP, STEP)
    return rows, time.process_time() - begin


def findings() -> Iterator[Finding]:
    """CPU times of all steps without start and end; the least of several turns, in which all kinds take turns."""
    own = {interface: system(2, interface) for interface in ("co-simulation", "model-exchange")}
    rows, _ = plain_loop()
    record, _ = coupled_loop(own["co-simulation"])
    worst = float((np.abs(rows - record.values).max(axis=0) / np.ptp(rows, axis=0)).max())
    yield Finding("a plain loop over the same FMU gives the same, largest difference", worst, 1e-6, "of the range")
    turns = [[plain_loop()[1], *(coupled_loop(whole)[1] for whole in own.values())] for _ in range(_TURNS)]
    plain, *costs = (min(turn[kind] for turn in turns) / (TIMES.size - 1) for kind in range(3))
    for interface, cost in zip(own, costs, strict=True):
        text = f"rig and two controllers, {interface}: {1e6 * cost:.1f} us a step"
        yield Finding(f"{text}, of real time", cost / STEP, 1 / 30, "")
        if interface == "co-simulation":
            yield Finding(f"{text}, of a plain FMPy loop's {1e6 * plain:.1f} us", cost / plain, 1.0, "")


def coupled_loop(whole: System) -> tuple[Record, float]:
    """The co-simulation, and CPU time of its steps in s."""
    with Run(whole, experiment(), step=STEP) as run:
        begin = time.process_time()
        run.advance()
        return run.record(), time.process_time() - begin
