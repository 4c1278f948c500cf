"""Points in the space of states and inputs at which derivatives and outputs are looked at."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from pysim.fmu_check.instance import Instance
from pysim.fmu_check.subject import Subject, references, sizes

Array = NDArray[np.float64]
SEED = 20240229


class Points:
    """A model-exchange instance in continuous time that can be put at values of its knowns (states, then inputs)."""

    def __init__(self, subject: Subject, instance: Instance) -> None:
        self.instance = instance
        self.knowns = (*subject.states, *subject.inputs)
        known = set(references(self.knowns))  # an output may be a state, or an input, under another name
        self.unknowns = (*subject.derivatives, *(v for v in subject.outputs if v.valueReference not in known))
        self._rows, self._inputs = references(self.unknowns), references(subject.inputs)
        self._n = len(subject.states)
        self.home = np.concatenate([instance.x, instance.get(self._inputs)])
        self.sizes = sizes(self.knowns, self.home)

    def put(self, values: Array) -> None:
        """Set states and inputs (n,)."""
        self.instance.set(self._inputs, values[self._n :])
        self.instance.set_states(values[: self._n])
        self.instance.subject.alive()

    def values(self, at: Array) -> Array:
        """Unknowns (n_unknowns,) at these knowns."""
        self.put(at)
        return self.instance.get(self._rows)

    def around(self, count: int, share: float) -> list[Array]:
        """Points off the home, every known by half to all of `share` of its size, by a seeded draw."""
        rng = np.random.default_rng(SEED)
        signs = rng.choice([-1.0, 1.0], (count, self.home.size))
        return [self.home + share * self.sizes * s * rng.uniform(0.5, 1.0, s.size) for s in signs]

    def slope(self, at: Array, k: int, step: float) -> Array:
        """Central difference of the unknowns with known k, over `step` of its size to either side."""
        move = np.zeros(at.size)
        move[k] = step * self.sizes[k]
        return (self.values(at + move) - self.values(at - move)) / (2 * move[k])

    def side(self, at: Array, value: Array, k: int, step: float) -> Array:
        """One-sided difference of the unknowns, which are `value` there, with known k moved by `step` of its size."""
        move = np.zeros(at.size)
        move[k] = step * self.sizes[k]
        return (self.values(at + move) - value) / move[k]

    def rows(self, variables: Sequence[int]) -> list[int]:
        """Value references of knowns by their place."""
        return references([self.knowns[k] for k in variables])
