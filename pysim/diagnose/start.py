"""Where the refit of a candidate starts: a point, and slopes put together from what is known already."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from pysim.diagnose.descent import RADIUS, Bowl
from pysim.diagnose.fitted import Fitted
from pysim.diagnose.residuals import Ruler, steps_inside
from pysim.diagnose.screen import Footprint
from pysim.diagnose.strengths import amounted, translated
from pysim.diagnose.subject import Extended
from pysim.identify.greybox.optimiser import Bounds
from pysim.identify.greybox.residuals import Point

Array = NDArray[np.float64]


def start_off(current: Fitted, what: Extended, found: Footprint) -> Point | None:
    """The model so far with the effect off: no run is needed, and a refit cannot end worse.

    None where off is a limit that the effect's equations do not reach, or where a limit has no slope there.
    """
    effect = found.effect
    if effect.bypass or any(p.inverse for p in effect.strengths):
        return None
    x = _searched(current, what, [(found, 0.0)])
    slopes = _carried(current, what)
    for p in effect.strengths:
        by_value = found.change / (found.values[p.name] - (p.off or 0.0)) / len(effect.strengths)
        j = what.space.keys.index(f"{what.places[effect.name]}.{p.name}")
        slopes[:, j] = by_value * what.space.slope(x)[j]
    return Point(x, current.point.cost, current.point.residual, slopes)


def start_at(ruler: Ruler, current: Fitted, what: Extended, parts: Sequence[tuple[Footprint, float]]) -> Point | None:
    """Effects at so many times the strengths that were tried, the other parameters where they absorb them best.

    So a lag starts with the dead time shortened. Slopes by the effects' own parameters are run, the others are those
    of the model so far.

    Args:
        parts: what the model has beside the model so far: footprint and amount.
    Returns:
        None where the model could not be simulated there.
    """
    x, slopes, shifted = _searched(current, what, parts), _carried(current, what), current.point.residual
    for found, amount in parts:
        shifted = shifted + amount * found.change
    bounds = Bounds(*what.space.bounds())
    x = np.clip(x + Bowl.around(Point(x, float(shifted @ shifted), shifted, slopes), bounds).step(RADIUS), *bounds)
    own = [
        what.space.keys.index(f"{what.places[f.effect.name]}.{p.name}") for f, _ in parts for p in f.effect.parameters
    ]
    steps = steps_inside(x, (bounds.lower, bounds.upper))[own]
    points = [x, *(_moved(x, j, step) for j, step in zip(own, steps.tolist(), strict=True))]
    residual, *moved = ruler.residuals(what.model, [what.space.values(p) for p in points])
    if residual is None:
        return None
    for j, step, other in zip(own, steps.tolist(), moved, strict=True):
        if other is not None:
            slopes[:, j] = (other - residual) / step
    return Point(x, float(residual @ residual), residual, slopes)


def _searched(current: Fitted, what: Extended, parts: Sequence[tuple[Footprint, float]]) -> Array:
    """The model so far and these amounts of the effects, in the search's numbers of the extended model."""
    full, space = translated(current.what, what, current.what.space.values(current.point.x)), what.space
    for found, amount in parts:
        for name, value in amounted(found.effect, found.values, amount).items():
            full[f"{what.places[found.effect.name]}.{name}"] = value
    return space.to_search(np.clip(np.array([full[name] for name in space.keys]), space.lower, space.upper))


def _carried(current: Fitted, what: Extended) -> Array:
    """Slopes of the model so far, in the columns that they have in the extended one."""
    slopes = np.zeros((current.point.residual.size, what.space.size))
    names = translated(current.what, what, dict.fromkeys(current.what.space.keys, 0.0))
    for column, name in enumerate(names):
        slopes[:, what.space.keys.index(name)] = current.point.jacobian[:, column]
    return slopes


def _moved(x: Array, j: int, step: float) -> Array:
    point = x.copy()
    point[j] += step
    return point
