"""Runs by communication steps, with inputs that stand still off their start values."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from pysim.fmu_check.instance import Instance
from pysim.fmu_check.subject import Subject, references

Array = NDArray[np.float64]


def stepped(
    subject: Subject, instance: Instance, rows: Sequence[int], size: float, count: int, inputs: Array, first: int = 0
) -> Array:
    """Values (count, n) of the variables after each of `count` steps of `size` s, from step number `first` on.

    Where the FMU ends the simulation, which is no fault, its last values stand for those of the steps that are left.
    """
    instance.set(references(subject.inputs), inputs)
    found: list[Array] = []
    goes_on = True
    for k in range(first, first + count):
        goes_on = goes_on and instance.step(subject.start + k * size, size)
        found.append(instance.get(rows) if goes_on or not found else found[-1])
        subject.alive()
    return np.array(found).reshape(count, len(rows))
