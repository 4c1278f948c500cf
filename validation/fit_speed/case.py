"""A complete fit of 13 parameters, and one evaluation of the same objective by FMPy, in the same run."""

from __future__ import annotations

import os
import time
from collections.abc import Iterator

import numpy as np
from fmpy import instantiate_fmu, read_model_description, simulate_fmu

import fmu_build
from pysim.identify.greybox import Effort, Parameter, fit, problem
from pysim.io import extracted, read_model
from pysim.types import FitOutcome, MeasuredRecord, Model, Record
from validation.benchmarks.native_loop import CLASS, CVODE_TOLERANCE, experiments, run_fmpy
from validation.findings import Finding
from validation.pump import pump_model
from validation.thesis import FREQUENCIES_HZ
from validation.virtual_pump import measured, noise_free

NAMES = ("omega_v", "zeta_v", "L", "A_p", "V_0", "m_eff", "k", "b", "K_p", "K_D", "T_d", "K_L", "tau")
TESTS = tuple((sign * o, a) for sign in (1, -1) for o in (25.0, 50.0, 75.0) for a in (5.0, 10.0, 20.0))
WAVES = ((1, 20.0, "fit"), (2, 20.0, "fit"))
TRUTH = {"K_L": 2e-7}
_COLUMNS = [("time", np.float64), ("alphaCMD", np.float64)]
OFF, SEED, LIMIT = 0.3, 5, 60.0  # share of each value, of the draw, s on 2 cores


def run() -> Iterator[Finding]:
    """Time on this machine, as it is busy now."""
    model = pump_model("free")
    dataset = measured(noise_free(model, TRUTH, TESTS, FREQUENCIES_HZ, WAVES), SEED)
    started, used = time.perf_counter(), time.process_time()
    task = problem(model, [dataset], _starts(model))
    found = fit(task, effort=Effort(nominal=False))
    seconds, cpu = time.perf_counter() - started, time.process_time() - used
    started = time.perf_counter()
    _evaluate_by_fmpy(dataset.records[-2:])
    one = time.perf_counter() - started
    yield Finding("the search converged, off by", float(found.outcome is not FitOutcome.CONVERGED), 0, "")
    yield Finding("residual over noise is 1, off by", abs(found.misfit - 1), 0.03, "")
    title = f"complete fit: {seconds:.1f} s, {cpu:.1f} s of CPU time, {found.iterations} points, {os.cpu_count()} cores"
    yield Finding(title, seconds, LIMIT, "s")
    yield Finding(f"the fit over one evaluation by fmpy.simulate_fmu ({one:.1f} s)", seconds / one, 1.0, "")


def _starts(model: Model) -> list[Parameter]:
    """Thirty percent up or down, within the bounds; the nominal start is not tried, being the truth."""
    rng = np.random.default_rng(SEED)
    free = []
    for name in NAMES:
        variable = model[name]
        value = float(TRUTH.get(name, variable.start or 0.0)) * (1 + OFF * float(rng.choice([-1.0, 1.0])))
        free.append(Parameter(name, start=float(np.clip(value, variable.min, variable.max))))
    return free


def _evaluate_by_fmpy(waves: tuple[MeasuredRecord, ...]) -> None:
    """The 342 stepped sines, which the model commands itself, and the waves, whose command is a table."""
    run_fmpy(read_model(fmu_build.build(CLASS)), experiments())
    model = pump_model("free")
    folder = str(extracted(model.path))
    description = read_model_description(folder, validate=False)
    fmu = instantiate_fmu(folder, description, fmi_type="ModelExchange")
    for wave in waves:
        assert isinstance(wave.data, Record)
        fmu.reset()
        command = np.array(list(zip(wave.data.time, wave.data["alphaCMD"], strict=True)), dtype=_COLUMNS)
        simulate_fmu(
            folder,
            validate=False,
            stop_time=float(wave.data.time[-1]),
            solver="CVode",
            relative_tolerance=CVODE_TOLERANCE,
            output_interval=float(wave.data.time[1]),
            record_events=False,
            input=command,
            output=["alphaPercent", "u"],
            fmi_type="ModelExchange",
            model_description=description,
            fmu_instance=fmu,
        )
    fmu.freeInstance()
