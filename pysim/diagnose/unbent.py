"""Refits from the model's own parameters: those found without an effect have been bent to hide that it is missing."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from pysim.diagnose.contenders import Contender
from pysim.diagnose.fitted import Fitted
from pysim.diagnose.refit import refit_from
from pysim.diagnose.strengths import amounted, setting
from pysim.identify.greybox.residuals import Point

Array = NDArray[np.float64]

# Strengths looked through beside the model's own parameters, times that found beside bent ones.
_LOOKS = tuple(2.0**k for k in range(-3, 4))


def unbent(one: Contender, at: Fitted, nominal: Fitted) -> tuple[Point, Array] | None:
    """A refit with the effect about as strong as it was found beside others; None where it cannot be simulated.

    Args:
        at: the model with the effect as it was found.
        nominal: the model without it at its own parameters.
    Returns:
        the best point, and where its slopes were run (n,).
    """
    found = one.what.space.values(at.point.x)
    own = {p.name: found[f"{one.what.places[one.effect.name]}.{p.name}"] for p in one.effect.parameters}
    first = best_of(one, nominal, [amounted(one.effect, own, amount) for amount in _LOOKS])
    return None if first is None else refit_from(one.ruler, one.what, first, rounds=2, slow_first=False)


def best_of(one: Contender, nominal: Fitted, grid: Sequence[dict[str, float]]) -> Point | None:
    """A short refit with the strength of a grid that fits best beside these parameters; None as above."""
    settings = [setting(nominal.what, one.what, one.effect, nominal.point.x, values) for values in grid]
    costs = [np.inf if r is None else float(r @ r) for r in one.ruler.residuals(one.what.model, settings)]
    best, space = settings[int(np.argmin(costs))], one.what.space
    x = space.to_search(np.clip(np.array([best[key] for key in space.keys]), space.lower, space.upper))
    first = one.ruler.evaluation(one.what, x)
    return refit_from(one.ruler, one.what, first, rounds=2, slow_first=False)[0] if first.good else None
