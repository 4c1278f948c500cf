"""Inputs that are no numbers, or far beyond anything: an error, or values that are numbers."""

from pathlib import Path

import fmpy
import numpy as np
import pytest
from fmpy.fmi1 import FMICallException

from fmu_build import build
from pysim.fmu_check.instance import CallFailed, Instance, opened
from pysim.fmu_check.subject import CO_SIMULATION, MODEL_EXCHANGE, Subject, read_subject, references
from pysim.io import read_model
from pysim.simulate import Rk45, Rodas, Solver, simulate
from pysim.types import BadInput, Experiment, Outcome, Signal, SimulationError

COMMAND = "alphaCMD"
PUMP = "HydraulicTestBench.Pump.FreeGreyBox"
KINDS = [(fmi, kind) for fmi in (2, 3) for kind in (MODEL_EXCHANGE, CO_SIMULATION)]
FAR = (1e40, -1e40, 1e300)


def pump(fmi: int) -> Path:
    return Path(build(PUMP, fmi=fmi))


def seen(subject: Subject, instance: Instance) -> np.ndarray:
    """Outputs and derivatives after some way; raises CallFailed where the FMU reports an error."""
    if instance.kind == CO_SIMULATION:
        for step in range(3):
            instance.raw.doStep(subject.start + 0.01 * step, 0.01)
        return instance.get(references(subject.shown))
    return np.concatenate([instance.dx, instance.get(references(subject.shown))])


@pytest.mark.parametrize(("fmi", "kind"), KINDS)
@pytest.mark.parametrize("value", [np.nan, np.inf, -np.inf])
def test_no_number_is_refused_and_the_fmu_goes_on(fmi: int, kind: str, value: float) -> None:
    subject = read_subject(pump(fmi))
    row = references(subject.inputs)[:1]
    with opened(subject, kind) as instance:
        instance.start()
        with pytest.raises(CallFailed, match="error"):
            instance.set(row, [value])
        assert instance.get(row) == [0.0]


@pytest.mark.parametrize(("fmi", "kind"), KINDS)
@pytest.mark.parametrize("value", FAR)
def test_a_value_far_beyond_gives_an_error_or_numbers(fmi: int, kind: str, value: float) -> None:
    subject = read_subject(pump(fmi))
    with opened(subject, kind) as instance:
        instance.start()
        try:
            instance.set(references(subject.inputs)[:1], [value])
            found = seen(subject, instance)
        except CallFailed:
            return
        assert np.isfinite(found).all()


@pytest.mark.parametrize("fmi", [2, 3])
@pytest.mark.parametrize("kind", ["ModelExchange", "CoSimulation"])
@pytest.mark.parametrize("value", [np.nan, np.inf, -np.inf, 1e40, -1e40])
def test_another_importer_gets_an_error_and_never_a_value(fmi: int, kind: str, value: float) -> None:
    command = np.array(
        [(0.0, 0.0), (0.01, 0.0), (0.01, value), (1.0, value)], dtype=[("time", float), (COMMAND, float)]
    )
    run = {"output_interval": 0.01, "input": command, "output": [COMMAND], "logger": lambda *said: None}
    with pytest.raises((FMICallException, RuntimeError), match=r"failed with status|CVode error"):
        fmpy.simulate_fmu(str(pump(fmi)), fmi_type=kind, start_time=0, stop_time=0.05, **run)


@pytest.mark.parametrize("value", [1e40, -1e40])
def test_a_simulation_ends_there_or_gives_numbers(value: float) -> None:
    model = read_model(pump(2))
    command = {COMMAND: Signal.steps([0.0, 0.005], [0.0, value])}
    failed = False
    try:
        record = simulate(model, Experiment(np.linspace(0.0, 0.03, 4), ("alphaPercent",), command))
    except (BadInput, SimulationError):
        failed = True
    assert failed or np.isfinite(record.values).all()


@pytest.mark.parametrize("solver", [Rk45(), Rodas()])
@pytest.mark.parametrize("value", [1e300, -1e300])
def test_a_constant_beyond_all_numbers_ends_within_a_million_steps(value: float, solver: Solver) -> None:
    command = {COMMAND: Signal.steps([0.0], [value])}
    record = simulate(
        read_model(pump(2)), Experiment([0.0, 1.0], ("alphaPercent",), command), solver=solver, check=False
    )
    assert record.outcome in (Outcome.TOO_MANY_STEPS, Outcome.NOT_FINITE)
    assert record.statistics["steps"] <= 1_000_000
