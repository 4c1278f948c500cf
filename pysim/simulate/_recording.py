"""Recording: rows of variables at the requested times."""

from __future__ import annotations

from typing import Any, NamedTuple

from pysim.simulate._fmu_calls import OK, WARNING, get_values
from pysim.simulate._native import native
from pysim.simulate._point import set_point


class Rows(NamedTuple):
    """Where and what to record."""

    times: Any  # (n_t,) s
    references: Any  # (n_y,) uint32
    values: Any  # (n_t, n_y)


@native
def interpolate(work: Any, theta: float) -> None:
    """work.x_try = states at the share theta of the step, from work.dense."""
    terms = work.dense.shape[0]
    for j in range(work.x.size):
        y = work.dense[terms - 1, j]
        for p in range(terms - 2, -1, -1):
            y = work.dense[p, j] + theta * y
        work.x_try[j] = work.x[j] + theta * y


@native
def record_row(fmu: Any, run: Any, rows: Any) -> int:
    """Read one row at the point last set."""
    status = get_values(fmu, fmu.get_reals, rows.references, rows.values[run.row])
    run.row += 1
    return status


@native
def record_inside(fmu: Any, inputs: Any, run: Any, work: Any, rows: Any, h: float, t_end: float) -> int:
    """Record every row before t_end (s) in the step of length h from run.t; work.dense is filled."""
    while run.row < rows.times.size and rows.times[run.row] < t_end:
        t = rows.times[run.row]
        interpolate(work, (t - run.t) / h)
        status = set_point(fmu, inputs, run, t, work.x_try)
        if status <= WARNING:
            status = record_row(fmu, run, rows)
        if status > WARNING:
            return status
    return OK


@native
def record_here(fmu: Any, inputs: Any, run: Any, work: Any, rows: Any) -> int:
    """Record the row that falls on run.t, if there is one."""
    if run.row >= rows.times.size or rows.times[run.row] > run.t:
        return OK
    status = set_point(fmu, inputs, run, run.t, work.x)
    return status if status > WARNING else record_row(fmu, run, rows)
