"""Which effects promise to mend the misfit: a run of the tests per candidate and strength, no refit."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from itertools import product

import numpy as np
from numpy.typing import NDArray

from pysim.diagnose.contenders import Contender
from pysim.diagnose.fitted import Fitted
from pysim.diagnose.strengths import amounted, declared, setting, strengths, within
from pysim.simulate import simulate_many
from pysim.types import Effect, Outcome

Array = NDArray[np.float64]

# A number that only shapes an effect is tried at so many times its usual value too, once the effect promises something:
# this share of the best gain, and at least so much.
_SHAPES, _PROMISING, _LEAST = (0.25, 4.0), 0.2, 5.0
# A strength is tried again where the best amount is further from it than this.
_FAR = 2.5
# Strengths of an effect that cannot be switched off, over its usual size, beside that which is tried first.
_OTHER = (0.2, 1.0, 2.0)
# Directions of the base model's slopes smaller than this share of the largest count as none.
_NOTHING = 1e-4


@dataclass(frozen=True)
class Footprint:
    """What one effect at one strength does to the residuals, and what of it refitting leaves.

    Args:
        effect: which.
        values: its parameters, by their names as declared.
        change: (n_r,) of the residuals, as the ruler counts them.
        left: (n_r,) of it once the base model's parameters are refitted, to first order.
        size: sum of squares of `left`.
        gain: by how much the sum of squares falls with the best amount of it, refit included, to first order.
        amount: that amount, in units of this strength; zero where the sign is not allowed.
        plain: (n_r,) of the residuals where no nuisance is allowed for.
    """

    effect: Effect
    values: dict[str, float]
    change: Array = field(repr=False)
    left: Array = field(repr=False)
    size: float
    gain: float
    amount: float
    plain: Array = field(default_factory=lambda: np.zeros(0), repr=False)

    @property
    def signed(self) -> bool:
        """Whether the effect may have either sign."""
        return any(p.min < (p.off or 0.0) for p in self.effect.strengths)


def screen(current: Fitted, tried: Sequence[Contender]) -> tuple[Footprint, ...]:
    """Score tests of every candidate at the model so far.

    Each is tried at one strength; those that promise something then at other shapes, and at the strength that looks
    best where that is far from the one tried.

    Args:
        tried: the candidates.
    Returns:
        footprints, the best gain first; strengths that change nothing or cannot be simulated are left out.
    """
    span = column_space(current.point.jacobian)
    left_over = across(span, current.point.residual)
    found: dict[str, list[Footprint]] = {}
    for one in tried:
        grid = list(strengths(one.effect, largest_value(current, one)))
        found[one.effect.name] = list(_footprints(current, one, grid, span, left_over))
    enough = max([_LEAST, *(_PROMISING * f.gain for own in found.values() for f in own)])
    for one in tried:
        own = found[one.effect.name]
        if own and max(f.gain for f in own) > enough:
            grid = list(_second(max(own, key=lambda f: f.gain)))
            own += _footprints(current, one, grid, span, left_over)
    return tuple(sorted((f for own in found.values() for f in own), key=lambda f: -f.gain))


def elsewhere(current: Fitted, one: Contender) -> Iterator[Footprint]:
    """An effect that cannot be switched off at other strengths: what a lag or a clock does is no multiple of it."""
    sized = one.effect.strengths if one.effect.bypass else ()
    grid = [{**declared(one.effect), **{p.name: within(p, s * p.nominal) for p in sized}} for s in _OTHER]
    if sized:
        span = column_space(current.point.jacobian)
        yield from _footprints(current, one, grid, span, across(span, current.point.residual))


def per_effect(footprints: Sequence[Footprint]) -> list[Footprint]:
    """The best footprint of each effect, in the order given."""
    best: dict[str, Footprint] = {}
    for footprint in footprints:
        best.setdefault(footprint.effect.name, footprint)
    return list(best.values())


def _footprints(
    current: Fitted, one: Contender, grid: Sequence[dict[str, float]], span: Array, left_over: Array
) -> Iterator[Footprint]:
    settings = [setting(current.what, one.what, one.effect, current.point.x, values) for values in grid]
    before = one.ruler.whole(current.point)[:, 0]
    for values, residual in zip(grid, one.ruler.bare.residuals(one.what.model, settings), strict=True):
        if residual is not None:
            plain = residual - before
            change = one.ruler.span.across(plain[:, None])[:, 0]
            for found in footprint(one.effect, values, change, span, left_over):
                yield replace(found, plain=plain)


def footprint(
    effect: Effect, values: dict[str, float], change: Array, span: Array, left_over: Array
) -> Iterator[Footprint]:
    """That of a change (n_r,) of the residuals; none where refitting absorbs it whole.

    Args:
        span: (n_r, rank) orthonormal, what refitting can reach.
        left_over: (n_r,) of the residuals, outside of it.
    """
    left = across(span, change)
    size = float(left @ left)
    if size < 1e-6:
        return
    amount = -float(left @ left_over) / size
    found = Footprint(effect, values, change, left, size, amount**2 * size, amount)
    yield found if amount > 0 or found.signed else replace(found, gain=0.0, amount=0.0)


def column_space(slopes: Array) -> Array:
    """Orthonormal columns (n_r, rank) that span what refitting can reach, to first order."""
    sizes = np.linalg.norm(slopes, axis=0)
    used = slopes[:, sizes > 0] / sizes[sizes > 0]
    if not used.shape[1]:
        return np.zeros((slopes.shape[0], 0))
    values, vectors = np.linalg.eigh(used.T @ used)
    kept = values > _NOTHING**2 * values[-1]
    span = used @ (vectors[:, kept] / np.sqrt(values[kept]))
    return np.asarray(np.linalg.qr(span)[0])  # what products rounded off


def across(span: Array, rows: Array) -> Array:
    """What of rows (n_r,) or (n_r, k) refitting leaves."""
    return np.asarray(rows - span @ (span.T @ rows))


def largest_value(current: Fitted, one: Contender) -> float | None:
    """Size in all tests of the variable that the effect limits; None where it does not say which that is."""
    effect, limit = one.effect, next((p for p in one.effect.strengths if p.limits), None)
    if limit is None or len(effect.strengths) > 1:
        return None
    name = f"{one.what.places[effect.name]}.{limit.limits}"
    off = {**declared(effect), limit.name: limit.off or 0.0}
    runs = one.ruler.experiments(setting(current.what, one.what, effect, current.point.x, off))
    runs = [replace(run, record=(name,)) for run in runs]
    records = simulate_many(one.what.model, runs, solver=one.ruler.solver, workers=one.ruler.workers)
    done = [float(np.max(np.abs(r.values))) for r in records if r.outcome is Outcome.DONE and r.values.size]
    return max(done, default=None)


def _second(best: Footprint) -> Iterator[dict[str, float]]:
    """Other shapes at that strength, and that shape at the strength that looked best."""
    effect = best.effect
    shapes = [p for p in effect.parameters if p.off is None]
    choices = [(best.values[p.name], *(within(p, share * p.default) for share in _SHAPES)) for p in shapes]
    for chosen in list(product(*choices))[1:]:
        yield {**best.values, **{p.name: value for p, value in zip(shapes, chosen, strict=True)}}
    if not (effect.bypass or any(p.inverse for p in effect.strengths)) and not 1 / _FAR < abs(best.amount) < _FAR:
        yield amounted(
            effect, best.values, float(np.clip(abs(best.amount), 0.03, 30.0)) * (math.copysign(1.0, best.amount))
        )
