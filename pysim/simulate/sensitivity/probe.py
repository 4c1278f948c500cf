"""Which derivatives an FMU really gives: asked and compared with differences once, before they are relied on."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from pysim.simulate._check import check_experiment
from pysim.simulate._library import CallFailed, Instance, Library
from pysim.simulate._run import initialise
from pysim.simulate.esdirk import Esdirk
from pysim.simulate.sensitivity.varied import Directions, Varied, vary
from pysim.types import BadInput, Experiment, Model, Outcome, Variable

Array = NDArray[np.float64]

START_STEP = 1e-5  # of a parameter: what moves it to see the start states move
_WRONG = 0.02  # share by which a derivative and its difference may not differ
_NOISE = 1e-13  # rounding, of the size of what adds up to a derivative
_ASIDE = 1e-3  # of the states' sizes: how far beside the start is looked, where fewer derivatives vanish


@dataclass(frozen=True)
class Offer:
    """What can be had exactly.

    Args:
        parameters: names whose columns the FMU gives.
        starts: those of them that are start values of states.
        outputs: whether it gives the derivatives of what is recorded.
    """

    parameters: tuple[str, ...]
    starts: frozenset[str]
    outputs: bool

    def directions(self, *, states: bool = False, offset: bool = False) -> Directions:
        """All of it as directions of a run."""
        return Directions(self.parameters, self.starts, states, self.outputs, offset)


def check_names(function: str, parameters: Sequence[str]) -> tuple[str, ...]:
    """The names as a tuple, none of them twice.

    Raises:
        BadInput: one is, or they are a text.
    """
    if isinstance(parameters, str):
        raise BadInput(f"{function}: parameters is the text {parameters!r}; write a tuple of names, ({parameters!r},)")
    names = tuple(parameters)
    for name in names:
        if names.count(name) > 1:
            raise BadInput(f"{function}: {name} is asked for twice; name each parameter once")
    return names


def check_parameters(function: str, model: Model, experiments: Sequence[Experiment], names: Sequence[str]) -> None:
    """Check the experiments, and that each can be differentiated by each name.

    Raises:
        BadInput: as `simulate`, or a name that is not real, cannot be set, is driven, or has no value.
    """
    for name in names:
        if model[name].type not in ("Real", "Float64"):
            raise BadInput(f"{function}: {name} is {model[name].type}; a derivative needs a real parameter")
    for count, experiment in enumerate(experiments):
        check_experiment(model, experiment)
        values = {name: value_of(model, experiment, name) for name in names}
        if count == 0 or any(name in experiment.inputs or name in experiment.rates for name in names):
            check_experiment(model, experiment.override(**values))


def size_of(variable: Variable, value: float) -> float:
    """By what a change of a parameter is measured: its value, else its nominal value or its range."""
    span = variable.max - variable.min if variable.max is not None and variable.min is not None else 0.0
    return abs(value) or abs(variable.nominal or 0.0) or abs(span) or 1.0


def value_of(model: Model, experiment: Experiment, name: str) -> float:
    """The value a parameter has in an experiment.

    Raises:
        BadInput: neither the experiment nor the FMU gives one.
    """
    value = experiment.overrides.get(name, model[name].start)
    if value is None:
        raise BadInput(f"{model.label}: {name} has no value to differentiate at; give it one in the overrides")
    return float(value)


def both_sides(model: Model, experiment: Experiment, name: str, share: float) -> tuple[Experiment, Experiment, float]:
    """The experiment with the parameter moved up and down by a share of its size, within its bounds; their distance."""
    variable, value = model[name], value_of(model, experiment, name)
    step = share * size_of(variable, value)
    up = value + step if variable.max is None else min(value + step, max(variable.max, value))
    down = value - step if variable.min is None else max(value - step, min(variable.min, value))
    if not up > down:
        raise BadInput(f"{model.label}: {name} cannot be moved from {value}: its min and max leave no room")
    return experiment.override(**{name: up}), experiment.override(**{name: down}), up - down


def at_rest(experiment: Experiment) -> Experiment:
    """The experiment's start alone, before any offset of its states."""
    return replace(experiment, times=np.array([experiment.start]), offset=np.zeros(0), offset_at=None)


_NOTHING = Offer((), frozenset(), False)


