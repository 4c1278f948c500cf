"""A bench's command between the samples of its log."""

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

    A stepped sine or chirp has its closed form, fitted to the logged column, and straight lines through the samples
    before and after. Steps hold each sample until the next. Any other command is interpolated by natural cubic splines
    from jump to jump. A change is a jump if the command was exactly constant for three samples before or after it, and
    the change is more than three times the one on its other side, and more than a digit of rounding; the jump is at the
    first sample that shows it. If noise hides this, the spline overshoots a jump by a tenth. Before the first sample,
    the command has its value.

    Args:
        record: a log over time.
        column: name of the logged command.
        hold: interpolation between samples, STEPS, LINES or SPLINE; None takes that of the record, else of its kind.
    Returns:
        the command in the column's unit, in the log's time.
    Raises:
        BadInput: no such column, no log over time, or a column that does not match the record's kind."""
    if not isinstance(record.data, Record):
        raise BadInput(f"{record.source}: holds a response over frequency; only a log over time has a command")
    time, values = record.data.time, record.data[column]
    command = hold or record.holds.get(column, KINDS[record.kind].command)
    if command is Command.STEPS:
        changes = np.append(True, np.diff(values) != 0)
        return Signal.steps(time[changes], values[changes])
    if command is Command.LINES:
        return Signal.lines(time, values)
    if command in (Command.SINE, Command.CHIRP):
        return _around(logged_wave(record, column), time, values)
    return _from_jump_to_jump(time, values)


_JUMP = 3.0  # smallest ratio of a jump to the change next to it
_FINE = 0.01  # largest share of a rounded command's range that one digit is; coarser ones run in steps
_ROUNDED = 20  # fewest changes of a command whose smallest one counts as a digit
_DIGIT = 1.5  # digits: a larger change is more than rounding


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
    """Indices of the first sample after each jump of a command (n_t,); a change of one digit of rounding is none."""
    change = np.abs(np.diff(values))
    if change.size < 3:
        return []
    still = np.concatenate([[False], (change[:-1] == 0) & (change[1:] == 0), [False]])  # middle of three equal samples
    before = np.concatenate([[False], still[:-2]])  # change k lies between samples k and k + 1
    after = np.append(still[2:], False)
    last, following = np.append(0.0, change[:-1]), np.append(change[1:], 0.0)
    jumped = (before & (change > _JUMP * following)) | (after & (change > _JUMP * last))
    return (np.flatnonzero(jumped & (change > _DIGIT * _digit(values, change))) + 1).tolist()


def _digit(values: Array, change: Array) -> float:
    """The digit to which a command (n_t,) was rounded; 0 if it has few changes or is rounded coarsely."""
    moved = change[change > 0]
    if moved.size < _ROUNDED:
        return 0.0
    digit = float(moved.min())
    return digit if digit <= _FINE * float(np.ptp(values)) else 0.0


def _around(wave: LoggedWave, time: Array, values: Array) -> Signal:
    """Signal of straight lines to the wave's start, the wave, and straight lines from its end."""
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
    """A wave as starts (1,), cubics (1, 4) and sines (1, 1, 4) of a `Signal`."""
    sine = [wave.amplitude, wave.phase, 2 * np.pi * wave.frequency, 2 * np.pi * wave.rate]
    return np.array([wave.start]), np.array([[wave.offset, 0.0, 0.0, 0.0]]), np.array([[sine]])
