"""Effects that only work together: what two footprints promise at once, without another run."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations

import numpy as np
from numpy.typing import NDArray

from pysim.diagnose.screen import Footprint

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Pair:
    """Two effects at the model so far.

    Args:
        parts: their footprints.
        amounts: best of each, in units of the strengths tried; zero where a sign is not allowed.
        gain: by how much the sum of squares falls with both, refit included, to first order.
    """

    parts: tuple[Footprint, Footprint]
    amounts: tuple[float, float]
    gain: float

    @property
    def names(self) -> tuple[str, str]:
        """Of the two effects."""
        return self.parts[0].effect.name, self.parts[1].effect.name


def joint(footprints: Sequence[Footprint], left_over: Array) -> tuple[Pair, ...]:
    """All pairs of different effects, the best gain first; of each two effects the best strengths.

    Args:
        footprints: any number per effect.
        left_over: (n_r,) residuals, across what refitting can reach.
    """
    if len(footprints) < 2:
        return ()
    columns = np.array([f.left for f in footprints])
    products, right = columns @ columns.T, -columns @ left_over
    best: dict[frozenset[str], Pair] = {}
    for i, j in combinations(range(len(footprints)), 2):
        names = frozenset((footprints[i].effect.name, footprints[j].effect.name))
        if len(names) < 2:
            continue
        signed = footprints[i].signed, footprints[j].signed
        amounts, gain = _two(products[np.ix_([i, j], [i, j])], right[[i, j]], signed)
        if names not in best or gain > best[names].gain:
            best[names] = Pair((footprints[i], footprints[j]), amounts, gain)
    return tuple(sorted(best.values(), key=lambda pair: -pair.gain))


def _two(products: Array, right: Array, signed: tuple[bool, bool]) -> tuple[tuple[float, float], float]:
    """Amounts of two columns, and by how much the sum of squares falls; forbidden signs are left out."""
    found = [((0.0, 0.0), 0.0)]
    for k in (0, 1):
        alone = float(right[k] / products[k, k])
        if alone > 0 or signed[k]:
            found.append(((alone, 0.0) if k == 0 else (0.0, alone), alone * float(right[k])))
    across = products[0, 0] * products[1, 1] - products[0, 1] ** 2
    if across > 1e-9 * products[0, 0] * products[1, 1]:
        a, b = (float(v) for v in np.linalg.solve(products, right))
        if (a > 0 or signed[0]) and (b > 0 or signed[1]):
            found.append(((a, b), a * float(right[0]) + b * float(right[1])))
    return max(found, key=lambda row: row[1])
