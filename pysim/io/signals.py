"""Signals from files: samples of one input over time."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from pysim.io.text_table import read_table
from pysim.types import BadInput, Signal


def read_signal(path: Path, wanted_by: str) -> Signal:
    """Straight lines through the samples of a text file with two columns, time in s and value in the input's unit.

    Straight lines, because they neither overshoot at a logged step nor invent anything between samples.

    Args:
        wanted_by: what named the file, for messages.
    Raises:
        BadInput: no such file, not two columns of finite numbers, fewer than two rows, or a time that does not
            increase; with the line.
    """
    rows, lines = read_table(path, ("time", "value"), wanted_by)
    time, value = rows.T
    if time.size < 2:
        raise BadInput(f"{path} holds a single row; a signal needs two, or write the constant itself")
    stuck = np.flatnonzero(np.diff(time) <= 0)
    if stuck.size:
        k = stuck[0] + 1
        raise BadInput(f"{path}, line {lines[k]}: time {time[k]:g} s does not increase; sort the rows, each time once")
    return Signal.lines(time, value)
