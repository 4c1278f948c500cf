"""Which partial derivatives may differ from zero, and which of them one directional derivative yields together."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pysim.simulate._structure import Structure
from pysim.simulate.kernel.elimination import elimination_arrays
from pysim.types import Abilities, Model

Pattern = NDArray[np.bool_]


def column_groups(pattern: Pattern) -> list[list[int]]:
    """Columns in groups such that no row of the pattern has two of a group (Curtis, Powell, Reid 1974)."""
    groups: list[list[int]] = []
    covered: list[np.ndarray] = []
    for number in np.argsort(-pattern.sum(axis=0), kind="stable").tolist():  # the fullest first
        column = pattern[:, number]
        for group, rows in zip(groups, covered, strict=True):
            if not np.any(rows & column):
                group.append(number)
                rows |= column
                break
        else:
            groups.append([number])
            covered.append(column.copy())
    return groups


def dependency_pattern(abilities: Abilities) -> Pattern:
    """(n, n): whether derivative i may depend on state j."""
    n = len(abilities.states)
    pattern = np.ones((n, n), dtype=bool)
    for row, names in zip(pattern, abilities.dependencies, strict=False):
        if names is not None:
            row[:] = [state in names for state in abilities.states]
    return pattern


def output_pattern(abilities: Abilities, outputs: Sequence[str]) -> Pattern:
    """(outputs, n): whether each may depend on state j; what is no declared output may depend on all."""
    known = dict(abilities.output_dependencies)
    return _rows([known.get(name) for name in outputs], abilities.states)


def parameter_pattern(abilities: Abilities, variables: Sequence[str], parameters: Sequence[str]) -> Pattern:
    """(variables, parameters): whether each output or derivative may depend directly on each parameter.

    What a variable is made of at the start of a run names the parameters too, other than what it is made of later.
    """
    known = dict(abilities.initial_dependencies)
    return _rows([known.get(name) for name in variables], parameters)


def _rows(sets: Sequence[frozenset[str] | None], columns: Sequence[str]) -> Pattern:
    rows = [[names is None or column in names for column in columns] for names in sets]
    return np.array(rows, dtype=bool).reshape(len(sets), len(columns))


def partials(pattern: Pattern, unknowns: Sequence[int], knowns: Sequence[int], places: NDArray[np.int64]) -> Structure:
    """`Partials` of the kernel.

    Args:
        pattern: (unknowns, knowns) that may differ from zero.
        unknowns, knowns: references.
        places: (unknowns, knowns) where each goes in the matrix.
    """
    groups = [[known for known in group if pattern[:, known].any()] for group in column_groups(pattern)]
    members = [known for group in groups for known in group]
    entries = [[(row, known) for known in group for row in np.flatnonzero(pattern[:, known])] for group in groups]
    rows, columns = np.array([entry for group in entries for entry in group], dtype=np.int64).reshape(-1, 2).T
    return Structure(
        "Partials",
        {
            "groups": len(groups),
            "first_known": np.cumsum([0, *map(len, groups)], dtype=np.int64),
            "knowns": np.array(knowns, dtype=np.uint32)[np.array(members, dtype=np.int64)],
            "first_entry": np.cumsum([0, *map(len, entries)], dtype=np.int64),
            "unknowns": np.array(unknowns, dtype=np.uint32)[rows],
            "places": np.array(places[rows, columns], dtype=np.int64),
            "column": np.zeros(max(map(len, entries), default=0)),
            "ones": np.ones(max(map(len, groups), default=0)),
        },
    )


def jacobian_arrays(model: Model) -> dict[str, Any]:
    """What `Work` of the kernel needs to take a model's Jacobian, in groups, and to solve with it.

    The structure `by_states` has work space of its own: each job needs another.
    """
    abilities = model.abilities
    pattern, n = dependency_pattern(abilities), len(abilities.states)
    places = np.arange(n * n, dtype=np.int64).reshape(n, n).T
    return {
        "has_directional": abilities.directional_derivatives,
        "by_states": partials(
            pattern, references(model, abilities.derivatives), references(model, abilities.states), places
        ),
        **elimination_arrays(pattern),
    }


def references(model: Model, names: Sequence[str]) -> list[int]:
    """Value references."""
    return [model[name].reference for name in names]
