"""Sparse linear systems d I - J: the order of elimination is found once per model, pivots stay on the diagonal.

Entries that are zero whatever the point are never touched; of the pump's 144 they are 95. The kernel eliminates by the
lists that are made here (src/sparse.c).
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

_WORTH = 0.5  # of all entries: with more of them, the dense elimination is faster

Pattern = NDArray[np.bool_]


def elimination_arrays(pattern: Pattern) -> dict[str, Any]:
    """What `Work` of the kernel needs to solve with d I - J, J of this (n, n) pattern; the same for every run.

    Entries lie row after row in the order of elimination, so that a row is: left of the diagonal, diagonal, right of
    it. An operation takes from the entry `target` the product of `weight`, left of the diagonal, and of `source`, in
    the row that is eliminated there.
    """
    n = len(pattern)
    order = elimination_order(pattern)
    filled = fill(pattern, order)
    if filled.sum() > _WORTH * n * n:
        return {"sparse": 0}
    rows, columns = np.nonzero(filled)  # by row, then by column
    number = np.full((n, n), -1)
    number[rows, columns] = np.arange(rows.size)
    operations = [
        [
            (number[row, after], number[row, column], number[column, after], 0)
            for column in np.flatnonzero(filled[row, :row])
            for after in np.flatnonzero(filled[column, column + 1 :]) + column + 1
        ]
        for row in range(n)
    ]
    return {
        "sparse": 1,
        "entries": rows.size,
        "sources": _longs(order[columns] * n + order[rows]),
        "states": _longs(order),
        "row_first": _longs([0, *np.cumsum(filled.sum(axis=1))]),
        "diagonal": _longs(np.diag(number)),
        "places": _longs(columns),
        "columns": _longs(order[columns]),
        "operation_first": _longs([0, *np.cumsum([len(row) for row in operations])]),
        "operations": np.array([one for row in operations for one in row], dtype=np.uint32).reshape(-1, 4),
    }


def elimination_order(pattern: Pattern) -> NDArray[np.int64]:
    """States in an order that fills few zeros and makes few operations wait for each other.

    Next comes the state whose row and column can fill the fewest entries (Markowitz 1957, The elimination form of the
    inverse, restricted to the diagonal), times the length of the chain of states that it waits for.
    """
    n = len(pattern)
    left = pattern | np.eye(n, dtype=bool)
    is_open, chain = np.ones(n, dtype=bool), np.ones(n, dtype=np.int64)
    order = np.zeros(n, dtype=np.int64)
    for place in range(n):
        work = (left.sum(axis=0) - 1) * (left.sum(axis=1) - 1) + 1
        state = int(np.argmin(np.where(is_open, work * chain, np.iinfo(np.int64).max)))
        order[place], is_open[state] = state, False
        touched = left[state] | left[:, state]
        chain[touched] = np.maximum(chain[touched], chain[state] + 1)
        left |= np.outer(left[:, state], left[state])
        left[:, state] = left[state] = False
    return order


def fill(pattern: Pattern, order: NDArray[np.int64]) -> Pattern:
    """(n, n) in that order: entries that are not zero before or after elimination; the whole diagonal among them."""
    filled = (pattern | np.eye(len(pattern), dtype=bool))[np.ix_(order, order)]
    for c in range(len(filled)):
        filled[c + 1 :, c + 1 :] |= np.outer(filled[c + 1 :, c], filled[c, c + 1 :])
    return filled


def _longs(values: Any) -> NDArray[np.int64]:
    return np.array(values, dtype=np.int64)
