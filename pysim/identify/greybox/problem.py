"""A model, its measurements and what may change: checked once, then never changed."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from pysim.identify.greybox.measured import build_targets
from pysim.identify.greybox.parameters import Parameter, ParameterSpace, Tie, parameter_space
from pysim.identify.greybox.target import Target
from pysim.identify.greybox.treatment import Measurements, Treatment
from pysim.types import BadInput, Dataset, Model


@dataclass(frozen=True)
class Problem:
    """What a fit solves.

    Args:
        model: left unchanged.
        space: free, tied and fixed parameters.
        targets: measurements to fit and to hold out.
        notes: what was assumed on the way.
    """

    model: Model
    space: ParameterSpace
    targets: tuple[Target, ...]
    notes: tuple[str, ...] = ()


def problem(
    model: Model,
    data: Sequence[Measurements | Dataset],
    free: Sequence[Parameter | str],
    *,
    fixed: Mapping[str, float] | None = None,
    ties: Sequence[Tie] = (),
    treatment: Treatment | None = None,
) -> Problem:
    """Bring model, data sets and parameters together.

    Args:
        model: has a variable for each compared signal, in the same unit. An input named like a command with `_t`
            behind it is taken as its rate and gets its exact derivative.
        data: data sets; a plain Dataset means all its outputs and no overrides.
        free: parameters, or names where everything comes from the model.
        fixed: parameter -> value, in its unit.
        ties: parameters that follow free ones.
        treatment: how logs are compared.
    Raises:
        BadInput: what does not fit together, before anything runs.
    """
    treatment = treatment or Treatment()
    parameters = [Parameter(p) if isinstance(p, str) else p for p in free]
    space = parameter_space(model, parameters, fixed=fixed, ties=ties)
    targets: list[Target] = []
    notes: list[str] = []
    if not data:
        raise BadInput("fit: give at least one data set")
    for one in (d if isinstance(d, Measurements) else Measurements(d) for d in data):
        for name in one.overrides:
            if name in (*space.variables, *space.fixed, *(tie.name for tie in space.ties)):
                raise BadInput(f"fit: data set {one.dataset.name!r} overrides {name}, which is free, tied or fixed")
        found, said = build_targets(model, one, treatment, _started(model, space))
        targets += found
        notes += said
    _check_records(space, targets)
    if not any(target.use == "fit" for target in targets):
        raise BadInput('fit: no record is for fitting; give at least one use = "fit" in dataset.toml')
    return Problem(model, space, tuple(targets), tuple(dict.fromkeys(notes)))


def _started(model: Model, space: ParameterSpace) -> set[str | None]:
    """Records that a state is free to begin at another value in; None where it is in all."""
    states = model.abilities.states
    return {record for name, record in zip(space.variables, space.records, strict=True) if name in states}


def _check_records(space: ParameterSpace, targets: Sequence[Target]) -> None:
    known = {run.record for target in targets for run in target.runs}
    for record in space.records:
        if record is not None and record not in known:
            raise BadInput(f"fit: no compared record is called {record!r}; there are {', '.join(sorted(known))}")
