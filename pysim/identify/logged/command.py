"""What a bench's command did between the samples of its log."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from pysim.identify.logged.wave import CHIRP, STEPPED_SINE, LoggedWave, logged_wave
from pysim.types import BadInput, MeasuredRecord, Record, Signal

Array = NDArray[np.float64]


def logged_command(record: MeasuredRecord, column: str) -> Signal:
    """The command as a function of time, with its derivative.

    A stepped sine and a chirp run by their closed form, fitted to the logged column; what leads to them and what
    follows by straight lines through the samples. Anything else runs by the natural cubic spline through its samples,
    which overshoots by a tenth where the command jumps. Before the first sample its value holds.

    Args:
        record: a log over time.
        column: name of the logged command.
    Returns:
        in the column's unit, in the log's time.
    Raises:
        BadInput: no such column, no log over time, or a column that is not what the record's kind says.
    """
    if not isinstance(record.data, Record):
        raise BadInput(f"{record.source}: holds a response over frequency; only a log over time has a command")
    time, values = record.data.time, record.data[column]
    if record.kind not in (STEPPED_SINE, CHIRP):
        return Signal.through(time, values)
    return _around(logged_wave(record, column), time, values)


def _around(wave: LoggedWave, time: Array, values: Array) -> Signal:
    """Lines to the wave's start, the wave, and lines from its end."""
    before, behind = time < wave.start, time > wave.end
    pieces = [wave_piece(wave)]
    if before.any():
        lead = Signal.lines(
            np.append(time[before], wave.start), np.append(values[before], wave.value(np.array([wave.start])))
        )
        pieces = [(lead.starts[:-1], lead.cubics[:-1], np.zeros((lead.starts.size - 1, 1, 4))), *pieces]
    if behind.any():
        tail = Signal.lines(
            np.append(wave.end, time[behind]), np.append(wave.value(np.array([wave.end])), values[behind])
        )
        pieces.append((tail.starts, tail.cubics, np.zeros((tail.starts.size, 1, 4))))
    starts, cubics, sines = (np.concatenate(parts) for parts in zip(*pieces, strict=True))
    return Signal(starts, cubics, sines)


def wave_piece(wave: LoggedWave) -> tuple[Array, Array, Array]:
    """starts (1,), cubics (1, 4) and sines (1, 1, 4) of a `Signal`."""
    sine = [wave.amplitude, wave.phase, 2 * np.pi * wave.frequency, 2 * np.pi * wave.rate]
    return np.array([wave.start]), np.array([[wave.offset, 0.0, 0.0, 0.0]]), np.array([[sine]])
