"""How inputs run between their samples, where the data set does not say it and they may have been held."""

from __future__ import annotations

from enum import Enum, auto

import numpy as np
from numpy.typing import NDArray

from pysim.identify.data_check.settings import LogCheckSettings
from pysim.identify.logged.command import jumps
from pysim.io.prepare.step import stands
from pysim.types import Dataset, MeasuredRecord, MeasuredSignal, Record
from pysim.types.record_kind import KINDS, Command

_SETTINGS = LogCheckSettings()


class Between(Enum):
    """What is assumed of an input between the samples of a log."""

    HELD = auto()
    HELD_AT_JUMPS = auto()
    SMOOTH = auto()  # though it stays for two samples or more after each change


def between_samples(dataset: Dataset) -> list[tuple[str, Between, list[str]]]:
    """Each input that jumps or runs in steps, what is assumed of it, and in which logs."""
    found = dict[tuple[str, Between], list[str]]()
    for signal in dataset.signals:
        if signal.role == "input" and signal.hold is None:
            for log in dataset.logs():
                if (how := _between(dataset, log, signal)) is not None:
                    found.setdefault((signal.name, how), []).append(log.source)
    return [(*signal, logs) for signal, logs in found.items()]


def _between(dataset: Dataset, log: MeasuredRecord, signal: MeasuredSignal) -> Between | None:
    """None where nothing speaks for a command that was held."""
    if not isinstance(log.data, Record) or signal.name not in log.data.names:
        return None
    if stands(dataset, log, signal.name):
        return Between.HELD
    if KINDS[log.kind].command is not Command.SPLINE:
        return None
    values = log.data[signal.name]
    found = jumps(values)
    if _is_stepped(values, len(found)):
        return Between.SMOOTH
    return Between.HELD_AT_JUMPS if found else None


def _is_stepped(values: NDArray[np.float64], jumped: int) -> bool:
    """Whether a signal (n_t,) changes by any size, hardly ever at two samples in a row, and rarely by a jump."""
    change = np.diff(values[np.isfinite(values)])
    at = np.flatnonzero(change)
    if at.size < max(_SETTINGS.fewest_changes, _SETTINGS.changes_per_jump * jumped):
        return False
    size = np.abs(change[at])
    waits = np.mean(np.diff(at) > 1) >= _SETTINGS.held_share
    return bool(waits and np.median(size) > _SETTINGS.unlike_rounding * size.min())
