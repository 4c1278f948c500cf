"""x = g(x), by iteration with Anderson's acceleration."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from pysim.cosim.member import Array

# Earlier iterates the acceleration makes use of.
_DEPTH = 8


class NotConverged(Exception):
    """The iteration came to no end. `worst` is the position of the value that moved most."""

    def __init__(self, worst: int, change: float) -> None:
        super().__init__(f"still changes by {change:.1e} of its size")
        self.worst, self.change = worst, change


def fixed_point(g: Callable[[Array], Array], x: Array, scale: Array, *, rtol: float, limit: int) -> tuple[Array, int]:
    """Find x = g(x).

    Args:
        x: (n,) first guess.
        scale: (n,) magnitude of each; a value counts with its own where that is larger.
        rtol: of the magnitude.
    Returns:
        the last g(x), and how often g was evaluated. What g did last was at the x before.
    Raises:
        NotConverged: not within `limit` evaluations.
    Source: Walker, Ni, Anderson acceleration for fixed-point iterations, 2011. A linear g of n values takes n + 2.
    """
    images: list[Array] = []
    changes: list[Array] = []
    for number in range(1, limit + 1):
        image = g(x)
        size = np.maximum(scale, np.maximum(np.abs(x), np.abs(image)))
        size[size == 0] = 1.0
        change = image - x
        relative = np.abs(change) / size
        if not x.size or relative.max() <= rtol:
            return image, number
        x = _next(images, changes, image, change, size)
        images, changes = [*images[1 - _DEPTH :], image], [*changes[1 - _DEPTH :], change]
    worst = int(np.argmax(relative))
    raise NotConverged(worst, float(relative[worst]))


def _next(images: list[Array], changes: list[Array], image: Array, change: Array, size: Array) -> Array:
    """The combination of all iterates that would not change if g were linear; what is left is least in its size."""
    if not images:
        return image
    differences = (change[:, None] - np.column_stack(changes)) / size[:, None]
    weights = np.linalg.lstsq(differences, change / size, rcond=1e-12)[0]
    return np.asarray(image - (image[:, None] - np.column_stack(images)) @ weights)
