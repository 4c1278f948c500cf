"""Gram matrices of a law's Jacobian, the residual and the parameters' Jacobian, for a penalised regression."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from pysim.identify.greybox import Point, WeightedResiduals
from pysim.identify.greybox.identifiability import EXACT
from pysim.identify.greybox.residuals import Channel

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Products:
    """Gram matrices T'T, channel by channel, of the table T = [parameters' Jacobian, residual, law's Jacobian].

    Args:
        point: with the Jacobian of the parameters.
        channel: (n_r,) number of each row's channel; n_c for rows whose level is known.
        floors, samples: (n_c,) least variance and number of samples of each channel.
        noise: (n_c,) variance of the noise.
        parts: (n_c + 1, k, k) Gram matrices; k columns in all.
        size: number by which the law's Jacobian is divided.
    """

    point: Point = field(repr=False)
    channel: NDArray[np.intp] = field(repr=False)
    floors: Array
    samples: Array
    noise: Array
    parts: Array = field(repr=False)
    size: float = 1.0

    @classmethod
    def at(cls, point: Point, residuals: WeightedResiduals, noise: Mapping[Channel, float] | None = None) -> Products:
        """Start from a point of these residuals, without a law.

        Args:
            noise: standard deviation of the noise of each channel; its least level if None.
        """
        place = {channel: i for i, channel in enumerate(residuals.channels)}
        own = [-1 if name is None else place[one.dataset, name] for one, name in residuals.series]
        channel = np.array([-1, *own], dtype=np.intp)[point.series + 1]
        channel = np.where(channel < 0, len(place), channel)
        floors = np.array([residuals.floors[name].sd ** 2 for name in residuals.channels])
        sizes = floors if noise is None else np.array([noise[name] ** 2 for name in residuals.channels])
        return cls(point, channel, floors, residuals.samples, sizes, np.zeros((0, 0, 0)))

    @property
    def rows(self) -> float:
        """Number of rows, priors included."""
        return float(self.point.count)

    def with_(self, columns: Array, *, scaled: bool = True) -> Products:
        """The Gram matrices with a law's Jacobian (n_r, m), divided by its rms column norm if `scaled`."""
        size = float(np.linalg.norm(columns)) / math.sqrt(columns.shape[1]) if scaled else 1.0
        table = np.column_stack([self.point.jacobian, self.point.residual, columns / size])
        own = [table[self.channel == c] for c in range(self.samples.size + 1)]
        return replace(self, parts=np.array([t.T @ t for t in own]), size=size)

    def _split(self, weights: Array) -> tuple[Array, Array]:
        """Weighted Gram matrix (1 + m, 1 + m) of residual and law, projected off the parameters; and the regression."""
        n = self.point.x.size
        whole = np.tensordot(weights, self.parts, 1)
        by = np.linalg.pinv(whole[:n, :n], rcond=EXACT, hermitian=True) @ whole[:n, n:]
        return whole[n:, n:] - whole[n:, :n] @ by, by

    def across(self, weights: Array) -> tuple[Array, Array, float]:
        """A'A, A'r and r'r of the law's Jacobian A and the residual r, projected off the parameters."""
        rest, _ = self._split(weights)
        return rest[1:, 1:], rest[1:, 0], float(rest[0, 0])

    @property
    def beyond_parameters(self) -> float:
        """Share of the norm of the law's Jacobian that the model's parameters cannot imitate, 0 ... 1."""
        gram = self.across(np.ones(self.samples.size + 1))[0]
        whole = np.trace(self.parts[:, -len(gram) :, -len(gram) :].sum(axis=0))
        return math.sqrt(max(float(np.trace(gram)) / float(whole), 0.0))

    def left(self, weights: Array, values: Array) -> Array:
        """(n_c + 1,) sums of squares over the point's levels that remain with a law's coefficients (m,)."""
        _, by = self._split(weights)
        own = np.append(1.0, values)
        whole = np.append(-by @ own, own)
        return np.asarray(np.einsum("i,cij,j->c", whole, self.parts, whole))

    def _variances(self, left: Array) -> Array:
        """(n_c,) residual variances of the channels, squares included that no model changes."""
        own = np.diagonal(self.parts, axis1=1, axis2=2)[:-1, self.point.x.size]
        squares = self.point.squares + (left[:-1] - own) * self.point.levels**2
        return np.asarray(np.maximum(squares, 0.0) / np.maximum(self.samples, 1.0))

    def weights(self, left: Array) -> Array:
        """(n_c + 1,) weights of squared rows if the levels are those of what is left."""
        return np.append(self.point.levels**2 / np.maximum(self._variances(left), self.floors), 1.0)

    def gain(self, left: Array) -> float:
        """Nats by which the cost falls if the sums of squares become `left`."""
        before = np.diagonal(self.parts, axis1=1, axis2=2)[:, self.point.x.size]
        costs = [self._costs(self._variances(one)) for one in (before, left)]
        return float(costs[0] - costs[1] + 0.5 * (before[-1] - left[-1]))

    def share(self, left: Array) -> float:
        """Share of the avoidable sum of squares (beyond the noise) that is gone if the sums become `left`."""
        before = np.diagonal(self.parts, axis1=1, axis2=2)[:, self.point.x.size]
        ratios = [self._variances(one) / self.noise for one in (before, left)]
        most = float(np.sum(self.samples * np.maximum(ratios[0] - 1, 0)))
        return float(np.clip(np.sum(self.samples * (ratios[0] - ratios[1])) / max(most, 1e-9), 0.0, 1.0))

    def _costs(self, variances: Array) -> float:
        above = np.maximum(variances, self.floors)
        return float(0.5 * np.sum(self.samples * (np.log(above) + np.minimum(variances / self.floors, 1.0) - 1)))
