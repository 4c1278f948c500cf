"""Columns of the Jacobian that one directional derivative yields together, because no row depends on two of them."""

from __future__ import annotations

from typing import Any

import numpy as np

from pysim.simulate.kernel.elimination import elimination_arrays
from pysim.types import Abilities, Model


def column_groups(abilities: Abilities) -> list[list[int]]:
    """States in groups such that no derivative depends on two states of a group (Curtis, Powell, Reid 1974)."""
    pattern = dependency_pattern(abilities)
    groups: list[list[int]] = []
    covered: list[np.ndarray] = []
    for state in np.argsort(-pattern.sum(axis=0), kind="stable").tolist():  # the fullest first
        column = pattern[:, state]
        for group, rows in zip(groups, covered, strict=True):
            if not np.any(rows & column):
                group.append(state)
                rows |= column
                break
        else:
            groups.append([state])
            covered.append(column.copy())
    return groups


def dependency_pattern(abilities: Abilities) -> np.ndarray:
    """(n, n) of bool: whether derivative i may depend on state j."""
    n = len(abilities.states)
    pattern = np.ones((n, n), dtype=bool)
    for row, names in zip(pattern, abilities.dependencies, strict=False):
        if names is not None:
            row[:] = [state in names for state in abilities.states]
    return pattern


def jacobian_arrays(model: Model) -> dict[str, Any]:
    """What `Work` of the kernel needs to take a model's Jacobian, in groups, and to solve with it."""
    abilities = model.abilities
    pattern, groups = dependency_pattern(abilities), column_groups(abilities)
    references = np.array([model[name].reference for name in abilities.states], dtype=np.uint32)
    rates = np.array([model[name].reference for name in abilities.derivatives], dtype=np.uint32)
    members = np.array([state for group in groups for state in group], dtype=np.int64)
    entries = [[(row, state) for state in group for row in np.flatnonzero(pattern[:, state])] for group in groups]
    rows, columns = np.array([entry for group in entries for entry in group], dtype=np.int64).reshape(-1, 2).T
    return {
        "has_directional": abilities.directional_derivatives,
        "derivative_references": rates,
        "groups": len(groups),
        "group_first": np.cumsum([0, *map(len, groups)], dtype=np.int64),
        "group_members": members,
        "group_references": references[members],
        "entry_first": np.cumsum([0, *map(len, entries)], dtype=np.int64),
        "entry_references": rates[rows],
        "entry_places": columns * len(rates) + rows,
        **elimination_arrays(pattern),
    }
