"""A command as a closed-form function of time, with its exact derivative."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pysim.types._frozen import frozen_array
from pysim.types._spline import hermite, natural_rates
from pysim.types.errors import BadInput

Array = NDArray[np.float64]

# Pieces computed one by one in double precision meet within this share of the largest value.
_ROUNDING = 1e-9
# So many sines are evaluated at once.
_PART = 2**16


@dataclass(frozen=True)
class Signal:
    """Pieces of a cubic plus sines of linearly changing frequency; before the first piece its start value holds.

    In piece k, with s = t - starts[k] and s not beyond the next piece's start:
        y(s) = sum_n cubics[k, n] s^n
             + sum_j a_j sin(phi_j + omega_j s + 0.5 kappa_j s^2),   (a, phi, omega, kappa) = sines[k, j]
    This one form holds steps, ramps, stepped sines (thesis Eq. 2.1), chirps (Eq. 2.2), stochastic waves (Appendix A)
    and splines through logged samples. The signal may jump or kink only where a piece starts.

    `Signal.constant`, `steps`, `lines` and `through` make the usual ones.

    Args:
        starts: (n_k,) s, increasing.
        cubics: (n_k, 4) in the signal's unit per s^n.
        sines: (n_k, n_j, 4) amplitude (unit), phase (rad), angular frequency (rad/s), its rate (rad/s^2);
            unused rows are zero.
    Raises:
        BadInput: shapes that do not match, times that do not increase, or values that are not finite.
    """

    starts: Array
    cubics: Array
    sines: Array

    def __post_init__(self) -> None:
        for name in ("starts", "cubics", "sines"):
            object.__setattr__(self, name, frozen_array(getattr(self, name)))
        n_k = self.starts.size
        if self.starts.shape != (n_k,) or n_k == 0 or self.cubics.shape != (n_k, 4):
            raise BadInput(
                f"signal pieces: starts {self.starts.shape} need cubics of shape ({n_k}, 4), got {self.cubics.shape}"
            )
        if self.sines.ndim != 3 or self.sines.shape[::2] != (n_k, 4):
            raise BadInput(f"signal pieces: sines need shape ({n_k}, n, 4), got {self.sines.shape}")
        if not all(np.isfinite(a).all() for a in (self.starts, self.cubics, self.sines)):
            raise BadInput("signal pieces: every number must be finite")
        if np.any(np.diff(self.starts) <= 0):
            raise BadInput("signal pieces: starts must increase")

    @classmethod
    def constant(cls, value: float) -> Signal:
        """The same value at all times, in the signal's unit."""
        return cls.steps([0.0], [value])

    @classmethod
    def steps(cls, times: ArrayLike, values: ArrayLike) -> Signal:
        """values[k] from times[k] (n_t,) in s on; before the first time the first value holds.

        Raises:
            BadInput: rows that differ in length, times that do not increase, or numbers that are not finite.
        """
        t, v = _samples(times, values, least=1)
        return cls._of_cubics(t, np.column_stack([v, np.zeros((t.size, 3))]))

    @classmethod
    def lines(cls, times: ArrayLike, values: ArrayLike) -> Signal:
        """Straight lines from sample to sample, (n_t,) each, times in s; the first and the last value hold outside.

        Raises:
            BadInput: fewer than two samples, and as `steps`.
        """
        t, v = _samples(times, values, least=2)
        cubics = np.zeros((t.size, 4))
        cubics[:, 0] = v
        np.divide(np.diff(v), np.diff(t), out=cubics[:-1, 1])
        return cls._of_cubics(t, cubics)

    @classmethod
    def through(cls, times: ArrayLike, values: ArrayLike, rates: ArrayLike | None = None) -> Signal:
        """A smooth curve through samples, (n_t,) each, times in s; the first and the last value hold outside.

        Args:
            times: s, increasing.
            values: in the signal's unit.
            rates: in its unit per s, met exactly. Where None they follow from the natural cubic spline: the curvature
                is continuous and vanishes at both ends.
        Raises:
            BadInput: fewer than two samples, and as `steps`.
        """
        t, v = _samples(times, values, least=2)
        m = natural_rates(t, v) if rates is None else _samples(times, rates, least=2)[1]
        return cls._of_cubics(t, np.vstack([hermite(t, v, m), [v[-1], 0.0, 0.0, 0.0]]))

    @classmethod
    def _of_cubics(cls, starts: Array, cubics: Array) -> Signal:
        cubics.setflags(write=False)  # so that it is not copied
        return cls(starts, cubics, np.zeros((starts.size, 0, 4)))

    def value(self, t: Array) -> Array:
        """The signal at times t (n_t,) in s, in its own unit; to the right of a jump."""
        return self._value(*self._locate(t))

    def derivative(self, t: Array) -> Array:
        """The signal's rate at times t (n_t,) in s, in its unit per s; to the right of a kink."""
        return np.where(np.asarray(t) < self.starts[0], 0.0, self._rate(*self._locate(t)))

    def plus(self, other: Signal) -> Signal:
        """The sum of two signals, exact."""
        starts = np.union1d(self.starts, other.starts)
        (cubics, sines), (more, waves) = self._pieces_at(starts), other._pieces_at(starts)
        return Signal(starts, cubics + more, np.concatenate([sines, waves], axis=1))

    def later(self, by: float) -> Signal:
        """The same so many s later."""
        return replace(self, starts=self.starts + by)

    def times(self, factor: float) -> Signal:
        """The signal so many times as large."""
        sines = self.sines.copy()
        sines[:, :, 0] *= factor
        return Signal(self.starts, factor * self.cubics, sines)

    def breaks(self) -> tuple[NDArray[np.bool_], NDArray[np.bool_]]:
        """Per piece (n_k,), whether the value jumps and whether the rate jumps where the piece starts."""
        count = self.starts.size
        parts = [np.arange(first, min(first + _PART, count)) for first in range(0, count, _PART)]
        sizes = [[np.max(np.abs(sides)) for sides in self._sides(part)] for part in parts]
        least = _ROUNDING * np.max(sizes, axis=0)
        differ = [
            [np.abs(after - before) > size for (before, after), size in zip(self._sides(part), least, strict=True)]
            for part in parts
        ]
        jumps, kinks = (np.concatenate(rows) for rows in zip(*differ, strict=True))
        return jumps, kinks

    def _sides(self, k: NDArray[np.intp]) -> tuple[tuple[Array, Array], tuple[Array, Array]]:
        """Value and rate on both sides of where pieces k (n,) start."""
        before, at_start = np.maximum(k - 1, 0), np.zeros(k.size)
        length = self.starts[k] - self.starts[before]
        rate_before = np.where(k > 0, self._rate(before, length), 0.0)
        value = self._value(before, length), self._value(k, at_start)
        return value, (rate_before, self._rate(k, at_start))

    def _locate(self, t: Array) -> tuple[NDArray[np.intp], Array]:
        """Piece and time within it."""
        t = np.asarray(t, dtype=np.float64)
        k = np.maximum(np.searchsorted(self.starts, t, side="right") - 1, 0)
        return k, np.maximum(t - self.starts[k], 0.0)

    def _pieces_at(self, starts: Array) -> tuple[Array, Array]:
        """Cubics (n, 4) and sines (n, n_j, 4) of pieces that start at `starts` (n,), all its own starts among them."""
        k, s = self._locate(starts)
        c, cubics, sines = self.cubics[k], np.zeros((starts.size, 4)), self.sines[k].copy()
        cubics[:, 0] = c[:, 0] + s * (c[:, 1] + s * (c[:, 2] + s * c[:, 3]))
        cubics[:, 1] = c[:, 1] + s * (2 * c[:, 2] + 3 * s * c[:, 3])
        cubics[:, 2] = c[:, 2] + 3 * s * c[:, 3]
        cubics[:, 3] = c[:, 3]
        time, kappa = s[:, None], sines[:, :, 3]
        sines[:, :, 1] += time * (sines[:, :, 2] + 0.5 * kappa * time)
        sines[:, :, 2] += kappa * time
        before = starts < self.starts[0]
        cubics[before] = 0.0
        cubics[before, 0] = float(self.value(self.starts[:1])[0])
        sines[before] = 0.0
        return cubics, sines

    def _value(self, k: NDArray[np.intp], s: Array) -> Array:
        c = self.cubics[k]
        return c[..., 0] + s * (c[..., 1] + s * (c[..., 2] + s * c[..., 3])) + self._waves(k, s, _wave_value)

    def _rate(self, k: NDArray[np.intp], s: Array) -> Array:
        c = self.cubics[k]
        return c[..., 1] + s * (2 * c[..., 2] + 3 * s * c[..., 3]) + self._waves(k, s, _wave_rate)

    def _waves(self, k: NDArray[np.intp], s: Array, of: Callable[[Array, Array], Array]) -> Array:
        """The sum over a piece's sines of `of`, in parts that stay in the processor's cache."""
        total = np.zeros(np.shape(s))
        piece, time, flat = np.ravel(k), np.ravel(s), total.reshape(-1)
        if not self.sines.size:
            return total
        if piece.size == 1:  # as for the value at one time: finding out who swings would take longer
            flat[:] = of(self.sines[piece[0]], time[:, None]).sum(axis=-1)
            return total
        swinging = np.flatnonzero(np.any(self.sines[:, :, 0] != 0, axis=1))
        for number in np.intersect1d(swinging, piece):
            at, sines = np.flatnonzero(piece == number), self.sines[number]
            for part in np.array_split(at, -(-at.size * sines.shape[0] // _PART)):
                flat[part] = of(sines, time[part, None]).sum(axis=-1)
        return total


def _wave_value(sines: Array, s: Array) -> Array:
    """(n, n_j) from sines (n_j, 4) and times (n, 1)."""
    a, phi, omega, kappa = sines.T
    return np.asarray(a * np.sin(phi + (omega + 0.5 * kappa * s) * s))


def _wave_rate(sines: Array, s: Array) -> Array:
    """(n, n_j) from sines (n_j, 4) and times (n, 1)."""
    a, phi, omega, kappa = sines.T
    return np.asarray(a * (omega + kappa * s) * np.cos(phi + (omega + 0.5 * kappa * s) * s))


def _samples(times: ArrayLike, values: ArrayLike, *, least: int) -> tuple[Array, Array]:
    """Checked rows of equal length (n_t,)."""
    try:
        t, v = frozen_array(times), frozen_array(values)
    except (TypeError, ValueError) as error:
        raise BadInput(f"signal: times and values must be rows of numbers ({error})") from error
    if t.ndim != 1 or t.shape != v.shape or t.size < least:
        raise BadInput(
            f"signal: needs rows of at least {least} times and as many values, got shapes {t.shape} and {v.shape}"
        )
    if not (np.isfinite(t).all() and np.isfinite(v).all() and (np.diff(t) > 0).all()):
        raise BadInput("signal: times and values must be finite, and times increase")
    return t, v
