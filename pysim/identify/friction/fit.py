"""Friction parameters from samples of speed and torque: thesis Eq. 6.1, or least squares weighted by the noise."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray
from scipy.special import stdtrit

from pysim.identify.friction.correlated import correlation_length, score_covariance
from pysim.identify.friction.law import FRICTION_NAMES, mean_friction, mean_slopes
from pysim.identify.friction.samples import FrictionSamples
from pysim.identify.friction.steepness import Solution, steepness
from pysim.types import BadInput

Array = NDArray[np.float64]

# r: from a transition over tens of rad/s to one that no sensor resolves; torques: up to ten times those of Table 6.2
FRICTION_BOUNDS: Mapping[str, tuple[float, float]] = MappingProxyType(
    {"r": (0.01, 1e3), "omega_0": (0.1, 200.0), "tau_c": (0.0, 500.0), "tau_s": (0.0, 500.0)}
)
_SIZES = np.array([10.0, 10.0, 10.0, 10.0])  # typical sizes of the parameters, for the optimiser's steps
_STARTS = ((30.0, 3.0), (30.0, 20.0), (1.0, 10.0))  # r and omega_0


@dataclass(frozen=True)
class FrictionFit:
    """Estimates with their intervals and covariance.

    Args:
        parameters: name -> estimate; r in s/rad, omega_0 in rad/s, torques in N.m.
        intervals: name -> 95 percent interval; for r, an end that the data do not determine is infinite or 0.
        bounded: names for which the data determine one end of the interval at most. The estimate is then the first
            value on the way to the open end from which on the fit does not change any more.
        covariance: (4, 4) of the parameters in the order of `FRICTION_NAMES`; zero for those in `bounded`.
        residuals: (n,) N.m, measured minus fitted.
        effective: effective sample size of the residuals.
        at_bound: names of estimates at a bound.
        weighted: whether samples were weighted by the noise; if not, all have the same weight, as in Eq. 6.1.
        samples: the fitted samples, one set per test.
    """

    parameters: Mapping[str, float]
    intervals: Mapping[str, tuple[float, float]]
    bounded: tuple[str, ...]
    covariance: Array = field(repr=False)
    residuals: Array = field(repr=False)
    effective: float
    at_bound: tuple[str, ...]
    weighted: bool
    samples: tuple[FrictionSamples, ...] = field(repr=False)

    @property
    def vector(self) -> Array:
        """The estimates, (4,), in the order of `FRICTION_NAMES`."""
        return np.array([self.parameters[name] for name in FRICTION_NAMES])

    @property
    def quantile(self) -> float:
        """Half width of a 95 percent interval in standard deviations: Student's t at the effective sample size."""
        return _quantile(self.effective, len(FRICTION_NAMES) - len(self.bounded))

    @property
    def rms(self) -> float:
        """Root-mean-square residual, N.m."""
        return float(np.sqrt(np.mean(self.residuals**2)))

    @property
    def blind_below(self) -> float:
        """The lowest measured speed, rad/s; below it, the curve is an extrapolation of the law."""
        return float(min(np.abs(s.speed).min() for s in self.samples))


def _quantile(effective: float, free: int) -> float:
    return float(stdtrit(max(effective - free, 1.0), 0.975))


@dataclass(frozen=True)
class _Rows:
    """Samples of all tests in a row; weight (n,) is one over the standard deviation, or one."""

    speed: Array
    change: Array
    torque: Array
    weight: Array
    lengths: tuple[int, ...]

    def errors(self, p: Array) -> Array:
        """Weighted errors, fitted minus measured, (n,)."""
        return self.weight * (mean_friction(p, self.speed, self.change) - self.torque)

    def slopes(self, p: Array) -> Array:
        """Jacobian of the errors, (n, 4)."""
        return self.weight[:, None] * mean_slopes(p, self.speed, self.change)


