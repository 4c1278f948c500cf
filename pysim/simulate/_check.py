"""Whether a model can do what an experiment asks: said before anything runs."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from pysim.simulate._library import REALS, settable_types
from pysim.simulate.kernel.functions import TYPES
from pysim.types import BadInput, Experiment, Model, Variable


def check_arguments(function: str, model: object, solver: object, needed: type | None = None) -> None:
    """Check that a model and a solver are what their names say; `needed` is the one solver that will do.

    Raises:
        BadInput: a file name in place of a model, a class in place of a solver, or another solver.
    """
    if not isinstance(model, Model):
        raise BadInput(f"{function}: model is {model!r}; give what pysim.io.read_model makes of an .fmu file")
    if isinstance(solver, type) or not hasattr(solver, "control"):
        raise BadInput(f"{function}: solver is {solver!r}; give a solver with its settings, as Rodas(rtol=1e-6)")
    if needed is not None and not isinstance(solver, needed):
        raise BadInput(
            f"{function}: the steps of {type(solver).__name__} cannot be differentiated; "
            f"give solver={needed.__name__}(...)"
        )


def check_list(function: str, argument: str, items: object, kind: type) -> None:
    """Check that there is a list (or tuple) of things of one kind.

    Raises:
        BadInput: one thing alone, or another thing among them.
    """
    if isinstance(items, kind) or not isinstance(items, Sequence):
        raise BadInput(f"{function}: {argument} is no list; write [{kind.__name__}(...), ...], also for a single one")
    for number, item in enumerate(items):
        if not isinstance(item, kind):
            raise BadInput(f"{function}: {argument}[{number}] is {item!r}; give {kind.__name__}(...)")


def check_experiment(model: Model, experiment: Experiment) -> None:
    """Check every name the experiment uses.

    Raises:
        BadInput: no Experiment, a name the model does not have, or one that cannot be driven, set or recorded.
    """
    if not isinstance(experiment, Experiment):
        raise BadInput(f"experiment: got {experiment!r}; give Experiment(...)")
    count = len(model.abilities.states)
    if experiment.offset.size not in (0, count):
        raise BadInput(f"{model.label}: an offset of {experiment.offset.size} numbers for {count} continuous states")
    for name in (*experiment.inputs, *experiment.rates):
        _check_input(model, model[name])
    for name, value in experiment.overrides.items():
        if name in experiment.inputs or name in experiment.rates:
            raise BadInput(f"experiment: {name} has a signal and an override; remove one of them")
        check_override(model, name, value)
    for name in experiment.record:
        if model[name].type not in TYPES[model.abilities.fmi]:
            raise BadInput(f"{model.label}: {name} is {model[name].type} and cannot be recorded; record a number")
    for name in model.abilities.states:
        if model[name].type not in ("Real", "Float64"):
            raise BadInput(f"{model.label}: state {name} is {model[name].type}; only scalar states can be simulated")


def check_experiments(model: Model, experiments: Sequence[Experiment]) -> None:
    """Check many; of those that name the same things, the names once.

    Raises:
        BadInput: as `check_experiment`.
    """
    known: dict[object, bool] = {}  # names -> whether all that are set are real, so that any finite number will do
    for experiment in experiments:
        if not isinstance(experiment, Experiment):
            check_experiment(model, experiment)
        used = tuple(experiment.inputs.keys()), tuple(experiment.rates.keys()), tuple(experiment.overrides.keys())
        names = experiment.record, experiment.offset.size, *used
        if not (known.get(names) and all(map(math.isfinite, experiment.overrides.values()))):
            check_experiment(model, experiment)
            known[names] = all(model[name].type in REALS for name in experiment.overrides)


def _check_input(model: Model, variable: Variable) -> None:
    if variable.causality != "input":
        inputs = ", ".join(v.name for v in model.variables if v.causality == "input") or "none"
        raise BadInput(f"{model.label}: {variable.name} is no input but {variable.causality}; inputs: {inputs}")
    if variable.type not in ("Real", "Float64") or variable.variability != "continuous":
        raise BadInput(
            f"{model.label}: input {variable.name} is {variable.variability} and {variable.type}; "
            "a signal can drive continuous real inputs only, set it as an override"
        )


def check_override(model: Model, name: str, value: float) -> None:
    """Check that a variable can be set to a value ahead of a run.

    Raises:
        BadInput: no such variable, one that cannot be set, or a value it cannot take.
    """
    why = _objection(model, model[name], value)
    if why:
        raise BadInput(f"{model.label}: {name} {why}")


def _objection(model: Model, variable: Variable, value: float) -> str:
    """Why a variable must not be set to a value, as the end of a sentence; empty if it may be."""
    if variable.type not in settable_types(model):
        return f"is {variable.type} and cannot be set to a number"
    fixed = variable.causality not in ("parameter", "input") and variable.start is None
    if fixed or variable.variability == "constant" or variable.causality == "structuralParameter":
        kind = "constant" if variable.variability == "constant" else variable.causality
        return f"({kind}) cannot be set; override parameters, inputs or start values"
    return value_objection(variable, value)


def value_objection(variable: Variable, value: object) -> str:
    """Why a variable cannot have a value, as the end of a sentence; empty if it can."""
    try:
        number = math.nan if isinstance(value, str) else float(value)  # type: ignore[arg-type]
    except (TypeError, ValueError, OverflowError):
        return f"cannot be set to {value!r}; give a number"
    if not math.isfinite(number):
        return f"cannot be set to {value!r}; give a finite number"
    if variable.type in REALS:
        return ""
    if number != round(number):
        return f"is {variable.type} and cannot be set to {value}; give a whole number"
    low, high = _range(variable.type)
    return "" if low <= number <= high else f"is {variable.type} and cannot be set to {value}; give {low} to {high}"


def _range(kind: str) -> tuple[int, int]:
    """Least and largest number of a type that has whole ones only."""
    if kind == "Boolean":
        return 0, 1
    limits = np.iinfo({"Integer": "int32", "Enumeration": "int32"}.get(kind, kind.lower()))
    return int(limits.min), int(limits.max)
