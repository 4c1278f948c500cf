"""What the family of targets shares: a run of the model, its result, and residuals with their slopes."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from pysim.simulate import Periodic
from pysim.types import Experiment

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Run:
    """One run that a target needs, without the parameters that are fitted.

    Args:
        record: source of the log, which may have parameters of its own.
        experiment: a run over time; with `orbit`, the same test as a transient, recorded at the orbit's points.
        orbit: the periodic steady state, where one is to be found first.
    """

    record: str
    experiment: Experiment
    orbit: Periodic | None = None


@dataclass(frozen=True)
class Simulated:
    """Answer of a run: values (n_t, n_y) in the variables' units, slopes (n_t, n_y, n_x) by the search's numbers."""

    values: Array
    slopes: Array


@dataclass(frozen=True)
class Residual:
    """Measured minus simulated: values (n_r,) and slopes (n_r, n_x)."""

    values: Array
    slopes: Array


class Target(Protocol):
    """Measurements in the form in which the model is compared with them."""

    @property
    def use(self) -> str:
        """ "fit" | "validate"."""
        ...

    @property
    def domain(self) -> str:
        """ "time" | "frequency"."""
        ...

    @property
    def runs(self) -> tuple[Run, ...]:
        """What has to be simulated."""
        ...

    def weighted(self, simulated: Sequence[Simulated]) -> Residual:
        """In standard deviations of the noise, uncorrelated."""
        ...

    def deviation(self, simulated: Sequence[Simulated]) -> Residual:
        """As the thesis counts it: percent over time (Eq. 2.24), 90/20 dB and degrees over frequency (Eq. 2.25)."""
        ...


def stacked(parts: Sequence[Residual], size: int) -> Residual:
    """One residual of many; n_x is `size`."""
    values = [np.zeros(0), *(part.values for part in parts)]
    slopes = [np.zeros((0, size)), *(part.slopes for part in parts)]
    return Residual(np.concatenate(values), np.concatenate(slopes))
