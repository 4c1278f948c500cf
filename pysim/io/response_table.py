"""Read a table of frequency, magnitude and phase."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from pysim.io.text_table import read_table
from pysim.types import BadInput, FrequencyResponse, SineTest

Array = NDArray[np.float64]

TABLE_COLUMNS = ("frequency_hz", "magnitude_db", "phase_deg")


def read_response(
    path: Path, columns: tuple[str, ...], test: SineTest, wanted_by: str, *, scale: float, origin: str
) -> FrequencyResponse:
    """One response.

    Args:
        columns: names in the order of the file; those of TABLE_COLUMNS among them.
        test: what was commanded, in SI units.
        wanted_by: what named the file, for messages.
        scale: gain in SI units for a gain of one in the file.
        origin: what the numbers are, for legends and tables.
    Raises:
        BadInput: what is wrong, with file, line and remedy.
    """
    values, lines = read_table(path, columns, wanted_by)
    frequency, magnitude, phase = (values[:, columns.index(name)] for name in TABLE_COLUMNS)
    steps = np.diff(frequency, prepend=0.0)
    if np.any(steps <= 0):
        where = f"{path}, line {lines[int(np.argmax(steps <= 0))]}"
        raise BadInput(f"{where}: frequencies must be positive and increase; sort the rows, drop repeated ones")
    gain = scale * 10 ** (magnitude / 20)
    return FrequencyResponse(frequency, gain, continuous_phase(phase), test, origin)


def continuous_phase(degrees: Array) -> Array:
    """Phases (n_f,) in rad without the jumps of a whole turn that instruments write.

    Unwrapping takes every step for less than half a turn, which a coarse table need not keep. So it is done only
    where the numbers look wrapped: all in -180..180 or all in 0..360 degrees, or all within one turn of which a step
    rises by more than half, as no lag does. Other phases are continuous already and stay as they are.
    """
    low, high = float(np.min(degrees)), float(np.max(degrees))
    customary = (low >= -180 and high <= 180) or (low >= 0 and high <= 360)
    rises = high - low <= 360 and bool(np.any(np.diff(degrees) > 180))
    radians = np.radians(degrees)
    return np.unwrap(radians) if customary or rises else radians
