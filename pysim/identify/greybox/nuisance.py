"""Sensor errors: measurements may differ from a model because of a sensor or logger, although no physics is missing."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from enum import Enum

import numpy as np
from numpy.typing import NDArray

from pysim.types import BadInput


class NuisanceKind(Enum):
    """Kind of a sensor error."""

    GAIN = "gain"  # share of the signal
    OFFSET = "offset"  # in the signal's unit
    DELAY = "delay"  # s
    DRIFT = "drift"  # in the signal's unit per s, zero at the origin of the records' common clock


@dataclass(frozen=True)
class Nuisance:
    """One sensor error of one channel.

    Args:
        kind: what is wrong.
        dataset, signal: the channel.
        prior_sd: standard deviation of the Gaussian prior of its size around 0, in the unit of its kind.
    """

    kind: NuisanceKind
    dataset: str
    signal: str
    prior_sd: float

    def __post_init__(self) -> None:
        if not self.prior_sd > 0:
            raise BadInput(f"nuisance: {self.kind.value} of {self.signal} needs a size above 0, got {self.prior_sd}")


# Sensor errors with their sizes.
SensorErrors = Sequence[tuple[Nuisance, float]]


def gains(errors: SensorErrors, dataset: str, channels: Sequence[str]) -> NDArray[np.float64]:
    """(n_c,) factors by which sensor errors of kind GAIN multiply the channels of a data set; 1 without an error."""
    found = np.ones(len(channels))
    for error, size in errors:
        if error.kind is NuisanceKind.GAIN and error.dataset == dataset and error.signal in channels:
            found[channels.index(error.signal)] += size
    return found
