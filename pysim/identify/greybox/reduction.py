"""The rows of a long log as triangles, made while the run goes on: memory does not grow with the rows.

Sums of squares and products of residuals and slopes are all that a search and its intervals ask for, and the triangle
of a QR factorisation has the same ones as its rows. There is one for each channel, with its own level, and block.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from pysim.identify.greybox.effective_size import independent_pieces

Array = NDArray[np.float64]
Rows = NDArray[np.intp]


class Reduction:
    """Rows of one log at one point.

    Args:
        measured: (n_t, n_y) what each recorded row is compared with.
        pieces: stretches of the log that count as independent of each other, as at the point before; 0 where not known.
        blocks: to which these are dealt out in turn.
    """

    def __init__(self, measured: Array, pieces: int, blocks: int) -> None:
        self._measured, self._pieces, self._blocks = measured, max(pieces, blocks), blocks
        self._residual: Array = np.zeros((0, 0))
        self._triangles: dict[tuple[int, int], Array] = {}
        self._chain, self._free = np.zeros((0, 0)), np.zeros(0, dtype=np.intp)

    def begin(self, chain: Array, free: NDArray[np.intp]) -> None:
        """Expect slopes by variables, of which the search's numbers are (n_v, n_x), and of the states the free ones."""
        self._chain, self._free = chain, free

    def take(self, first: int, values: Array, slopes: Array) -> None:
        """Rows from number `first` on: values (n, n_y), slopes (n, n_y, n_s + n_v) by initial states and variables."""
        if first == 0:
            self._residual, self._triangles = np.zeros_like(self._measured), {}
        own, split = slice(first, first + len(values)), slopes.shape[2] - len(self._chain)
        self._residual[own] = self._measured[own] - values
        by_x, by_initial = slopes[..., split:] @ self._chain, slopes[..., self._free]
        table = np.concatenate([self._residual[own, :, None], -by_x, -by_initial], axis=2)
        block = np.arange(own.start, own.stop) * self._pieces // len(self._measured) % self._blocks
        order = np.argsort(block, kind="stable")
        edges = np.searchsorted(block[order], np.arange(self._blocks + 1))
        for b in np.flatnonzero(np.diff(edges)).tolist():
            for channel in range(values.shape[1]):
                rows = table[order[edges[b] : edges[b + 1]], channel]
                before = self._triangles.get((channel, b), np.zeros((0, rows.shape[1])))
                self._triangles[channel, b] = np.asarray(np.linalg.qr(np.concatenate([before, rows]), mode="r"))

    @property
    def arrays(self) -> tuple[Array, ...]:
        """All numbers that it keeps."""
        return (self._residual, *self._triangles.values())

    @property
    def table(self) -> Array:
        """(n, 1 + n_x + n_s) as `Observation.residual`, with the same sums of squares and products."""
        return np.concatenate([*self._triangles.values()])

    @property
    def channel(self) -> Rows:
        """(n,) place among the log's channels of each row."""
        return np.concatenate([np.full(len(rows), key[0]) for key, rows in self._triangles.items()])

    @property
    def block(self) -> Rows:
        """(n,) block of each row."""
        return np.concatenate([np.full(len(rows), key[1]) for key, rows in self._triangles.items()])

    @property
    def count(self) -> int:
        """Rows that these stand for."""
        return self._measured.size

    def pieces(self, shortest: float) -> int:
        """How many pieces the residual asks for, each as long as so many of its memories."""
        return independent_pieces(self._residual, shortest)
