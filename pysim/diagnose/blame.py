"""Who is to blame for what a model leaves: sensors and clocks, an effect, or both."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import combinations

import numpy as np
from numpy.typing import NDArray

from pysim.diagnose.nuisance import Suspect

Array = NDArray[np.float64]

# Usual sizes up to which one is taken for a nuisance: what asks for more has another cause.
PLAUSIBLE = 3.0
# A suspect of its usual size that puts less than this into the sum of squares, parameters refitted, is left out: the
# data say less of its size than is known without them, so that half of such would be blamed by chance.
_SHOWN = 1.0
# Suspects of which every set is tried; of more, those that explain most by themselves.
_EXHAUSTIVE = 10


@dataclass(frozen=True)
class Blame:
    """The most likely set of nuisances, given what else may explain the residuals.

    Args:
        suspects: in the set.
        cost: sum of squares that is left, with the suspects' sizes in their usual ones squared.
        price: what having these suspects at all costs, on the same scale.
    """

    suspects: frozenset[Suspect]
    cost: float
    price: float

    @property
    def total(self) -> float:
        """Minus twice the logarithm of the evidence, but for a constant."""
        return self.cost + self.price

    def over(self, other: Blame) -> float:
        """By how much this one is more likely than another, as a fall of the sum of squares.

        Who does without one of the other's suspects only has put an effect in its place: one number for one number, and
        what fits as well is a tie. Who does without two or more has found one cause for a coincidence.
        """
        spared = other.suspects - self.suspects
        if len(spared) == 1 and not self.suspects - other.suspects:
            return other.cost - self.cost
        return other.total - self.total


@dataclass(frozen=True)
class Evidence:
    """Residuals, nuisances and changes by effects at a fitted model, all across what its parameters can take.

    A nuisance is there or it is not; where it is, its size is normal around nothing with the width that such sensors
    and clocks have. Sizes are integrated out, so that the price of a nuisance is the logarithm of its width over what
    the data leave open of it (Mitchell and Beauchamp 1988, J. Am. Stat. Assoc. 83:1023).

    Args:
        suspects: k of them.
        products: (1 + k + m, 1 + k + m) of the residual, the suspects at one usual size, and m changes.
    """

    suspects: tuple[Suspect, ...]
    products: Array

    @staticmethod
    def of(suspects: Sequence[Suspect], columns: Array, residual: Array, changes: Array, reach: Array) -> Evidence:
        """From rows as they are measured, nothing taken off.

        Args:
            suspects: k of finite width.
            columns: (n_r, k) one unit of each.
            residual: (n_r,).
            changes: (n_r, m) by effects.
            reach: (n_r, rank) orthonormal, what parameters take.
        """
        widths = np.array([suspect.width for suspect in suspects])
        rows = np.column_stack([residual, columns * widths, changes])
        products = rows.T @ rows
        along = reach.T @ rows
        kept = slice(1, 1 + len(suspects))
        products -= along.T @ along
        shown = np.diagonal(products)[kept]
        alone = np.where(shown > _SHOWN, products[0, kept] ** 2 / (1 + shown), -1.0)
        best = np.sort(np.argsort(-alone)[: min(_EXHAUSTIVE, np.count_nonzero(alone >= 0))])
        index = np.concatenate([[0], 1 + best, np.arange(1 + alone.size, rows.shape[1])])
        return Evidence(tuple(suspects[k] for k in best), products[np.ix_(index, index)])

    @property
    def changes(self) -> int:
        """How many."""
        return int(self.products.shape[0]) - 1 - len(self.suspects)

    def alone(self) -> Blame:
        """The best set of nuisances where no effect is in force."""
        return min((one.blame for one in self._sets() if one.plausible()), key=lambda blame: blame.total)

    def beside(self, signed: Sequence[bool]) -> list[Blame]:
        """The best set beside the best amount of each change.

        Args:
            signed: whether the amount may be negative.
        """
        either, best = np.array(signed, dtype=bool), [self.alone()] * self.changes
        for one in self._sets():
            size, toward = np.diagonal(one.left)[1:], -one.left[0, 1:]
            good = (size > 0) & (either | (toward > 0))
            amounts = np.where(good, toward / np.where(size > 0, size, 1.0), 0.0)
            plausible, falls = one.plausible(amounts), amounts * toward
            for j in np.flatnonzero(plausible):
                if one.blame.total - falls[j] < best[j].total:
                    best[j] = replace(one.blame, cost=one.blame.cost - float(falls[j]))
        return best

    def _sets(self) -> Iterator[_Set]:
        """Every set of suspects."""
        k = len(self.suspects)
        rest = np.concatenate([[0], np.arange(1 + k, self.products.shape[0])])
        for count in range(k + 1):
            for chosen in combinations(range(k), count):
                own = 1 + np.array(chosen, dtype=int)
                inside = self.products[np.ix_(own, own)] + np.eye(count)
                toward = self.products[np.ix_(own, rest)]
                sizes = np.linalg.solve(inside, toward) if count else toward
                left = self.products[np.ix_(rest, rest)] - toward.T @ sizes
                price = float(np.linalg.slogdet(inside)[1]) if count else 0.0
                blame = Blame(frozenset(self.suspects[j] for j in chosen), float(left[0, 0]), price)
                yield _Set(blame, sizes, left)


@dataclass(frozen=True)
class _Set:
    """A set of k suspects: what it costs where no effect is in force, the sizes (k, 1 + m) that it takes on for the
    residual and for one of each change, and the products (1 + m, 1 + m) of these that it leaves."""

    blame: Blame
    sizes: Array
    left: Array

    def plausible(self, amounts: Array | None = None) -> NDArray[np.bool_]:
        """Whether no size is beyond what is usual, with these amounts (m,) of the changes; with none where None."""
        sizes = self.sizes[:, :1] if amounts is None else self.sizes[:, :1] + self.sizes[:, 1:] * amounts
        return np.asarray(np.all(np.abs(sizes) <= PLAUSIBLE, axis=0))
