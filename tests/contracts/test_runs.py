"""Runs of every model: known answers, start values, and agreement between the ways to run it."""

import itertools

import numpy as np
import pytest
from fmpy import simulate_fmu

from tests.cases import CASES, Answer, Case
from tests.contracts.fmu import Fmu


def reals(fmu: Fmu) -> list[str]:
    """What is compared: states and continuous outputs."""
    return list(dict.fromkeys([*fmu.states, *fmu.of(causality="output", variability="continuous")]))


def sizes(fmu: Fmu, names: list[str], values: np.ndarray) -> np.ndarray:
    nominal = [float(fmu.variables[name].nominal or 1.0) for name in names]
    return np.maximum(np.abs(values).max(axis=0), nominal)


def stepped(fmu: Fmu, case: Case, names: list[str], times: np.ndarray, tolerance: float = 1e-8) -> np.ndarray:
    """Co-simulation from communication point to communication point: values (n_t, n)."""
    with fmu.open("cs") as instance:
        instance.start(case.settings, tolerance=tolerance)
        rows = [instance.get(names)]
        for time, later in itertools.pairwise(times):
            instance.step(time, later - time)
            rows.append(instance.get(names))
    return np.array(rows)


# Model exchange by FMPy's CVODE and co-simulation, both at a tolerance of 1e-8, relative to a variable's size.
AGREEMENT = 1e-4
ANSWERS = [(case, answer) for case in CASES for answer in case.answers]


@pytest.mark.parametrize(
    ("case", "answer"), ANSWERS, ids=[f"{case.name}-{answer.variable}-{answer.time:.2g}" for case, answer in ANSWERS]
)
def test_known_answers(fmu: Fmu, case: Case, answer: Answer) -> None:
    with fmu.open("cs") as instance:
        instance.start(case.settings, tolerance=1e-9)
        if answer.time > 0:
            instance.step(0.0, answer.time)
        (found,) = instance.get([answer.variable])
    assert found == pytest.approx(answer.value, abs=answer.tolerance)


def test_the_communication_step_does_not_matter(fmu: Fmu, case: Case) -> None:
    names = reals(fmu)
    random = np.random.default_rng(4)
    uneven = np.sort(random.uniform(0, case.stop, 40))
    ends = [
        stepped(fmu, case, names, times)[-1]
        for times in (np.array([0, case.stop]), np.linspace(0, case.stop, 11), np.array([0, *uneven, case.stop]))
    ]
    size = sizes(fmu, names, np.array(ends))
    # each run is right to about the tolerance, 1e-8, times what its errors grow to
    assert (np.ptp(ends, axis=0) <= 1e-5 * size).all()


def test_model_exchange_and_co_simulation_agree(fmu: Fmu, case: Case) -> None:
    names = reals(fmu)
    common = {
        "stop_time": case.stop,
        "output_interval": case.stop / 50,
        "start_values": dict(case.settings),
        "output": names,
        "relative_tolerance": 1e-8,
    }
    exchange = simulate_fmu(str(fmu.folder), fmi_type="ModelExchange", solver="CVode", **common)
    times = np.linspace(0, case.stop, 51)
    mine = stepped(fmu, case, names, times)
    size = sizes(fmu, names, mine)
    for k, name in enumerate(names):
        theirs = np.interp(times, exchange["time"], exchange[name])
        assert np.abs(theirs - mine[:, k]).max() <= AGREEMENT * size[k], name


def test_start_values_and_parameters_are_obeyed(fmu: Fmu, case: Case) -> None:
    settable = [
        v
        for v in fmu.description.modelVariables
        if v.initial == "exact" and v.variability != "constant" and v.type in ("Real", "Float64")
    ]
    with fmu.open("me") as probe:
        probe.start(case.settings)
        starts = probe.get([v.name for v in settable])
    for variable, start in zip(settable, starts, strict=True):
        value = start * (1 + 1e-6) or 1e-9
        with fmu.open("me") as instance:
            instance.begin({**case.settings, variable.name: value})
            assert instance.get([variable.name])[0] == value, variable.name


def test_declared_start_values_are_the_ones_used(fmu: Fmu) -> None:
    """What the XML says is what an instance begins with."""
    declared = {v.name: v.start for v in fmu.description.modelVariables if v.start is not None}
    numbers = {"true": 1.0, "false": 0.0}
    with fmu.open("me") as instance:
        values = instance.begin().get(declared)
    assert list(values) == [numbers[s] if s in numbers else float(s) for s in declared.values()]