def probe(library: Library, experiment: Experiment, solver: Esdirk, parameters: Sequence[str]) -> Offer | None:
    """Ask the FMU, at the experiment's start, for every derivative that is wanted; None where it cannot be started.

    A column that it refuses, or that is not what a difference shows, is not part of the offer. Nothing is where the
    derivatives by the states are wrong, for every column is made of them.
    """
    model = library.model
    if not model.abilities.directional_derivatives:
        return _NOTHING
    once = at_rest(experiment)
    first = at_start(library, once, solver, Directions())
    if first is None:
        return None
    starts = frozenset(n for n in parameters if n in model.abilities.states or _is_start(model[n]))
    sizes = np.maximum(np.abs(first.states), first.nominal)
    point = first.states + _ASIDE * sizes
    if not _states_agree(library, once, solver, point, sizes):
        return _NOTHING
    given = tuple(n for n in parameters if n in starts or _agrees(library, once, solver, n, point))
    return Offer(given, starts & set(given), True)


def probe_each(
    library: Library, experiments: Sequence[Experiment], solver: Esdirk, parameters: Sequence[str]
) -> dict[tuple[str, ...], Offer]:
    """The offer for each choice of variables to record, from the first of the experiments that can be started."""
    offers: dict[tuple[str, ...], Offer | None] = {}
    for experiment in experiments:
        if offers.get(experiment.record) is None:
            offers[experiment.record] = probe(library, experiment, solver, parameters)
    return {record: offer or _NOTHING for record, offer in offers.items()}


def _is_start(variable: Variable) -> bool:
    return variable.causality not in ("parameter", "input")


def at_start(
    library: Library, experiment: Experiment, solver: Esdirk, directions: Directions, start: Array | None = None
) -> Varied | None:
    """The run's first point; None where the FMU refuses."""
    try:
        with library.instance() as instance:
            return _begin(instance, experiment, solver, directions, start)
    except CallFailed:
        return None


def _begin(
    instance: Instance, experiment: Experiment, solver: Esdirk, directions: Directions, start: Array | None
) -> Varied | None:
    initialise(instance, experiment, solver)
    varied = vary(instance, experiment, solver, directions, start=start)
    return varied if varied.outcome is Outcome.DONE else None


def _derivatives(library: Library, experiment: Experiment, solver: Esdirk, point: Array) -> tuple[Array, Array] | None:
    """Derivatives (n_x,) of the states at the start, were they at that point, and the size of what adds up to them."""
    varied = at_start(library, experiment, solver, Directions(states=True, outputs=False), point)
    if varied is None:
        return None
    rates = varied.job.array("work", "dx").copy()
    return rates, np.abs(rates) + np.abs(varied.job.array("work", "jacobian").T) @ np.abs(varied.states)


def _states_agree(library: Library, experiment: Experiment, solver: Esdirk, point: Array, sizes: Array) -> bool:
    """Whether the FMU's derivatives by the states, all moved at once by their sizes, are what a difference shows."""
    given = at_start(library, experiment, solver, Directions(states=True, outputs=False), point)
    if given is None:
        return True  # nothing to compare with
    jacobian = given.job.array("work", "jacobian").T.copy()
    moves = (START_STEP * sizes, -START_STEP * sizes)
    sides = [_derivatives(library, experiment, solver, point + move) for move in moves]
    if sides[0] is None or sides[1] is None:
        return True
    numeric, noise = (sides[0][0] - sides[1][0]) / (2 * START_STEP), _NOISE * sides[0][1] / START_STEP
    size = np.maximum(np.abs(jacobian) @ sizes, np.abs(numeric))
    return bool(np.all(np.abs(numeric - jacobian @ sizes) <= _WRONG * size + noise))


def _agrees(library: Library, experiment: Experiment, solver: Esdirk, name: str, point: Array) -> bool:
    """Whether the FMU's derivative by a parameter is the one that a central difference shows, at those states."""
    given = at_start(library, experiment, solver, Directions((name,), outputs=False), point)
    if given is None:
        return False
    exact = given.job.array("variation", "forcing")[0].copy()
    up, down, distance = both_sides(library.model, experiment, name, START_STEP)
    sides = [_derivatives(library, side, solver, point) for side in (up, down)]
    if sides[0] is None or sides[1] is None:
        return True  # nothing to compare with
    numeric, noise = (sides[0][0] - sides[1][0]) / distance, _NOISE * sides[0][1] / distance
    size = np.maximum(np.abs(numeric), np.abs(exact))
    return bool(np.all(np.abs(numeric - exact) <= _WRONG * size + noise))
