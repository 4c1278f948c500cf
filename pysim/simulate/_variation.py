"""By what a run is differentiated, and what the kernel needs for it."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from pysim.simulate._base import Solver
from pysim.simulate.kernel.layout import ASKED, COLUMNS, FIXED
from pysim.simulate.kernel.memory import lined
from pysim.simulate.kernel.sparsity import output_pattern, parameter_pattern, partials, references
from pysim.types import Model

_REALS = frozenset({"Real", "Float64"})


@dataclass(frozen=True)
class Directions:
    """By what a run is differentiated.

    Args:
        parameters: names whose columns the FMU's directional derivatives give.
        starts: those of them that no equation holds: start values of states.
        states: whether the states at the start are directions too; their columns come first.
        outputs: whether the derivatives of what is recorded are wanted.
        offset: whether the offset of the states is a direction, in place of the states at the start.
        through: whether the run goes on at events that change neither a state nor its derivative.
    """

    parameters: tuple[str, ...] = ()
    starts: frozenset[str] = frozenset()
    states: bool = False
    outputs: bool = True
    offset: bool = False
    through: bool = False


def variation_arrays(
    model: Model,
    record: tuple[str, ...],
    directions: Directions,
    solver: Solver,
    column_of: Callable[[int], int] | None = None,
) -> dict[str, Any]:
    """What `Variation` of the kernel points to.

    Args:
        column_of: of a parameter, by its reference, in the matrix that an FMU of ours keeps; -1 for none.
    """
    n, parameters, stages = len(model.abilities.states), directions.parameters, solver.method().b.size
    by_start = n if directions.states or directions.offset else 0
    width = -(-(by_start + len(parameters)) // COLUMNS) * COLUMNS
    return {
        "columns": width,
        "by_start": by_start,
        "from_start": int(directions.states),
        "parameters": len(parameters),
        "through": int(directions.through),
        "tolerance": getattr(solver, "derivative_tol", np.inf),
        "start_by": lined(n, width),
        "s": lined(n, width),
        "k": lined(stages, n, width),
        "right": lined(n, width),
        "inside": lined(n, width),
        "error": lined(n, width),
        "sizes": np.zeros(width),
        "weights": np.zeros(stages),
        "forcing": np.zeros((len(parameters), n)),
        **_forcing(model, directions, by_start, width),
        "low": np.zeros(n),
        "high": np.zeros(n),
        **_recorded(model, record, directions, by_start, width),
        **_columns(model, directions, column_of),
    }


def _columns(model: Model, directions: Directions, column_of: Callable[[int], int] | None) -> dict[str, Any]:
    """Where an FMU of ours keeps the parameters' derivatives; nothing where it lacks one of them."""
    seeded, columns = _seeded(directions), np.full(max(1, len(directions.parameters)), -1, dtype=np.int64)
    if column_of is None:
        return {}
    columns[seeded] = [column_of(model[directions.parameters[p]].reference) for p in seeded]
    return {} if np.any(columns[seeded] < 0) else {"columns_of": columns}


def _seeded(directions: Directions) -> list[int]:
    """Numbers of the parameters that an equation holds."""
    return [p for p, name in enumerate(directions.parameters) if name not in directions.starts]


def _forcing(model: Model, directions: Directions, by_start: int, width: int) -> dict[str, Any]:
    """Partial derivatives of the states' by the parameters, and where they go in (n, width)."""
    rates, n = model.abilities.derivatives, len(model.abilities.states)
    seeded = _seeded(directions)
    names = [directions.parameters[p] for p in seeded]
    places = np.array(seeded, dtype=np.int64)[None, :] * n + np.arange(n)[:, None]
    pattern = parameter_pattern(model.abilities, rates, names)
    found = partials(pattern, references(model, rates), references(model, names), places)
    parameters, rows = np.divmod(found.arrays["places"], max(n, 1))
    return {"by_parameters": found, "entries": rows.size, "forcing_targets": rows * width + by_start + parameters}


def _recorded(model: Model, names: Sequence[str], directions: Directions, by_start: int, width: int) -> dict[str, Any]:
    """How each recorded variable follows from states and parameters."""
    states = {model[name].reference: i for i, name in enumerate(model.abilities.states)}
    kinds, fixed = [], np.zeros((len(names), width))
    for row, name in zip(fixed, names, strict=True):
        variable = model[name]
        real = variable.type in _REALS and variable.variability != "discrete"
        if not directions.outputs or not real or variable.causality in ("parameter", "input", "independent"):
            kinds.append(FIXED)
        else:
            kinds.append(states.get(variable.reference, ASKED))
        if name in directions.parameters and variable.causality in ("parameter", "input"):
            row[by_start + directions.parameters.index(name)] = 1.0
    asked = [y for y, kind in enumerate(kinds) if kind == ASKED]
    return {"kinds": np.array(kinds, dtype=np.int64), "fixed": fixed, **_outputs(model, names, asked, directions)}


def _outputs(model: Model, names: Sequence[str], asked: list[int], directions: Directions) -> dict[str, Any]:
    """Partial derivatives of the recorded variables that the FMU is asked for."""
    abilities, seeded = model.abilities, _seeded(directions)
    outputs, parameters = [names[y] for y in asked], [directions.parameters[p] for p in seeded]
    pattern = np.hstack(
        [output_pattern(abilities, outputs), parameter_pattern(abilities, outputs, parameters)], dtype=bool
    )
    rows, columns = np.nonzero(pattern)
    places = np.zeros(pattern.shape, dtype=np.int64)
    places[rows, columns] = np.arange(rows.size)
    knowns = references(model, [*abilities.states, *parameters])
    numbers = np.array([*range(len(abilities.states)), *(len(abilities.states) + p for p in seeded)], dtype=np.int64)
    return {
        "of_outputs": partials(pattern, references(model, outputs), knowns, places),
        "slopes": rows.size,
        "slope_rows": np.array(asked, dtype=np.int64)[rows],
        "slope_columns": numbers[columns],
        "gradient": np.zeros(rows.size),
    }
