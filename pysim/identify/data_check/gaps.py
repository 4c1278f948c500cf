"""Logs without the rows that lack a cell."""

from __future__ import annotations

import numpy as np

from pysim.types import Record


def whole_rows(log: Record) -> Record:
    """The log without rows in which a cell is empty."""
    whole = np.isfinite(log.values).all(axis=1)
    if whole.all():
        return log
    return Record(log.time[whole], log.values[whole], log.names, log.units, origin=log.origin)
