"""Where searches begin: the start that was given, the model's own, and others drawn between the bounds."""

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
    """Name -> start (n,) in the search's numbers.

    The model's own start values are among them where they lie within the bounds, unless `nominal` is False.

    Args:
        count: searches from starts drawn at random, besides the given and the nominal one.
        seed: of the draw; needed where count is above zero.
    Raises:
        BadInput: no seed, or parameters without bounds to draw between.
    """
    found = {"given": space.to_search(space.start)}
    own = np.array([model[name].start for name in space.variables], dtype=np.float64)
    inside = np.all((own >= space.lower) & (own <= space.upper))
    if nominal and inside and not np.array_equal(own, space.start):
        found["nominal"] = space.to_search(own)
    if count:
        found |= _drawn(space, count, seed)
    return found


def _drawn(space: ParameterSpace, count: int, seed: int | None) -> dict[str, Array]:
    """A Latin hypercube between the bounds, on the search's scale."""
    from scipy.stats import qmc  # a quarter of a second, for those alone who draw

    if seed is None:
        raise BadInput("fit: starts drawn at random need a seed; give one, so that the fit can be repeated")
    lower, upper = space.bounds()
    for key, low, high in zip(space.keys, lower, upper, strict=True):
        if not np.isfinite(high - low):
            raise BadInput(f"fit: {key} has no bounds to draw starts between; give lower and upper, or no --starts")
    points = qmc.LatinHypercube(space.size, rng=np.random.default_rng(seed)).random(count)
    return {f"drawn-{i}": row for i, row in enumerate(lower + points * (upper - lower), start=1)}
