"""Sparse linear systems d I - J: the order of elimination is found once per model, pivots stay on the diagonal.

Entries that are zero whatever the point are never touched; of the pump's 144 they are 95. A pivot on the diagonal may
be a bad one, so every factorisation is tried on one vector; where it fails, the dense one with row pivoting takes over.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from pysim.simulate.native.compiled import call, doubles, longs, native
from pysim.simulate.native.linear import factorise, solve
from pysim.simulate.native.unrolled import unrolled

_WORTH = 0.5  # of all entries: with more of them, the dense elimination is faster
_LOSS = 1e-12  # of a row's size: what rounding may change in it

Pattern = NDArray[np.bool_]


def elimination_arrays(pattern: Pattern) -> dict[str, Any]:
    """What WORK needs to solve with d I - J, J of this (n, n) pattern; the same for every run.

    Entries lie row after row in the order of elimination, so that a row is: left of the diagonal, diagonal, right of
    it. `targets` names the entries that elimination changes, in the order in which it does.
    """
    n = len(pattern)
    order = elimination_order(pattern)
    filled = fill(pattern, order)
    if filled.sum() > _WORTH * n * n:
        return {"sparse": 0}
    rows, columns = np.nonzero(filled)  # by row, then by column
    number = np.full((n, n), -1)
    number[rows, columns] = np.arange(rows.size)
    targets = [
        number[row, after]
        for row in range(n)
        for column in np.flatnonzero(filled[row, :row])
        for after in np.flatnonzero(filled[column, column + 1 :]) + column + 1
    ]
    arrays = {
        "sparse": 1,
        "entries": rows.size,
        "sources": _longs(order[columns] * n + order[rows]),
        "states": _longs(order),
        "row_first": _longs([0, *np.cumsum(filled.sum(axis=1))]),
        "diagonal": _longs(np.diag(number)),
        "places": _longs(columns),
        "columns": _longs(order[columns]),
        "targets": _longs(targets),
    }
    return {**arrays, **unrolled(arrays, _LOSS)}


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


@native
def factorise_shifted(job: Any, shift: float) -> bool:
    """Factorise shift I - J, J in work.jacobian, for `solve_shifted`; False if it is singular or not finite."""
    work, n = job.work, job.work.n
    if work.sparse != 0:
        if work.eliminate != 0:
            arrays = work.jacobian, shift, work.factors, work.x, work.nominal
            job.run.is_sparse = call(work.eliminate, arrays)
        else:
            _eliminate(job, shift)
            job.run.is_sparse = 1 if _reproduces(job, shift) else 0
        if job.run.is_sparse != 0:
            return True
    job.run.is_sparse = 0
    matrix, jacobian = doubles(work.matrix), doubles(work.jacobian)
    for i in range(n * n):
        matrix[i] = -jacobian[i]
    for i in range(n):
        matrix[i * n + i] += shift
    return factorise(work.matrix, work.pivots, n)


@native
def solve_shifted(job: Any, right: int) -> None:
    """Replace the right-hand side (n,) by the solution of the system last factorised."""
    if job.run.is_sparse == 0:
        solve(job.work.matrix, job.work.pivots, right, job.work.n)
    elif job.work.substitute != 0:
        call(job.work.substitute, (job.work.factors, right))
    else:
        _substitute(job, right)


@native
def _eliminate(job: Any, shift: float) -> None:
    """Factors L D U of shift I - J into work.factors; the diagonals of L and U are one, that of D is kept inverted."""
    work, n = job.work, job.work.n
    v, jacobian, pivots = doubles(work.factors), doubles(work.jacobian), doubles(work.pivot_values)
    sources, targets, places = longs(work.sources), longs(work.targets), longs(work.places)
    first, diagonal = longs(work.row_first), longs(work.diagonal)
    for q in range(work.entries):
        v[q] = -jacobian[sources[q]]
    step = 0
    for r in range(n):
        middle = diagonal[r]
        v[middle] += shift
        for q in range(first[r], middle):
            c = places[q]
            weight = v[q]
            for u in range(diagonal[c] + 1, first[c + 1]):
                v[targets[step]] -= weight * v[u]
                step += 1
            v[q] = weight * v[diagonal[c]]
        pivots[r] = v[middle]
        inverse = 1.0 / v[middle]
        v[middle] = inverse
        for u in range(middle + 1, first[r + 1]):
            v[u] *= inverse


@native
def _reproduces(job: Any, shift: float) -> bool:
    """Whether the factors give back the matrix, applied to a vector of the size of the states."""
    work, n = job.work, job.work.n
    v, jacobian, pivots, probe = (
        doubles(work.factors),
        doubles(work.jacobian),
        doubles(work.pivot_values),
        doubles(work.probe),
    )
    x, nominal = doubles(work.x), doubles(work.nominal)
    sources, places, columns, states = longs(work.sources), longs(work.places), longs(work.columns), longs(work.states)
    first, diagonal = longs(work.row_first), longs(work.diagonal)
    for r in range(n):  # D U times the vector
        s = states[r]
        y = nominal[s] + abs(x[s])
        for u in range(diagonal[r] + 1, first[r + 1]):
            s = columns[u]
            y += v[u] * (nominal[s] + abs(x[s]))
        probe[r] = y * pivots[r]
    good = 0
    for r in range(n):
        s = states[r]
        size = abs(shift * (nominal[s] + abs(x[s])))
        rest = probe[r] - shift * (nominal[s] + abs(x[s]))
        for q in range(first[r], diagonal[r]):
            rest += v[q] * probe[places[q]]
        for q in range(first[r], first[r + 1]):
            s = columns[q]
            change = jacobian[sources[q]] * (nominal[s] + abs(x[s]))
            rest += change
            size += abs(change)
        good += abs(rest) <= _LOSS * size
    return good == n


@native
def _substitute(job: Any, right: int) -> None:
    work, n = job.work, job.work.n
    v, b, states, columns = doubles(work.factors), doubles(right), longs(work.states), longs(work.columns)
    first, diagonal = longs(work.row_first), longs(work.diagonal)
    for r in range(n):
        y = b[states[r]]
        for q in range(first[r], diagonal[r]):
            y -= v[q] * b[columns[q]]
        b[states[r]] = y
    for r in range(n - 1, -1, -1):
        middle = diagonal[r]
        y = b[states[r]] * v[middle]
        for u in range(middle + 1, first[r + 1]):
            y -= v[u] * b[columns[u]]
        b[states[r]] = y
