"""Intervals of the parameters from blocks of the data, and combinations of parameters that are determined.

If a model is a little wrong, its residuals are not independent. Blocks of the data nearly are: the scatter of their
scores gives intervals that hold for any colour (a sandwich estimator), and are unbiased if the residuals are white.

Source: White 1980, Econometrica 48:817; Bell and McCaffrey 2002, Survey Methodology 28:169 (CR2, degrees of freedom).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from scipy.special import ndtri, stdtrit

from pysim.identify.greybox.effective_size import inflation
from pysim.identify.greybox.identifiability import EXACT, Identifiability, identifiability, whole_exponents
from pysim.identify.greybox.parameters import ParameterSpace
from pysim.identify.greybox.residuals import BEFOREHAND, Point
from pysim.identify.greybox.settings import FitSettings
from pysim.types import Combination, Direction, Estimate

Array = NDArray[np.float64]

_SETTINGS = FitSettings()
# An estimate is at its bound if it is nearer than this times the bounds' distance (at least 1), in search coordinates.
_AT_BOUND = 1e-6
# Largest half width of an interval, as a natural logarithm; the exponential of much more overflows.
_FARTHEST = 300.0


@dataclass(frozen=True)
class Uncertainty:
    """Estimates and intervals at one optimum.

    Args:
        estimates: one per free parameter.
        covariance: (n, n) in the parameters' units; NaN for undetermined parameters.
        known: directions that the data do not determine, or badly.
        combinations: combinations of undetermined parameters that are determined.
        ratio: (n,) width of the interval over that for white residuals; NaN for undetermined parameters.
        half: (n,) half widths of two-sided intervals, in standard deviations.
        blocks: number of blocks that gave the intervals; 0 if they were too few and lambda was used instead.
    """

    estimates: tuple[Estimate, ...]
    covariance: Array
    known: Identifiability
    combinations: tuple[Combination, ...]
    ratio: Array
    half: Array
    blocks: int


def uncertainty(space: ParameterSpace, point: Point) -> Uncertainty:
    """Linearised intervals around an optimum of a sum of squares.

    Parameters at a bound count as known for the intervals of the others. Their own intervals are one-sided, from the
    bound inwards.

    Args:
        point: the optimum, with its residual and Jacobian.
    """
    value, slope = space.to_model(point.x), space.slope(point.x)
    at = at_bounds(space, point)
    inner = np.array([not where for where in at])
    relative = np.where(value == 0, space.scale, np.abs(value))  # one unit of ln(p), or of the scale at zero
    slopes = point.jacobian / slope * relative
    known = identifiability(space.keys, slopes)
    everyone = np.ones(space.size, dtype=bool)
    found = [_covariance(slopes, point, free) for free in (inner, everyone)]
    logarithmic, alone = (one.matrix for one in found)
    open_ = _open(known.exact)
    std = np.where(open_, np.inf, np.sqrt(np.diag(np.where(inner, logarithmic, alone))) * relative)
    freedom = np.where(inner, found[0].freedom, found[1].freedom)
    intervals = [
        _interval(space, i, float(value[i]), _quantile(freedom[i], one_sided=bool(at[i])) * float(std[i]), at[i])
        for i in range(space.size)
    ]
    columns = (space.keys, space.units, *(a.tolist() for a in (value, space.start, space.lower, space.upper, std)))
    estimates = tuple(Estimate(*row) for row in zip(*columns, intervals, at, strict=True))
    known = replace(known, directions=tuple(replace(one, reach=reach(one, estimates)) for one in known.directions))
    covariance = logarithmic * np.outer(relative, relative)
    covariance[open_, :] = covariance[:, open_] = math.nan
    half = np.array([_quantile(f) for f in freedom])
    white = np.sqrt(np.diag(np.where(inner, found[0].white, found[1].white))) * _quantile(math.inf)
    with np.errstate(divide="ignore", invalid="ignore"):
        ratio = np.where(open_ | (white == 0), math.nan, half * std / relative / white)
    combinations = _combinations(space, value, known, found[1].matrix, float(np.median(half)) if half.size else 0.0)
    return Uncertainty(estimates, covariance, known, combinations, ratio, half, found[0].blocks)


def reach(direction: Direction, estimates: Sequence[Estimate]) -> tuple[float, float]:
    """How far along a direction its parameters stay inside their intervals; parameters at zero tell nothing of that."""
    low, high = 0.0, math.inf
    for one in estimates:
        power = direction.exponents.get(one.name, 0.0)
        if not power or not one.value:
            continue
        ends = (max(end / one.value, 0.0) for end in one.interval)
        none = 0.0 if power > 0 else math.inf
        least, most = sorted(end ** (1 / power) if end else none for end in ends)
        low, high = max(low, least), min(high, most)
    return min(low, 1.0), max(high, 1.0)


def _quantile(freedom: float, *, one_sided: bool = False) -> float:
    """Half width of an interval in standard deviations: Student's t distribution; normal if `freedom` is infinite."""
    level = _SETTINGS.level if one_sided else 0.5 + _SETTINGS.level / 2
    return float(stdtrit(freedom, level) if math.isfinite(freedom) else ndtri(level))


def at_bounds(space: ParameterSpace, point: Point) -> list[str]:
    """The bound where each parameter is: "lower", "upper" or ""."""
    lower, upper = space.bounds()
    width = np.where(np.isfinite(upper - lower), upper - lower, 1.0)
    near = _AT_BOUND * np.maximum(width, 1.0)
    low, high = point.x - lower <= near, upper - point.x <= near
    return ["lower" if below else "upper" if above else "" for below, above in zip(low, high, strict=True)]


