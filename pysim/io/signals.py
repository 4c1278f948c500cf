"""Signals in files: samples of one command over time, for a model to read and for a bench to play."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from pysim.io.files import write_file
from pysim.io.text_table import read_table, read_text
from pysim.types import BadInput, Signal

_COLUMNS = ("time", "value", "rate")
# Rows of a file; more is a slip of the keyboard.
_MOST_ROWS = 10_000_000
_NUMBER = re.compile(r"[+-]?[.,]?\d")  # how a row begins


def read_signal(path: Path | str, wanted_by: str) -> Signal:
    """The signal a text file holds: time in s, value in the input's unit and, where a header names it so, its rate.

    With two columns straight lines join the samples, because they neither overshoot at a logged step nor invent
    anything between samples. With a third column called "rate", cubics meet values and rates.

    Args:
        wanted_by: what named the file, for messages.
    Raises:
        BadInput: no such file, other columns, numbers that are not finite, fewer than two rows, or a time that does
            not increase; with the line.
    """
    path = Path(path)
    names = _COLUMNS if _has_rate(read_text(path, wanted_by)) else _COLUMNS[:2]
    rows, lines = read_table(path, names, wanted_by)
    time = rows[:, 0]
    if time.size < 2:
        raise BadInput(f"{path} holds a single row; a signal needs two, or write the constant itself")
    stuck = np.flatnonzero(np.diff(time) <= 0)
    if stuck.size:
        k = stuck[0] + 1
        raise BadInput(f"{path}, line {lines[k]}: time {time[k]:g} s does not increase; sort the rows, each time once")
    return Signal.through(*rows.T) if len(names) == 3 else Signal.lines(*rows.T)


def _has_rate(text: str) -> bool:
    """Whether a line of the header, commented or not, names a third column "rate"."""
    for line in text.splitlines():
        heading = line.strip().lstrip("#").strip().lower()
        if line.strip()[:1] != "#" and _NUMBER.match(heading):
            return False
        fields = re.split(r"\s*[,;\t]\s*", heading) if re.search(r"[,;\t]", heading) else heading.split()
        if len(fields) == 3 and fields[2].startswith("rate"):
            return True
    return False


def signal_times(path: Path | str, duration: float, sampling_hz: float) -> NDArray[np.float64]:
    """Times in s of the rows of a file, (n_r,).

    Raises:
        BadInput: that are no two rows, or too many.
    """
    count = duration * sampling_hz
    if 1 <= count < _MOST_ROWS:
        return np.arange(int(np.ceil(count - 1e-9)) + 1) / sampling_hz
    raise BadInput(
        f"{path}: {duration:g} s at {sampling_hz:g} Hz give {count:.3g} rows; between 2 and {_MOST_ROWS:,} belong"
    )


def write_signal(
    signal: Signal, path: Path | str, *, duration: float, unit: str, sampling_hz: float = 1000.0, title: str = ""
) -> None:
    """Write time, value and rate of a command from zero to its end, with header lines; the file is complete or absent.

    `read_signal` brings it back: exact at the samples, and between them off by (2 pi f / sampling_hz)^4 / 384 of a
    sine's amplitude; where the command jumps or kinks, it takes one sample to do so.

    Args:
        duration: s.
        unit: of the value.
        sampling_hz: rows per second.
        title: what it is, for the header.
    Raises:
        BadInput: a duration or sampling that gives no two rows or too many, or a place that cannot be written.
    """
    time = signal_times(path, duration, sampling_hz)
    header = [f"# {line}" for line in title.splitlines()]
    header += [f"# {time.size} rows, {sampling_hz:g} per second; the rate is the exact derivative of the command"]
    header += [f"time [s],value [{unit}],rate [{unit}/s]"]
    rows = np.column_stack([time, signal.value(time), signal.derivative(time)])
    body = [f"{t:.9g},{v:.12g},{r:.12g}" for t, v, r in rows.tolist()]
    path = Path(path)
    try:
        write_file(path, "\n".join([*header, *body]) + "\n")
    except OSError as error:
        raise BadInput(f"{path}: cannot write there ({error.strerror}); choose another folder") from error
