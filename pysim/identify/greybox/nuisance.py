"""Errors of sensors and loggers: what makes measurements differ from a model though no physics is missing."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from enum import Enum

import numpy as np
from numpy.typing import NDArray

from pysim.types import BadInput


class NuisanceKind(Enum):
    """What may be wrong with a channel."""

    GAIN = "gain"  # share of the signal
    OFFSET = "offset"  # in the signal's unit
    DELAY = "delay"  # s
    DRIFT = "drift"  # in the signal's unit, from the first to the last record on the common clock


@dataclass(frozen=True)
class Nuisance:
    """One error of one channel, off in every model until it is chosen.

    Args:
        kind: what is wrong.
        dataset, signal: where.
        prior_sd: standard deviation of its size before the data are seen: a share, the signal's unit, or s.
    """

    kind: NuisanceKind
    dataset: str
    signal: str
    prior_sd: float

    def __post_init__(self) -> None:
        if not self.prior_sd > 0:
            raise BadInput(f"nuisance: {self.kind.value} of {self.signal} needs a size above 0, got {self.prior_sd}")


# Errors of sensors, and how large each is.
SensorErrors = Sequence[tuple[Nuisance, float]]


def gains(errors: SensorErrors, dataset: str, channels: Sequence[str]) -> NDArray[np.float64]:
    """(n_c,) by which the sensors multiply each channel of a data set."""
    found = np.ones(len(channels))
    for error, size in errors:
        if error.kind is NuisanceKind.GAIN and error.dataset == dataset and error.signal in channels:
            found[channels.index(error.signal)] += size
    return found