def fit_friction(
    samples: Sequence[FrictionSamples],
    *,
    weighted: bool = True,
    bounds: Mapping[str, tuple[float, float]] = FRICTION_BOUNDS,
) -> FrictionFit:
    """Fit the four parameters of Eq. 5.38.

    Least squares from three starts. Filtered samples are correlated, so the covariance is a sandwich estimator (see
    `correlated`). The interval of the steepness r is from its profile likelihood, with the same correction. If the
    profile stays flat towards a bound, the data determine the other end only (see `steepness`).

    Args:
        samples: one set per test, each in the order of time.
        weighted: whether to weight samples by `sigma`; False gives all the same weight, thesis Eq. 6.1.
        bounds: name -> (low, high).
    Raises:
        BadInput: fewer than ten samples, all at nearly the same speed, or bounds that are missing or reversed.
    """
    rows, low, high = _rows(samples, weighted), *_limits(bounds)
    best = min((_solve(rows, np.array(s), low, high) for s in _starts(rows)), key=lambda found: found[1])
    errors = rows.errors(best[0])
    length = correlation_length(errors, rows.lengths)
    variance = float(errors @ errors) / max(errors.size - 4 * length, 1.0) * length
    found = steepness(best, lambda start, r: _solve(rows, start, low, high, r), (low[0], high[0]), variance)
    estimate, effective = found.solution[0], errors.size / length
    errors, slopes = rows.errors(estimate), rows.slopes(estimate)
    free = np.array([not found.is_open, True, True, True])
    covariance = np.zeros((4, 4))
    covariance[np.ix_(free, free)] = score_covariance(slopes[:, free], errors, rows.lengths, length)
    half = _quantile(effective, int(free.sum())) * np.sqrt(np.diag(covariance))
    intervals = {
        name: (float(max(low[i], estimate[i] - half[i])), float(min(high[i], estimate[i] + half[i])))
        for i, name in enumerate(FRICTION_NAMES)
    }
    intervals["r"] = found.interval
    near = np.minimum(estimate - low, high - estimate) <= 1e-6 * (high - low)
    return FrictionFit(
        dict(zip(FRICTION_NAMES, estimate.tolist(), strict=True)),
        intervals,
        ("r",) if found.is_open else (),
        covariance,
        -errors / rows.weight,
        effective,
        tuple(name for name, stopped in zip(FRICTION_NAMES, near, strict=True) if stopped),
        weighted,
        tuple(samples),
    )


def _rows(samples: Sequence[FrictionSamples], weighted: bool) -> _Rows:
    if sum(s.speed.size for s in samples) < 10:
        raise BadInput("friction fit: fewer than ten samples; give a longer log, with steady speeds in it")
    speed, change, torque, sigma = (
        np.concatenate([getattr(s, name) for s in samples]) for name in ("speed", "change", "torque", "sigma")
    )
    if np.ptp(np.abs(speed)) < 0.2 * np.abs(speed).max():
        raise BadInput(
            f"friction fit: all speeds are near {np.abs(speed).mean():.3g} rad/s; a curve needs slow and fast ones"
        )
    weight = 1 / np.maximum(sigma, 1e-9) if weighted else np.ones(speed.size)
    return _Rows(speed, change, torque, weight, tuple(s.speed.size for s in samples))


def _limits(bounds: Mapping[str, tuple[float, float]]) -> tuple[Array, Array]:
    for name in FRICTION_NAMES:
        if name not in bounds or not bounds[name][0] < bounds[name][1]:
            raise BadInput(f"friction fit: {name} needs bounds (low, high) with low below high")
    low, high = np.array([bounds[name] for name in FRICTION_NAMES]).T
    return low, high


def _starts(rows: _Rows) -> list[tuple[float, float, float, float]]:
    """Start values, with the torques from the fastest and the slowest tenth of the samples."""
    size = np.abs(rows.speed)
    fast, slow = size >= np.quantile(size, 0.9), size <= np.quantile(size, 0.1)
    tau_c, tau_s = (max(float(np.median(np.abs(rows.torque[some]))), 0.1) for some in (fast, slow))
    return [(r, omega_0, tau_c, tau_s) for r, omega_0 in _STARTS]


def _solve(rows: _Rows, start: Array, low: Array, high: Array, r: float | None = None) -> Solution:
    """Parameters and sum of squares; with r held where it is given."""
    from scipy.optimize import least_squares  # 0.2 s to import, for those alone who fit

    first = 0 if r is None else 1

    def full(p: Array) -> Array:
        return p if r is None else np.append(r, p)

    gap = 1e-6 * (high - low)
    found = least_squares(
        lambda p: rows.errors(full(p)),
        np.clip(start, low + gap, high - gap)[first:],
        jac=lambda p: rows.slopes(full(p))[:, first:],
        bounds=(low[first:], high[first:]),
        x_scale=_SIZES[first:],
    )
    return full(found.x), 2 * float(found.cost)
