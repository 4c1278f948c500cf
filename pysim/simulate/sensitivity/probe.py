"""Which derivatives an FMU really gives: asked and compared with differences once, before they are relied on."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from pysim.simulate._check import check_experiment, check_experiments
from pysim.simulate._foreign import Opened
from pysim.simulate._found import Found
from pysim.simulate._pass import run_tasks
from pysim.simulate._request import Kind, Request
from pysim.simulate._variation import Directions
from pysim.simulate.esdirk import Esdirk
from pysim.simulate.kernel.layout import VARIED
from pysim.types import BadInput, Experiment, Model, Signal, Variable

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

    def directions(self, *, states: bool = False, offset: bool = False, through: bool = False) -> Directions:
        """All of it as directions of a run."""
        return Directions(self.parameters, self.starts, states, self.outputs, offset, through)


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
    check_experiments(model, experiments)
    known: set[object] = set()
    for experiment in experiments:
        used = tuple(experiment.inputs.keys()), tuple(experiment.rates.keys()), tuple(experiment.overrides.keys())
        if used not in known:
            values = {name: value_of(model, experiment, name) for name in names}
            check_experiment(model, experiment.override(**values))
            known.add(used)


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
    """The experiment's start alone, before any offset of its states; of its inputs the pieces that are needed there."""
    start = experiment.start
    inputs = {name: _piece_at(signal, start) for name, signal in experiment.inputs.items()}
    return replace(experiment, times=np.array([start]), inputs=inputs, offset=np.zeros(0), offset_at=None)


def _piece_at(signal: Signal, time: float) -> Signal:
    k = max(int(np.searchsorted(signal.starts, time, side="right")) - 1, 0)
    return Signal(signal.starts[k : k + 1], signal.cubics[k : k + 1], signal.sines[k : k + 1])


_NOTHING = Offer((), frozenset(), False)


def counts(model: Model, record: tuple[str, ...], names: frozenset[str]) -> bool:
    """Whether a slope or a recorded variable is among these names."""
    return not names.isdisjoint((*model.abilities.derivatives, *record))


def probe(library: Opened, experiment: Experiment, solver: Esdirk, parameters: Sequence[str]) -> Offer | None:
    """Ask the FMU, at the experiment's start, for every derivative that is wanted; None where it cannot be started.

    A column that it refuses, or that is not what a difference shows, is not part of the offer. Nothing is where the
    derivatives by the states are wrong, for every column is made of them.
    """
    model = library.model
    delayed = model.abilities.delayed  # what moves such a value lies in the past
    if (delayed and counts(model, experiment.record, delayed)) or not model.abilities.directional_derivatives:
        return _NOTHING
    once = at_rest(experiment)
    (first,) = points(library, solver, Directions(outputs=False), [Request(once)])
    if not first.done:
        return None
    starts = frozenset(n for n in parameters if n in model.abilities.states or _is_start(model[n]))
    sizes = np.maximum(np.abs(first.array("state")), first.array("nominal"))
    point = first.array("state") + _ASIDE * sizes
    wanted = tuple(name for name in parameters if name not in starts)
    once = once.override(**{name: value_of(model, once, name) for name in wanted})  # all sides set the same names
    sides = [both_sides(model, once, name, START_STEP) for name in wanted]
    moves = (START_STEP * sizes, -START_STEP * sizes)
    asked = [Request(once, point + move) for move in moves]
    asked += [Request(side, point) for up, down, _ in sides for side in (up, down)]
    given, *found = points(library, solver, Directions(states=True, outputs=False), [Request(once, point), *asked])
    if given.done and not _states_agree(given, found[0], found[1], sizes):
        return _NOTHING
    columns = _columns(library, solver, wanted, Request(once, point))
    agreeing = {
        name
        for k, (name, column) in enumerate(zip(wanted, columns, strict=True))
        if column is not None and _agrees(column, found[2 + 2 * k], found[3 + 2 * k], sides[k][2])
    }
    offered = tuple(name for name in parameters if name in starts or name in agreeing)
    return Offer(offered, starts & set(offered), True)


def probe_each(
    library: Opened, experiments: Sequence[Experiment], solver: Esdirk, parameters: Sequence[str]
) -> dict[tuple[str, ...], Offer]:
    """The offer for each choice of variables to record, from the first of the experiments that can be started.

    As long as a library is open it is asked once.
    """
    offers: dict[tuple[str, ...], Offer | None] = {}
    for experiment in experiments:
        key = experiment.record, tuple(parameters)
        if offers.get(experiment.record) is None:
            offers[experiment.record] = library.known.get(key) or probe(library, experiment, solver, parameters)
            library.known[key] = offers[experiment.record]
    return {record: offer or _NOTHING for record, offer in offers.items()}


def _is_start(variable: Variable) -> bool:
    return variable.causality not in ("parameter", "input")


def points(
    library: Opened,
    solver: Esdirk,
    directions: Directions,
    requests: Sequence[Request],
    workers: int = 1,
) -> list[Found]:
    """The first points of runs that end where they begin, with all derivatives there."""
    return run_tasks(library, Kind(VARIED, solver, directions, point=True), requests, workers=workers)


def _columns(library: Opened, solver: Esdirk, names: tuple[str, ...], request: Request) -> list[Array | None]:
    """Derivatives (n_x,) of the states' by each parameter; None where the FMU refuses."""
    (found,) = points(library, solver, Directions(names, outputs=False), [request])
    if found.done:
        return [*found.array("forcing")]
    if len(names) <= 1:
        return [None] * len(names)
    return [_columns(library, solver, (name,), request)[0] for name in names]


def _derivatives(found: Found) -> tuple[Array, Array]:
    """Derivatives (n_x,) of the states at a point, and the size of what adds up to them."""
    rates, jacobian = found.array("rates"), found.array("jacobian")
    return rates, np.abs(rates) + np.abs(jacobian.T) @ np.abs(found.array("state"))


def _states_agree(given: Found, up: Found, down: Found, sizes: Array) -> bool:
    """Whether the FMU's derivatives by the states, all moved at once by their sizes, are what a difference shows."""
    if not (up.done and down.done):
        return True  # nothing to compare with
    jacobian = given.array("jacobian").T
    (high, noise), (low, _) = _derivatives(up), _derivatives(down)
    numeric = (high - low) / (2 * START_STEP)
    size = np.maximum(np.abs(jacobian) @ sizes, np.abs(numeric))
    return bool(np.all(np.abs(numeric - jacobian @ sizes) <= _WRONG * size + _NOISE * noise / START_STEP))


def _agrees(exact: Array, up: Found, down: Found, distance: float) -> bool:
    """Whether the FMU's derivative by a parameter is the one that a central difference shows, at those states."""
    if not (up.done and down.done):
        return True  # nothing to compare with
    (high, noise), (low, _) = _derivatives(up), _derivatives(down)
    numeric = (high - low) / distance
    size = np.maximum(np.abs(numeric), np.abs(exact))
    return bool(np.all(np.abs(numeric - exact) <= _WRONG * size + _NOISE * noise / distance))
