"""The structures of src/job.h as NumPy data types: that file is the only place where they are written down."""

from __future__ import annotations

import re
from functools import cache
from typing import Any

import numpy as np

from pysim.simulate.kernel.build import SOURCES

_STRUCTURE = re.compile(r"typedef struct \{(.*?)\n\} (\w+);", re.DOTALL)
_FIELD = re.compile(r"^    (?:const )?(\w+) (\**)(\w+);", re.MULTILINE)


@cache
def structures() -> dict[str, np.dtype[Any]]:
    """By name; a double is float64, whatever else has no structure of its own is int64: a count or an address."""
    found: dict[str, np.dtype[Any]] = {"double": np.dtype(np.float64)}
    for body, name in _STRUCTURE.findall((SOURCES / "job.h").read_text(encoding="utf-8")):
        fields = [
            (field, np.dtype(np.int64) if star else found.get(kind, np.dtype(np.int64)))
            for kind, star, field in _FIELD.findall(body)
        ]
        found[name] = np.dtype(fields)
    return found


JOB, TASK, PASS, FMU = (structures()[name] for name in ("Job", "Task", "Pass", "Fmu"))

STATISTICS = ("steps", "rejected", "derivatives", "jacobians", "events")

# How a run stands, and the other constants of job.h.
RUNNING = -1
DONE, STEP_TOO_SMALL, NOT_FINITE, MODEL_ERROR, TERMINATED, TOO_MANY_STEPS, TOO_MANY_EVENTS = range(7)
EVENT = 100
PART_NONE, PART_INSTANTIATE, PART_SET, PART_ENTER, PART_EXIT, PART_CRASHED, PART_SILENT = range(7)
FOUND, STOPPED_SEARCH, MET_EVENT, RUN_FAILED, NOT_CONVERGED, DRIFTS = range(6)
OK, WARNING, DISCARD, ERROR, FATAL = range(5)
EXPLICIT, ROSENBROCK, ESDIRK = range(3)
PLAIN, VARIED, ORBIT = range(3)
KIND_DOUBLE, KIND_SINGLE, KIND_INT, KIND_LONG, KIND_OCTET = range(5)
KIND_INT8, KIND_UINT8, KIND_INT16, KIND_UINT16, KIND_UINT32, KIND_UINT64 = range(5, 11)
ASKED, FIXED = -1, -2
COLUMNS = 4
LINES, LINE_LENGTH = 20, 1024
