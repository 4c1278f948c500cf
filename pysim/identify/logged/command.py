"""What a bench's command did between the samples of its log."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from pysim.identify.logged.wave import LoggedWave, logged_wave
from pysim.types import BadInput, MeasuredRecord, Record, Signal
from pysim.types.record_kind import KINDS, Command

Array = NDArray[np.float64]


def logged_command(record: MeasuredRecord, column: str, hold: Command | None = None) -> Signal:
    """The command as a function of time, with its derivative.

    A stepped sine and a chirp run by their closed form, fitted to the logged column; what leads to them and what
    follows by straight lines through the samples. Steps hold each sample until the next. Anything else runs by natural
    cubic splines through its samples, from jump to jump: a command that stood exactly still, to the last digit, for
    three samples before or after a change has jumped when the change is more than three times that of its other side,
    and did so at the sample that shows it first. Where noise hides that, the spline overshoots by a tenth. Before the
    first sample its value holds.

    Args:
        record: a log over time.
        column: name of the logged command.
        hold: how it runs between samples, STEPS, LINES or SPLINE; None as the record's kind says.
    Returns:
        in the column's unit, in the log's time.
    Raises:
        BadInput: no such column, no log over time, or a column that is not what the record's kind says.
    """
    if not isinstance(record.data, Record):
        raise BadInput(f"{record.source}: holds a response over frequency; only a log over time has a command")
    time, values = record.data.time, record.data[column]
    command = hold or KINDS[record.kind].command
    if command is Command.STEPS:
        changes = np.append(True, np.diff(values) != 0)
        return Signal.steps(time[changes], values[changes])
    if command is Command.LINES:
        return Signal.lines(time, values)
    if command in (Command.SINE, Command.CHIRP):
        return _around(logged_wave(record, column), time, values)
    return _from_jump_to_jump(time, values)


# A jump is more than so many times what the command moves by beside it.
_JUMP = 3.0


def _from_jump_to_jump(time: Array, values: Array) -> Signal:
    edges = [0, *jumps(values), values.size]
    parts = []
    for first, end in pairwise(edges):
        if end - first < 2:
            parts.append(Signal.steps(time[first:end], values[first:end]))
        else:
            parts.append(Signal.through(time[first:end], values[first:end]))
    if len(parts) == 1:
        return parts[0]
    starts, cubics, sines = (
        np.concatenate([getattr(part, name) for part in parts]) for name in ("starts", "cubics", "sines")
    )
    keep = np.append(np.diff(starts) > 0, True)
    return Signal(starts[keep], cubics[keep], sines[keep])


def jumps(values: Array) -> list[int]:
    """Samples (of n_t) that a jump of a command shows in first."""
    change = np.abs(np.diff(values))
    if change.size < 3:
        return []
    still = np.concatenate([[False], (change[:-1] == 0) & (change[1:] == 0), [False]])  # the middle one of three
    before = np.concatenate([[False], still[:-2]])  # change k lies between samples k and k + 1
    after = np.append(still[2:], False)
    last, following = np.append(0.0, change[:-1]), np.append(change[1:], 0.0)
    jumped = (before & (change > _JUMP * following)) | (after & (change > _JUMP * last))
    return (np.flatnonzero(jumped & (change > 0)) + 1).tolist()


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