@dataclass(frozen=True)
class _Covariance:
    """Covariances (n, n), zero for parameters that are not free; degrees of freedom (n,); number of blocks used."""

    matrix: Array
    white: Array
    freedom: Array
    blocks: int


def _covariance(slopes: Array, point: Point, free: NDArray[np.bool_]) -> _Covariance:
    """Covariance of the free parameters: from blocks if they are enough, else that of white residuals times lambda."""
    n = slopes.shape[1]
    full, white, freedom = np.zeros((n, n)), np.zeros((n, n)), np.full(n, math.inf)
    places = np.ix_(free, free)
    if not np.any(free):
        return _Covariance(full, white, freedom, 0)
    rows = slopes[:, free]
    q, triangle = np.linalg.qr(rows)
    u, sigma, vt = np.linalg.svd(triangle)
    held = sigma > EXACT * max(sigma.max(initial=0.0), np.finfo(float).tiny)
    back = vt[held].T / sigma[held]  # maps directions of information one to the parameters
    bread = back @ back.T
    excess = point.count / max(point.count - n, 1)
    white[places] = bread * excess
    numbers = np.unique(point.blocks[np.any(rows != 0, axis=1)]) if point.blocks.size else np.zeros(0)
    numbers = numbers[numbers != BEFOREHAND]
    if len(numbers) >= _SETTINGS.fewest_blocks:
        own = [point.blocks == number for number in numbers]
        known = (q @ u[:, held])[point.blocks == BEFOREHAND]
        full[places], freedom[free] = _sandwich(q @ u[:, held], point.residual, back, own, known)
        return _Covariance(full, white, freedom, len(own))
    colour = np.array([_colour(point, rows[:, j]) for j in range(rows.shape[1])])
    full[places] = bread * excess * np.sqrt(np.outer(colour, colour))
    freedom[free] = np.maximum(point.count / colour - n, 1.0)
    return _Covariance(full, white, freedom, 0)


def _sandwich(
    rows: Array, residual: Array, back: Array, blocks: Sequence[NDArray[np.bool_]], known: Array
) -> tuple[Array, Array]:
    """Covariance (n, n) from scores of blocks, corrected for leverage (CR2), and degrees of freedom (n,).

    In directions of information one, H_b and s_b are the information and the score of block b. For white residuals, s_b
    has the covariance H_b - H_b^2. So (I - H_b)^-1/2 s_b has the covariance H_b, and the sum over blocks is the unit
    matrix. A direction that one block alone determines has no scatter; it gets the variance for white residuals, and so
    do priors. The degrees of freedom are Satterthwaite's for white residuals.

    Args:
        rows: (n_r, m) orthonormal Jacobian.
        back: (n, m) maps these directions to the parameters.
        known: (k, m) rows of priors."""
    changes, pushes = [], []
    alone = known.T @ known
    for block in blocks:
        part = rows[block]
        own, directions = np.linalg.eigh(part.T @ part)
        left = 1.0 - own
        seen = left > EXACT
        undone = (directions * np.where(seen, 1 / np.sqrt(np.maximum(left, EXACT)), 0.0)) @ directions.T
        alone += directions[:, ~seen] @ directions[:, ~seen].T
        changes.append(back @ undone @ (part.T @ residual[block]))
        pushes.append((undone @ back.T, part.T @ part))
    count, moved = len(blocks), np.array(changes)
    freedom = np.empty(len(back))
    for c in range(len(back)):
        w = np.array([push[:, c] for push, _ in pushes])
        pushed = np.array([own @ one for (_, own), one in zip(pushes, w, strict=True)])
        products = -pushed @ pushed.T
        products[np.diag_indices(count)] += np.sum(w * pushed, axis=1)
        square = float(np.sum(products**2))
        freedom[c] = max(float(back[c] @ back[c]) ** 2 / square, 1.0) if square > 0 else math.inf
    return moved.T @ moved + back @ alone @ back.T, freedom


def _colour(point: Point, column: Array) -> float:
    """lambda of a parameter with Jacobian column (n_r,), pooled over all series."""
    chosen = [point.series == number for number in np.unique(point.series) if number >= 0]
    chosen = chosen or [np.ones(point.residual.size, dtype=bool)]
    return inflation([point.residual[own, None] for own in chosen], [column[own, None] for own in chosen])


def _open(exact: Array) -> NDArray[np.bool_]:
    """(n,) whether each parameter is undetermined, as it has a part in an exact direction."""
    return np.asarray(
        np.any(np.abs(exact) > _SETTINGS.undetermined * np.max(np.abs(exact), axis=0, initial=0.0), axis=1)
    )


def _interval(space: ParameterSpace, i: int, value: float, reach: float, at: str) -> tuple[float, float]:
    """Interval from half width `reach`, within the bounds: symmetric on the search's scale; one-sided from a bound."""
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
    space: ParameterSpace, value: Array, known: Identifiability, covariance: Array, factor: float
) -> tuple[Combination, ...]:
    """If exactly one direction is undetermined: determined products of each parameter in it with a power of one other.
    None if a parameter is not positive."""
    if known.exact.shape[1] != 1 or np.any(value <= 0):
        return ()
    exponents = whole_exponents(space.keys, known.exact[:, 0])
    smallest = min(abs(e) for e in exponents.values())
    pivot = [name for name, e in exponents.items() if abs(e) == smallest][-1]
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
