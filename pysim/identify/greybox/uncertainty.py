"""How well the data determine the parameters: covariance, intervals, and combinations of what is not determined."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.special import ndtri, stdtrit

from pysim.identify.greybox.evaluation import Evaluation
from pysim.identify.greybox.identifiability import EXACT, Identifiability, identifiability, whole_exponents
from pysim.identify.greybox.parameters import ParameterSpace
from pysim.types import Combination, Estimate

Array = NDArray[np.float64]

LEVEL = 0.95
# A parameter counts as undetermined when moving it alone moves along an exact direction by more than this share.
_TOUCHED = 1e-2
# Nearer than this share of its standard deviation, or of the bounds' distance, an estimate stands at its bound.
_AT_BOUND = 1e-6
# Half width, as a logarithm, beyond which numbers end: of a parameter's interval as of a combination's.
_FARTHEST = 300.0


@dataclass(frozen=True)
class Uncertainty:
    """Of one optimum.

    Args:
        estimates: one per free parameter.
        covariance: (n, n) in the parameters' units; not a number where not determined.
        known: directions the data leave open.
        combinations: what is determined of those.
    """

    estimates: tuple[Estimate, ...]
    covariance: Array
    known: Identifiability
    combinations: tuple[Combination, ...]


def misfit(point: Evaluation) -> float:
    """Root of the sum of squares over its degrees of freedom: 1 where only noise is left."""
    freedom = max(point.residual.size - point.x.size, 1)
    return math.sqrt(float(point.residual @ point.residual) / freedom)


def uncertainty(space: ParameterSpace, point: Evaluation, *, scale: float, told: bool) -> Uncertainty:
    """Intervals to first order around an optimum of a sum of squares.

    Parameters at a bound do not count as free for the others: their own interval reaches into the bounds from where
    they stand.

    Args:
        point: residuals in standard deviations and their slopes.
        scale: by which the standard deviations are multiplied: the misfit where it is above 1, or where the noise was
            not told.
        told: whether the noise was; where not, Student's distribution takes the place of the normal one.
    """
    value, slope = space.to_model(point.x), space.slope(point.x)
    at = _at_bounds(space, point)
    inner = np.array([not where for where in at])
    relative = np.where(value == 0, space.scale, np.abs(value))  # one unit of ln(p), or of the scale at zero
    slopes = point.jacobian / slope * relative
    known = identifiability(space.keys, slopes, noise=scale)
    logarithmic, alone = (scale**2 * _covariance(slopes, f) for f in (inner, np.ones(space.size, dtype=bool)))
    open_ = _open(known.exact)
    std = np.where(open_, np.inf, np.sqrt(np.diag(np.where(inner, logarithmic, alone))) * relative)
    freedom = None if told else max(point.residual.size - point.x.size, 1)
    intervals = [
        _interval(space, i, float(value[i]), _quantile(freedom, one_sided=bool(at[i])) * float(std[i]), at[i])
        for i in range(space.size)
    ]
    columns = (space.keys, space.units, *(a.tolist() for a in (value, space.start, space.lower, space.upper, std)))
    estimates = tuple(Estimate(*row) for row in zip(*columns, intervals, at, strict=True))
    covariance = logarithmic * np.outer(relative, relative)
    covariance[open_, :] = covariance[:, open_] = math.nan
    inverse = np.asarray(scale * np.linalg.pinv(slopes, rcond=EXACT), dtype=np.float64)
    return Uncertainty(estimates, covariance, known, _combinations(space, value, known, inverse, _quantile(freedom)))


def _quantile(freedom: int | None, *, one_sided: bool = False) -> float:
    """Standard deviations to the end of an interval: of the normal distribution, or of Student's with `freedom`."""
    level = LEVEL if one_sided else 0.5 + LEVEL / 2
    return float(ndtri(level) if freedom is None else stdtrit(freedom, level))


def _at_bounds(space: ParameterSpace, point: Evaluation) -> list[str]:
    """ "lower", "upper" or "" per parameter."""
    lower, upper = space.bounds()
    width = np.where(np.isfinite(upper - lower), upper - lower, 1.0)
    near = _AT_BOUND * np.maximum(width, 1.0)
    low, high = point.x - lower <= near, upper - point.x <= near
    return ["lower" if below else "upper" if above else "" for below, above in zip(low, high, strict=True)]


def _covariance(slopes: Array, free: NDArray[np.bool_]) -> Array:
    """Pseudo-inverse of the information of the free ones, (n, n); zero for the others."""
    full = np.zeros((slopes.shape[1], slopes.shape[1]))
    if np.any(free):
        inverse = np.linalg.pinv(slopes[:, free], rcond=EXACT)
        full[np.ix_(free, free)] = inverse @ inverse.T
    return full


def _open(exact: Array) -> NDArray[np.bool_]:
    """Which parameters have a part in an exact direction, (n,)."""
    return np.asarray(np.any(np.abs(exact) > _TOUCHED * np.max(np.abs(exact), axis=0, initial=0.0), axis=1))


def _interval(space: ParameterSpace, i: int, value: float, reach: float, at: str) -> tuple[float, float]:
    """`reach` to both sides, to one from a bound; on the scale of the search, and never beyond the bounds."""
    lower, upper = float(space.lower[i]), float(space.upper[i])
    if not math.isfinite(reach):
        return lower, upper
    if space.log[i] and not at:
        share = min(reach / value, _FARTHEST)
        low, high = value * math.exp(-share), value * math.exp(share)
    else:
        low, high = value - reach, value + reach
    low, high = (value, high) if at == "lower" else (low, value) if at == "upper" else (low, high)
    return max(low, lower), min(high, upper)


def _combinations(
    space: ParameterSpace, value: Array, known: Identifiability, inverse: Array, factor: float
) -> tuple[Combination, ...]:
    """For each exact direction, every other parameter in it times the power of a first one that makes it invariant."""
    if known.exact.shape[1] != 1 or np.any(value <= 0):
        return ()
    exponents = whole_exponents(space.keys, known.exact[:, 0])
    smallest = min(abs(e) for e in exponents.values())
    pivot = [name for name, e in exponents.items() if abs(e) == smallest][-1]
    covariance = inverse @ inverse.T
    found = []
    for name, exponent in exponents.items():
        if name == pivot:
            continue
        powers = {name: 1.0, pivot: -exponent / exponents[pivot]}
        row = np.array([powers.get(key, 0.0) for key in space.keys])
        std = math.sqrt(float(row @ covariance @ row))
        centre = float(np.prod(value**row))
        reach = math.exp(min(factor * std, _FARTHEST))
        interval = centre / reach, centre * reach
        found.append(Combination(powers, _product(powers), centre, interval))
    return tuple(found)


def _product(powers: dict[str, float]) -> str:
    return " ".join(name if e == 1 else f"{name}^{e:g}" for name, e in powers.items())


def untold(notes: Sequence[str]) -> bool:
    """Whether some noise had to be estimated."""
    return any("not told" in note or "without covariance" in note for note in notes)
