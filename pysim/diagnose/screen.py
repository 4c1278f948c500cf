"""Which effects promise to mend the misfit: one run of the tests per candidate and strength, no refit."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from pysim.diagnose.residuals import Ruler
from pysim.diagnose.subject import Extended
from pysim.identify.greybox.evaluation import Evaluation
from pysim.types import Effect

Array = NDArray[np.float64]

# Strengths to try, in the parameter's nominal size. A limit bites late and abruptly, so it gets a finer grid; so does
# a strength whose off is a limit.
USUAL, LIMITS, BYPASSED = (0.1, 1.0), (0.25, 0.4, 0.6, 0.8, 1.0, 1.5, 2.5), (0.25, 1.0)
# Directions of the base model's slopes smaller than this share of the largest count as none.
_NOTHING = 1e-4


@dataclass(frozen=True)
class Footprint:
    """What one effect at one strength does to the residuals, and what of it refitting leaves.

    Args:
        effect: which.
        values: its parameters, by their names as declared.
        change: (n_r,) of the residuals.
        left: (n_r,) of it once the base model's parameters are refitted, to first order.
        size: sum of squares of `left`.
        gain: by how much the sum of squares falls with the best amount of it, refit included, to first order.
        amount: that amount, in units of this strength; zero where the sign is not allowed.
    """

    effect: Effect
    values: dict[str, float]
    change: Array = field(repr=False)
    left: Array = field(repr=False)
    size: float
    gain: float
    amount: float


def screen(
    ruler: Ruler, base: Extended, point: Evaluation, candidates: list[tuple[Effect, Extended]]
) -> tuple[Footprint, ...]:
    """Score tests of every candidate at a point of the base model.

    Args:
        base: the model so far.
        point: of it, with slopes.
        candidates: each effect with the model that has it besides.
    Returns:
        footprints, the best gain first; strengths that change nothing or cannot be simulated are left out.
    """
    span = column_space(point.jacobian)
    left_over = point.residual - span @ (span.T @ point.residual)
    found: list[Footprint] = []
    for effect, what in candidates:
        grid = list(strengths(effect))
        settings = [setting(base, what, effect, point.x, values) for values in grid]
        for values, residual in zip(grid, ruler.residuals(what.model, settings), strict=True):
            if residual is not None:
                found += _footprint(effect, values, residual - point.residual, span, left_over)
    return tuple(sorted(found, key=lambda f: -f.gain))


def _footprint(
    effect: Effect, values: dict[str, float], change: Array, span: Array, left_over: Array
) -> Iterator[Footprint]:
    left = change - span @ (span.T @ change)
    size = float(left @ left)
    if size < 1e-6:
        return
    amount = -float(left @ left_over) / size
    signed = any(p.min < (p.off or 0.0) for p in effect.strengths)
    amount = amount if amount > 0 or signed else 0.0
    yield Footprint(effect, values, change, left, size, amount**2 * size, amount)


def column_space(slopes: Array) -> Array:
    """Orthonormal columns (n_r, rank) that span what refitting can reach, to first order."""
    sizes = np.linalg.norm(slopes, axis=0)
    used = slopes[:, sizes > 0] / sizes[sizes > 0]
    if not used.shape[1]:
        return np.zeros((slopes.shape[0], 0))
    u, s, _ = np.linalg.svd(used, full_matrices=False)
    return np.asarray(u[:, s > _NOTHING * s[0]])


def strengths(effect: Effect) -> Iterator[dict[str, float]]:
    """Values of all its parameters to try: its strengths in shares of their nominal sizes, shapes as declared."""
    limits = any(p.inverse for p in effect.strengths)
    for share in LIMITS if limits else BYPASSED if effect.bypass else USUAL:
        values = {p.name: p.default for p in effect.parameters}
        for p in effect.strengths:
            values[p.name] = float(np.clip((p.off or 0.0) + share * p.nominal, p.min, p.max))
        yield values


def setting(base: Extended, what: Extended, effect: Effect, x: Array, values: dict[str, float]) -> dict[str, float]:
    """Parameters of the extended model: the base model's at x (n,), those of the effect from `values`."""
    own = {f"{what.places[effect.name]}.{name}": value for name, value in values.items()}
    return {**translated(base, what, base.space.values(x)), **own}


def translated(base: Extended, what: Extended, values: dict[str, float]) -> dict[str, float]:
    """Parameters by their names in the extended model: an effect that shares its slot has moved one level down."""
    names = {
        f"{base.places[e.name]}.{p.name}": f"{what.places[e.name]}.{p.name}" for e in base.effects for p in e.parameters
    }
    return {names.get(name, name): value for name, value in values.items()}


def first_point(
    ruler: Ruler, base: Extended, what: Extended, point: Evaluation, footprint: Footprint
) -> Evaluation | None:
    """Where a refit with that effect starts, with slopes put together from the base model's and the footprint.

    The effect's parameters start at the amount the screening found best, within a factor of three of the strength that
    was tried; those that only shape it have no slope yet.
    """
    amount = float(np.clip(abs(footprint.amount), 1 / 3, 3.0)) * (np.sign(footprint.amount) or 1.0)
    effect = footprint.effect
    if any(p.inverse for p in effect.strengths) or effect.bypass:
        amount = 1.0
    values = dict(footprint.values)
    for p in effect.strengths:
        off = p.off or 0.0
        values[p.name] = float(np.clip(off + amount * (values[p.name] - off), p.min, p.max))
    full = setting(base, what, effect, point.x, values)
    space = what.space
    start = np.array([full[name] for name in space.keys])
    x = space.to_search(np.clip(start, space.lower, space.upper))
    residual = ruler.at(what, x)
    if residual is None:
        return None
    slopes = np.zeros((residual.size, x.size))
    names = translated(base, what, dict.fromkeys(base.space.keys, 0.0))
    for column, name in enumerate(names):
        slopes[:, space.keys.index(name)] = point.jacobian[:, column]
    for p in effect.strengths:
        j = space.keys.index(f"{what.places[effect.name]}.{p.name}")
        by_value = footprint.change / (footprint.values[p.name] - (p.off or 0.0)) / len(effect.strengths)
        slopes[:, j] = by_value * space.slope(x)[j]
    return Evaluation(x, float(residual @ residual), residual, slopes)
