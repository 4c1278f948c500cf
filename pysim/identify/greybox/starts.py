"""Starts of the searches: the given start, the nominal values, and random starts between the bounds."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from pysim.identify.greybox.parameters import ParameterSpace
from pysim.types import BadInput, Model

Array = NDArray[np.float64]


def starts(
    model: Model, space: ParameterSpace, count: int, seed: int | None, *, nominal: bool = True
) -> Mapping[str, Array]:
    """Name -> start (n,) in search coordinates.

    The nominal values are among them if they lie within the bounds and differ from the given start.

    Args:
        count: number of random starts, besides the given and the nominal one.
        seed: seed of the random starts; needed if count is above zero.
        nominal: False leaves out the nominal values.
    Raises:
        BadInput: no seed, or a parameter without finite bounds, for random starts."""
    found = {"given": space.to_search(space.start)}
    own = np.array([model[name].start for name in space.variables], dtype=np.float64)
    inside = np.all((own >= space.lower) & (own <= space.upper))
    if nominal and inside and not np.array_equal(own, space.start):
        found["nominal"] = space.to_search(own)
    if count:
        found |= _drawn(space, count, seed)
    return found


def _drawn(space: ParameterSpace, count: int, seed: int | None) -> dict[str, Array]:
    """Starts from a Latin hypercube between the bounds, in search coordinates."""
    from scipy.stats import qmc  # takes a quarter of a second to import, so only if needed

    if seed is None:
        raise BadInput("fit: starts drawn at random need a seed; give one, so that the fit can be repeated")
    lower, upper = space.bounds()
    for key, low, high in zip(space.keys, lower, upper, strict=True):
        if not np.isfinite(high - low):
            raise BadInput(f"fit: {key} has no bounds to draw starts between; give lower and upper, or draw no starts")
    points = qmc.LatinHypercube(space.size, rng=np.random.default_rng(seed)).random(count)
    return {f"drawn-{i}": row for i, row in enumerate(lower + points * (upper - lower), start=1)}
