"""How strong an effect is to be, in all its parameters, and their names in a model."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from pysim.diagnose.subject import Extended
from pysim.types import Effect, EffectParameter

Array = NDArray[np.float64]

# A strength of which the answer is nearly a multiple is tried at this share of its nominal size; one whose off is a
# limit of its equations nearer to it.
_USUAL, _BYPASSED = 0.3, 0.5
# A limit is tried at these shares of the largest size that the limited variable has in the tests, and where the class
# does not say which that is, at these shares of its nominal size.
_PEAKS, _LIMITS = (0.92, 0.75, 0.55, 0.35), (0.25, 0.4, 0.6, 0.8, 1.0, 1.5, 2.5)
# Where parameters are not to be trusted, a limit is looked for from this share down, each that much of the one before,
# so many times: its sum of squares is a narrow valley.
_HIGHEST, _RATIO, _COUNT = 0.95, 0.8, 14


def strengths(effect: Effect, largest: float | None = None) -> Iterator[dict[str, float]]:
    """Values of all its parameters to try first: its strengths, shapes as declared.

    Args:
        largest: size of the variable that a limit holds in, where it is known.
    """
    limits = [p for p in effect.strengths if p.inverse]
    if largest is not None:
        for share in _PEAKS if largest > 0 else ():
            yield {**declared(effect), limits[0].name: within(limits[0], 1 / (share * largest))}
        return
    for share in _LIMITS if limits else (_BYPASSED if effect.bypass else _USUAL,):
        sized = {p.name: within(p, (p.off or 0.0) + share * p.nominal) for p in effect.strengths}
        yield {**declared(effect), **sized}


def limits(effect: Effect, largest: float) -> Iterator[dict[str, float]]:
    """Values of all its parameters with its limit ever lower.

    Args:
        largest: size of the variable that the limit holds in.
    """
    limit = next(p for p in effect.strengths if p.inverse)
    for k in range(_COUNT):
        yield {**declared(effect), limit.name: within(limit, 1 / (_HIGHEST * _RATIO**k * largest))}


def amounted(effect: Effect, tried: dict[str, float], amount: float) -> dict[str, float]:
    """An effect's parameters at so many times the strength that was tried."""
    values = dict(tried)
    for p in effect.strengths:
        off = p.off or 0.0
        values[p.name] = within(p, off + amount * (values[p.name] - off))
    return values


def declared(effect: Effect) -> dict[str, float]:
    """Its parameters as its class declares them."""
    return {p.name: p.default for p in effect.parameters}


def within(p: EffectParameter, value: float) -> float:
    """The value, or the bound it is beyond."""
    return float(np.clip(value, p.min, p.max))


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
