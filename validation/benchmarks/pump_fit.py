"""The fit whose cost is measured: 13 parameters of the pump, 342 stepped sines, two stochastic waves of 20 s."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache

import numpy as np
from fmpy import instantiate_fmu, read_model_description, simulate_fmu

import fmu_build
from pysim.identify.greybox import Effort, Parameter, Problem, Simulation, fit, problem
from pysim.io import extracted, read_model
from pysim.thesis import FREQUENCIES_HZ, pump_model
from pysim.types import Dataset, Fit, FitOutcome, Model, Record
from validation.benchmarks.native_loop import CLASS, CVODE_TOLERANCE, experiments, run_fmpy
from validation.virtual_pump import measured, noise_free

NAMES = ("omega_v", "zeta_v", "L", "A_p", "V_0", "m_eff", "k", "b", "K_p", "K_D", "T_d", "K_L", "tau")
TESTS = tuple((sign * o, a) for sign in (1, -1) for o in (25.0, 50.0, 75.0) for a in (5.0, 10.0, 20.0))
WAVES = ((1, 20.0, "fit"), (2, 20.0, "fit"))
TRUTH = {"K_L": 2e-7}
OFF, SEED = 0.3, 5  # share of each value that the start is off; of the draw
_SMALL_WAVES = ((1, 3.0, "fit"),)
_NOISE = 0.03  # by which residual over noise may differ from 1 where the fit is a good one
_COLUMNS = [("time", np.float64), ("alphaCMD", np.float64)]


@cache
def dataset(tests: Sequence[tuple[float, float]] = TESTS) -> Dataset:
    """The whole measurements, or those of some of the tests, with both waves; seeded noise."""
    return measured(noise_free(pump_model("free"), TRUTH, tests, FREQUENCIES_HZ, WAVES), SEED)


def task(data: Dataset) -> Problem:
    """From thirty percent off each truth."""
    model = pump_model("free")
    return problem(model, [data], starts(model))


def starts(model: Model) -> list[Parameter]:
    """Thirty percent up or down, within the bounds; the nominal start is not tried, being the truth."""
    rng = np.random.default_rng(SEED)
    free = []
    for name in NAMES:
        variable = model[name]
        value = float(TRUTH.get(name, variable.start or 0.0)) * (1 + OFF * float(rng.choice([-1.0, 1.0])))
        free.append(Parameter(name, start=float(np.clip(value, variable.min, variable.max))))
    return free


def whole_fit(data: Dataset, simulation: Simulation | None = None) -> Fit:
    """Everything from a data set to intervals and comparisons.

    Raises:
        RuntimeError: it does not converge, or leaves more than the noise: then its time means nothing.
    """
    found = fit(task(data), effort=Effort(nominal=False), simulation=simulation)
    if found.outcome is not FitOutcome.CONVERGED or abs(found.misfit - 1) > _NOISE:
        raise RuntimeError(f"the fit that is timed ended at {found.misfit:.3f} times the noise: {found.message}")
    return found


def warm_up() -> None:
    """A small fit: what is compiled or loaded once on a machine counts in no measurement."""
    clean = noise_free(pump_model("free"), TRUTH, TESTS[:1], FREQUENCIES_HZ[::6], _SMALL_WAVES)
    fit(task(measured(clean, SEED)), effort=Effort(nominal=False))


def one_evaluation_by_fmpy(data: Dataset) -> None:
    """The same objective once by FMPy's CVODE: sines that the model commands itself, waves whose command is a table."""
    run_fmpy(read_model(fmu_build.build(CLASS)), experiments())
    model = pump_model("free")
    folder = str(extracted(model.path))
    description = read_model_description(folder, validate=False)
    fmu = instantiate_fmu(folder, description, fmi_type="ModelExchange")
    for wave in data.records[-len(WAVES) :]:
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
