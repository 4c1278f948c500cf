"""Illegal calls end in an error and a message, never in a crash."""

import ctypes
from collections.abc import Callable

import pytest
from fmpy.fmi1 import FMICallException

from tests.cases import BY_NAME, Case
from tests.contracts.fmu import Fmu, Instance

ERROR, DISCARD = 3, 2


def refused(instance: Instance, call: Callable[[], object]) -> None:
    """The call returns an error and says why."""
    before = len(instance.messages)
    with pytest.raises(FMICallException) as failure:
        call()
    assert failure.value.status == ERROR
    assert len(instance.messages) > before


BEFORE_START = {
    "me": {
        "time": lambda i: i.raw.setTime(1.0),
        "derivatives": lambda i: i.dx,
        "update": lambda i: i.iterate_events(),
        "continuous time": lambda i: i.raw.enterContinuousTimeMode(),
        "completed step": lambda i: i.raw.completedIntegratorStep(),
        "event mode": lambda i: i.raw.enterEventMode(),
        "exit": lambda i: i.raw.exitInitializationMode(),
        "terminate": lambda i: i.raw.terminate(),
    },
    "cs": {
        "step": lambda i: i.step(0.0, 0.1),
        "exit": lambda i: i.raw.exitInitializationMode(),
        "terminate": lambda i: i.raw.terminate(),
    },
}
WHILE_RUNNING = {
    "me": {
        "begin": lambda i: i.begin(),
        "exit": lambda i: i.raw.exitInitializationMode(),
        "update": lambda i: i.iterate_events(),
        "continuous time": lambda i: i.raw.enterContinuousTimeMode(),
        "time": lambda i: i.raw.setTime(float("nan")),
    },
    "cs": {
        "begin": lambda i: i.begin(),
        "exit": lambda i: i.raw.exitInitializationMode(),
        "backwards": lambda i: i.step(0.0, -0.1),
        "nowhere": lambda i: i.step(0.0, float("nan")),
        "not from here": lambda i: i.step(0.5, 0.1),
    },
}
KINDS = [(kind, name) for kind in ("me", "cs") for name in BEFORE_START[kind]]
# Which call is legal when does not depend on the model; what its variables allow does.
one_model = pytest.mark.parametrize("case", [BY_NAME["sampled"]], ids=["sampled"])
RUNNING_KINDS = [(kind, name) for kind in ("me", "cs") for name in WHILE_RUNNING[kind]]


@one_model
@pytest.mark.parametrize(("kind", "name"), KINDS)
def test_too_early(fmu: Fmu, kind: str, name: str) -> None:
    with fmu.open(kind) as instance:
        refused(instance, lambda: BEFORE_START[kind][name](instance))


@one_model
@pytest.mark.parametrize(("kind", "name"), RUNNING_KINDS)
def test_out_of_place(fmu: Fmu, case: Case, kind: str, name: str) -> None:
    with fmu.open(kind) as instance:
        instance.start(case.settings)
        refused(instance, lambda: WHILE_RUNNING[kind][name](instance))


@one_model
@pytest.mark.parametrize("kind", ["me", "cs"])
def test_after_the_end(fmu: Fmu, case: Case, kind: str) -> None:
    call = (lambda i: i.raw.setTime(1.0)) if kind == "me" else (lambda i: i.step(0.0, 0.1))
    with fmu.open(kind) as instance:
        instance.start(case.settings)
        instance.raw.terminate()
        refused(instance, lambda: call(instance))


@pytest.mark.parametrize("kind", ["me", "cs"])
def test_unknown_references_and_wrong_types(fmu: Fmu, case: Case, kind: str) -> None:
    real, boolean = ("getReal", "getBoolean") if fmu.fmi == 2 else ("getFloat64", "getBoolean")
    row = next(v.valueReference for v in fmu.description.modelVariables if v.type in ("Real", "Float64"))
    for function, reference in ((real, 10**6), (boolean, row), (boolean, 10**6)):
        with fmu.open(kind) as instance:
            instance.start(case.settings)
            refused(instance, lambda f=function, r=reference, i=instance: getattr(i.raw, f)([r]))


def test_calculated_variables_cannot_be_set(fmu: Fmu, case: Case) -> None:
    names = [v.name for v in fmu.description.modelVariables if v.initial == "calculated"]
    for name in names[:20]:
        if fmu.variables[name].type in ("Real", "Float64"):
            with fmu.open("me") as instance:
                refused(instance, lambda n=name, i=instance: i.set({n: 1.0}))


def test_fixed_parameters_cannot_change_during_a_run(fmu: Fmu, case: Case) -> None:
    for name in fmu.of(causality="parameter", variability="fixed"):
        with fmu.open("cs") as instance:
            instance.start(case.settings)
            refused(instance, lambda n=name, i=instance: i.set({n: 1.0}))


@one_model
def test_null_pointers(fmu: Fmu, case: Case) -> None:
    prefix, kind = (f"fmi{fmu.fmi}", "Real" if fmu.fmi == 2 else "Float64")
    extra = () if fmu.fmi == 2 else (1,)
    for verb in ("Get", "Set"):
        with fmu.open("me") as instance:
            instance.start(case.settings)
            function = getattr(instance.raw, f"{prefix}{verb}{kind}")
            refused(instance, lambda f=function, i=instance: f(i.raw.component, None, 1, None, *extra))


@one_model
@pytest.mark.parametrize("missing", range(4))
def test_a_step_needs_a_place_for_each_of_its_answers(fmu: Fmu, case: Case, missing: int) -> None:
    if fmu.fmi == 2:
        pytest.skip("a step of FMI 2 answers by its status alone")
    answers: list[object] = [ctypes.byref(ctypes.c_bool()) for _ in range(3)] + [ctypes.byref(ctypes.c_double())]
    with fmu.open("cs") as instance:
        instance.start(case.settings)
        step = instance.raw.fmi3DoStep
        step(instance.raw.component, 0.0, 0.01, True, *answers)
        answers[missing] = None
        refused(instance, lambda: step(instance.raw.component, 0.01, 0.01, True, *answers))


@one_model
def test_no_instance(fmu: Fmu) -> None:
    with fmu.open("me") as instance, pytest.raises(FMICallException) as failure:
        instance.raw._call(f"fmi{fmu.fmi}Terminate", None)
    assert failure.value.status == ERROR


@one_model
def test_another_models_token(fmu: Fmu) -> None:
    with fmu.open("me") as instance:
        instance.raw.guid = "{other}"
        with pytest.raises(Exception, match=r"(?i)instantiate"):
            instance._instantiate({})


def test_reset_after_an_error(fmu: Fmu, case: Case) -> None:
    with fmu.open("me") as instance:
        refused(instance, lambda: instance.raw.setTime(1.0))
        instance.raw.reset()
        instance.start(case.settings)
        assert len(instance.dx) == len(fmu.states)
