"""QR triangle of a tall matrix, made row by row, so that memory does not grow with the number of rows."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

ROWS = 8192  # rows that are factorised at a time: a few MB


def triangle(parts: Iterable[Array]) -> Array:
    """R (m, m) of the QR factorisation of all parts (n_i, m) stacked; the last rows are zero if there are fewer than m.

    Source: Demmel, Grigori, Hoemmen and Langou 2012, SIAM Journal on Scientific Computing 34:A206.
    """
    found: Array | None = None
    for part in parts:
        for first in range(0, max(len(part), 1), ROWS):
            rows = part[first : first + ROWS]
            found = np.zeros((0, rows.shape[1])) if found is None else found
            found = np.asarray(np.linalg.qr(np.concatenate([found, rows]), mode="r"))
    if found is None:
        return np.zeros((0, 0))
    missing = found.shape[1] - len(found)
    return np.concatenate([found, np.zeros((missing, found.shape[1]))]) if missing > 0 else found
