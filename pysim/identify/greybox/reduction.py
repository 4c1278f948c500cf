"""Residual and Jacobian of a long log as QR triangles, made during the run, so that memory does not grow with the log.

A search and its intervals need only sums of squares and products of residual and Jacobian. The triangle of a QR
factorisation has the same ones as its rows. There is one triangle for each channel and block.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from pysim.identify.greybox.effective_size import independent_pieces, piece_of_sample

Array = NDArray[np.float64]
Rows = NDArray[np.intp]


class Reduction:
    """Reduced rows of one log at one point.

    Args:
        measured: (n_t, n_y) measured values of each row; not-a-number where nothing was measured, which has no part.
        pieces: number of stretches of the log that count as independent, from the point before; 0 if not known.
        blocks: number of blocks, to which the pieces are assigned in turn.
    """

    def __init__(self, measured: Array, pieces: int, blocks: int) -> None:
        self._measured, self._pieces, self._blocks = measured, max(pieces, blocks), blocks
        self._there = np.isfinite(measured)
        self._block = piece_of_sample(self._there, self._pieces) % blocks
        self._residual: Array = np.zeros((0, 0))
        self._triangles: dict[tuple[int, int], Array] = {}
        self._chain, self._free = np.zeros((0, 0)), np.zeros(0, dtype=np.intp)

    def begin(self, chain: Array, free: NDArray[np.intp]) -> None:
        """Set the derivatives of variables by search coordinates (n_v, n_x), and the indices of free initial states."""
        self._chain, self._free = chain, free

    def take(self, first: int, values: Array, slopes: Array) -> None:
        """Add rows from number `first` on: values (n, n_y), derivatives by states and variables (n, n_y, n_s + n_v)."""
        if first == 0:
            self._residual, self._triangles = np.zeros_like(self._measured), {}
        own, split = slice(first, first + len(values)), slopes.shape[2] - len(self._chain)
        there = self._there[own]
        self._residual[own] = np.where(there, self._measured[own] - values, 0.0)
        by_x, by_initial = slopes[..., split:] @ self._chain, slopes[..., self._free]
        table = np.concatenate([self._residual[own, :, None], -by_x, -by_initial], axis=2)
        block = self._block[own]
        order = np.argsort(block, kind="stable")
        edges = np.searchsorted(block[order], np.arange(self._blocks + 1))
        for b in np.flatnonzero(np.diff(edges)).tolist():
            for channel in range(values.shape[1]):
                places = order[edges[b] : edges[b + 1]]
                rows = table[places[there[places, channel]], channel]
                if not len(rows):
                    continue
                before = self._triangles.get((channel, b), np.zeros((0, rows.shape[1])))
                self._triangles[channel, b] = np.asarray(np.linalg.qr(np.concatenate([before, rows]), mode="r"))

    @property
    def arrays(self) -> tuple[Array, ...]:
        """All arrays that are kept."""
        return (self._residual, *self._triangles.values())

    @property
    def table(self) -> Array:
        """(n, 1 + n_x + n_s) like `Observation.residual`, with fewer rows but the same sums of squares and products."""
        return np.concatenate([*self._triangles.values()])

    @property
    def channel(self) -> Rows:
        """(n,) index of each row's channel."""
        return np.concatenate([np.full(len(rows), key[0]) for key, rows in self._triangles.items()])

    @property
    def block(self) -> Rows:
        """(n,) block of each row."""
        return np.concatenate([np.full(len(rows), key[1]) for key, rows in self._triangles.items()])

    @property
    def count(self) -> int:
        """Number of rows that the triangles stand for, n_t n_y where nothing is missing."""
        return int(np.count_nonzero(self._there))

    def pieces(self, shortest: float) -> int:
        """Number of independent pieces of the residual, see `independent_pieces`."""
        columns = zip(self._residual.T, self._there.T, strict=True)
        return independent_pieces([rest[there] for rest, there in columns], shortest)
