"""Derivatives of dx by the states at any point: exact where the FMU offers them, else by differences."""

from __future__ import annotations

from typing import Any

from pysim.simulate.native.compiled import doubles, longs, native
from pysim.simulate.native.fmu_calls import OK, WARNING, get_directional
from pysim.simulate.native.point import copy, evaluate, set_point

_ROOT_EPS = 1.4901161193847656e-08
_SMALL = 1e-3  # of a nominal value: a state below it is moved as if it were that large


@native
def take_jacobian(job: Any, t: float, x: int) -> int:
    """Fill work.jacobian at time t (s) and the states at address x; the worst status.

    The FMU is left at that point only where it offers directional derivatives; work.error, and without them slope,
    change.
    """
    job.run.jacobians += 1
    if job.work.has_directional == 0:
        return _by_differences(job, t, x)
    status = set_point(job, t, x)
    return status if status > WARNING else max(status, jacobian_here(job))


@native
def jacobian_here(job: Any) -> int:
    """Fill work.jacobian at the point last set, one directional derivative per group of states.

    Of a group's derivatives only those are asked for that depend on one of its states; the rest of the Jacobian is
    zero from the start of the run.
    """
    work, status = job.work, OK
    first, entries, places = longs(work.group_first), longs(work.entry_first), longs(work.entry_places)
    jacobian, column = doubles(work.jacobian), doubles(work.error)
    for g in range(work.groups):
        start, size = entries[g], entries[g + 1] - entries[g]
        if size > 0:
            knowns, count = work.group_references + 4 * first[g], first[g + 1] - first[g]
            unknowns = work.entry_references + 4 * start
            status = max(status, get_directional(job.fmu, unknowns, size, knowns, count, work.ones, work.error))
            if status > WARNING:
                return status
            for i in range(size):
                jacobian[places[start + i]] = column[i]
    return status


@native
def _by_differences(job: Any, t: float, x: int) -> int:
    """One-sided differences, each state moved by the root of the rounding error.

    They start from the model's own derivative at x: that of an implicit stage is off by what Newton left of it, which
    the small steps would enlarge to the size of the Jacobian.
    """
    work, n = job.work, job.work.n
    moved, rate, nominal = doubles(work.slope), doubles(work.error), doubles(work.nominal)
    copy(x, work.slope, n)
    status = evaluate(job, t, work.slope, work.error)
    if status > WARNING:
        return status
    for j in range(n):
        before = moved[j]
        moved[j] = before + _ROOT_EPS * max(abs(before), _SMALL * nominal[j])
        column = doubles(work.jacobian + 8 * n * j)
        status = max(status, evaluate(job, t, work.slope, work.jacobian + 8 * n * j))
        if status > WARNING:
            return status
        for i in range(n):
            column[i] = (column[i] - rate[i]) / (moved[j] - before)
        moved[j] = before
    return status
