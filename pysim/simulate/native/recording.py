"""Recording: rows of variables at the requested times."""

from __future__ import annotations

from typing import Any

import numpy as np

from pysim.simulate.native.compiled import doubles, ints, longs, native, octets, singles
from pysim.simulate.native.fmu_calls import OK, WARNING, get_values
from pysim.simulate.native.point import set_point
from pysim.types import Model

# Addresses; variables are read in groups of one type, in one call each.
ROWS = np.dtype(
    [
        ("count", np.int64),  # n_t
        ("next", np.int64),  # row to record next
        ("times", np.int64),  # (n_t,) s
        ("values", np.int64),  # (n_t, n_y)
        ("columns", np.int64),  # n_y
        ("groups", np.int64),  # n_g
        ("getters", np.int64),  # (n_g,) of int64, addresses of functions
        ("kinds", np.int64),  # (n_g,) of int64, how the type lies in memory
        ("first", np.int64),  # (n_g + 1,) of int64, group g owns the entries first[g]:first[g + 1] of the next two
        ("references", np.int64),  # (n_y,) of uint32
        ("places", np.int64),  # (n_y,) of int64, column
        ("buffer", np.int64),  # (n_y,) of 8 bytes
    ]
)

_DOUBLE, _SINGLE, _INT, _LONG, _OCTET = range(5)

# Type of variable -> getter and layout, FMI 2 and FMI 3.
GETTERS = {
    2: {
        "Real": ("fmi2GetReal", _DOUBLE),
        "Integer": ("fmi2GetInteger", _INT),
        "Enumeration": ("fmi2GetInteger", _INT),
        "Boolean": ("fmi2GetBoolean", _INT),
    },
    3: {
        "Float64": ("fmi3GetFloat64", _DOUBLE),
        "Float32": ("fmi3GetFloat32", _SINGLE),
        "Int32": ("fmi3GetInt32", _INT),
        "Int64": ("fmi3GetInt64", _LONG),
        "Enumeration": ("fmi3GetInt64", _LONG),
        "Boolean": ("fmi3GetBoolean", _OCTET),
    },
}


def row_layout(model: Model, names: tuple[str, ...], address: Any) -> dict[str, Any]:
    """What ROWS needs to read these variables; `address` gives the address of a function by its name."""
    getters = GETTERS[model.abilities.fmi]
    groups: dict[tuple[str, int], list[int]] = {}
    for column, name in enumerate(names):
        groups.setdefault(getters[model[name].type], []).append(column)
    places = [column for columns in groups.values() for column in columns]
    return {
        "columns": len(names),
        "groups": len(groups),
        "getters": np.array([address(function) for function, _ in groups], dtype=np.int64),
        "kinds": np.array([kind for _, kind in groups], dtype=np.int64),
        "first": np.cumsum([0, *map(len, groups.values())], dtype=np.int64),
        "references": np.array([model[names[column]].reference for column in places], dtype=np.uint32),
        "places": np.array(places, dtype=np.int64),
        "buffer": np.zeros(len(names)),
    }


@native
def interpolate(job: Any, theta: float) -> None:
    """work.x_try = states at the share theta of the step, from work.dense."""
    work, n = job.work, job.work.n
    x, result, dense = doubles(work.x), doubles(work.x_try), doubles(work.dense)
    for j in range(n):
        y = 0.0
        for p in range(job.method.terms - 1, -1, -1):
            y = dense[p * n + j] + theta * y
        result[j] = x[j] + theta * y


@native
def _convert(kind: int, buffer: int, i: int) -> float:
    if kind == _DOUBLE:
        return doubles(buffer)[i]
    if kind == _SINGLE:
        return float(singles(buffer)[i])
    if kind == _INT:
        return float(ints(buffer)[i])
    return float(longs(buffer)[i]) if kind == _LONG else float(octets(buffer)[i])


@native
def read_row(job: Any) -> int:
    """Read one row at the point last set."""
    rows = job.rows
    first, places, row = longs(rows.first), longs(rows.places), doubles(rows.values + 8 * rows.next * rows.columns)
    for g in range(rows.groups):
        count, kind = first[g + 1] - first[g], longs(rows.kinds)[g]
        status = get_values(job.fmu, longs(rows.getters)[g], rows.references + 4 * first[g], rows.buffer, count)
        if status > WARNING:
            return status
        for i in range(count):
            row[places[first[g] + i]] = _convert(kind, rows.buffer, i)
    rows.next += 1
    return OK


@native
def record_inside(job: Any, h: float, t_end: float) -> int:
    """Record every row before t_end (s) in the step of length h from run.t; work.dense is filled."""
    times = doubles(job.rows.times)
    while job.rows.next < job.rows.count and times[job.rows.next] < t_end:
        t = times[job.rows.next]
        interpolate(job, (t - job.run.t) / h)
        status = set_point(job, t, job.work.x_try)
        if status <= WARNING:
            status = read_row(job)
        if status > WARNING:
            return status
    return OK


@native
def record_here(job: Any) -> int:
    """Record the row that falls on run.t, if there is one."""
    rows = job.rows
    if rows.next >= rows.count or doubles(rows.times)[rows.next] > job.run.t:
        return OK
    status = set_point(job, job.run.t, job.work.x)
    return status if status > WARNING else read_row(job)
