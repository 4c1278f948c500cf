"""What is assumed of inputs between their samples, where the data set does not say it and they may have been held."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from pysim.identify.logged.command import jumps
from pysim.io.prepare.step import stands
from pysim.present.notes import listed
from pysim.types import Dataset, MeasuredRecord, MeasuredSignal, Record
from pysim.types.record_kind import KINDS, Command

_SHOWN = 4  # logs
_FEWEST = 20  # changes that show steps
_STANDING = 0.9  # smallest share of its changes with an equal sample ahead
_UNLIKE = 2.5  # ratio of its usual change to its smallest one; a rounded signal changes by one digit


def assumed_between_samples(dataset: Dataset) -> list[tuple[str, str]]:
    """Inputs that jump or run in steps, each with what is assumed of it, in a sentence."""
    found = []
    for signal in dataset.signals:
        if signal.role == "input" and signal.hold is None:
            taken = [(log.source, _taken(dataset, log, signal)) for log in dataset.logs()]
            for words in dict.fromkeys(how for _, how in taken if how):
                logs = [source for source, how in taken if how == words]
                more = [f"{len(logs) - _SHOWN} more"] if len(logs) > _SHOWN else []
                found.append((signal.name, f"In {listed([*logs[:_SHOWN], *more])}, {signal.name} {words}."))
    return found


def _taken(dataset: Dataset, log: MeasuredRecord, signal: MeasuredSignal) -> str:
    """How an input is taken between the samples of a log; empty where nothing speaks for a command that was held."""
    if not isinstance(log.data, Record) or signal.name not in log.data.names:
        return ""
    if stands(dataset, log, signal.name):
        return "is taken as held between its samples"
    if KINDS[log.kind].command is not Command.SPLINE:
        return ""
    values = log.data[signal.name]
    found = jumps(values)
    if _is_stepped(values, len(found)):
        return "stays for two samples or more after each change, and is taken as smooth"
    return "is taken as held between its samples where it jumps" if found else ""


def _is_stepped(values: NDArray[np.float64], jumped: int) -> bool:
    """Whether a signal (n_t,) changes by any size, hardly ever at two samples in a row, and rarely by a jump."""
    change = np.diff(values[np.isfinite(values)])
    at = np.flatnonzero(change)
    if at.size < max(_FEWEST, 2 * jumped):
        return False
    size = np.abs(change[at])
    return bool(np.mean(np.diff(at) > 1) >= _STANDING and np.median(size) > _UNLIKE * size.min())
