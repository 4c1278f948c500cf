"""How well the data determine the parameters: intervals from blocks, and combinations of what is not determined.

Residuals are neither independent nor white where a model is a little wrong. The blocks of the data are: the scatter of
their scores gives an interval that holds for any colour (a sandwich), unbiased where residuals are white after all.

Source: White 1980, Econometrica 48:817; Bell and McCaffrey 2002, Survey Methodology 28:169 (CR2, degrees of freedom).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.special import ndtri, stdtrit

from pysim.identify.greybox.effective_size import inflation
from pysim.identify.greybox.identifiability import EXACT, Identifiability, identifiability, whole_exponents
from pysim.identify.greybox.parameters import ParameterSpace
from pysim.identify.greybox.residuals import BEFOREHAND, Point
from pysim.identify.greybox.settings import FitSettings
from pysim.types import Combination, Estimate

Array = NDArray[np.float64]

_SETTINGS = FitSettings()
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
        ratio: (n,) interval from blocks over that of white residuals; not a number where there is none from blocks.
        half: (n,) standard deviations to the ends of the intervals.
        blocks: that gave the intervals; 0 where they were too few and colour was allowed for by lambda alone.
    """

    estimates: tuple[Estimate, ...]
    covariance: Array
    known: Identifiability
    combinations: tuple[Combination, ...]
    ratio: Array
    half: Array
    blocks: int


def uncertainty(space: ParameterSpace, point: Point) -> Uncertainty:
    """Intervals to first order around an optimum of a sum of squares.

    Parameters at a bound do not count as free for the others: their own interval reaches into the bounds from where
    they stand.

    Args:
        point: residuals over their levels and their slopes.
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
    covariance = logarithmic * np.outer(relative, relative)
    covariance[open_, :] = covariance[:, open_] = math.nan
    half = np.array([_quantile(f) for f in freedom])
    white = np.sqrt(np.diag(np.where(inner, found[0].white, found[1].white))) * _quantile(math.inf)
    with np.errstate(divide="ignore", invalid="ignore"):
        ratio = np.where(open_ | (white == 0), math.nan, half * std / relative / white)
    combinations = _combinations(space, value, known, found[1].matrix, float(np.median(half)) if half.size else 0.0)
    return Uncertainty(estimates, covariance, known, combinations, ratio, half, found[0].blocks)


def _quantile(freedom: float, *, one_sided: bool = False) -> float:
    """Standard deviations to the end of an interval: Student's distribution, the normal one where that is infinite."""
    level = _SETTINGS.level if one_sided else 0.5 + _SETTINGS.level / 2
    return float(stdtrit(freedom, level) if math.isfinite(freedom) else ndtri(level))


def at_bounds(space: ParameterSpace, point: Point) -> list[str]:
    """ "lower", "upper" or "" per parameter."""
    lower, upper = space.bounds()
    width = np.where(np.isfinite(upper - lower), upper - lower, 1.0)
    near = _AT_BOUND * np.maximum(width, 1.0)
    low, high = point.x - lower <= near, upper - point.x <= near
    return ["lower" if below else "upper" if above else "" for below, above in zip(low, high, strict=True)]


@dataclass(frozen=True)
class _Covariance:
    """Of the free parameters, (n, n) each, zero for the others; degrees of freedom (n,); blocks that gave it."""

    matrix: Array
    white: Array
    freedom: Array
    blocks: int


def _covariance(slopes: Array, point: Point, free: NDArray[np.bool_]) -> _Covariance:
    """From blocks where they are many enough; else that of white residuals, widened by their colour."""
    n = slopes.shape[1]
    full, white, freedom = np.zeros((n, n)), np.zeros((n, n)), np.full(n, math.inf)
    places = np.ix_(free, free)
    if not np.any(free):
        return _Covariance(full, white, freedom, 0)
    rows = slopes[:, free]
    q, triangle = np.linalg.qr(rows)
    u, sigma, vt = np.linalg.svd(triangle)
    held = sigma > EXACT * max(sigma.max(initial=0.0), np.finfo(float).tiny)
    back = vt[held].T / sigma[held]  # from directions that the data see equally well to the parameters
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
    """Covariance (n, n) by scores of blocks, their leverage made up for (CR2), and degrees of freedom (n,).

    In directions of information one, H_b and s_b are the information and the score of block b. White residuals give s_b
    the covariance H_b - H_b^2, so that (I - H_b)^-1/2 s_b has H_b, and all of them together one. What a block alone
    determines has no scatter, and the variance of white residuals, as what was known beforehand has. The degrees are
    Satterthwaite's, of white residuals.

    Args:
        rows: (n_r, m) orthonormal slopes.
        back: (n, m) from their directions to the parameters.
        known: (k, m) those of the rows that were known beforehand.
    """
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
    """lambda of a parameter's score (n_r,) over all series."""
    chosen = [point.series == number for number in np.unique(point.series) if number >= 0]
    chosen = chosen or [np.ones(point.residual.size, dtype=bool)]
    return inflation([point.residual[own, None] for own in chosen], [column[own, None] for own in chosen])


def _open(exact: Array) -> NDArray[np.bool_]:
    """Which parameters have a part in an exact direction, (n,)."""
    return np.asarray(
        np.any(np.abs(exact) > _SETTINGS.undetermined * np.max(np.abs(exact), axis=0, initial=0.0), axis=1)
    )


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
    space: ParameterSpace, value: Array, known: Identifiability, covariance: Array, factor: float
) -> tuple[Combination, ...]:
    """For each exact direction, every other parameter in it times the power of a first one that makes it invariant."""
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
