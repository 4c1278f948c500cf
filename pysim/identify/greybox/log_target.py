"""A log over time: sample by sample beside the model driven by the logged command."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from pysim.identify.greybox.target import Residual, Run, Simulated
from pysim.types import Record

Array = NDArray[np.float64]


@dataclass(frozen=True)
class LogTarget:
    """Every sample of every compared signal.

    Args:
        dataset, source, kind, use: of the log.
        measured: the compared columns.
        noise: (n_y,) standard deviations, in the columns' units.
        full_scale: (n_y,) what counts as 100 percent, in the columns' units.
        run: the model's run, recorded at the log's times.
        index: of the log, as in `RecordFit`.
    """

    dataset: str
    source: str
    kind: str
    use: str
    measured: Record
    noise: tuple[float, ...]
    full_scale: tuple[float, ...]
    run: Run
    domain: str = "time"
    index: int = field(kw_only=True)

    @property
    def runs(self) -> tuple[Run, ...]:
        """The one run."""
        return (self.run,)

    def weighted(self, simulated: Sequence[Simulated]) -> Residual:
        """Per sample and signal, over the noise."""
        return self._over(np.array(self.noise), simulated[0])

    def deviation(self, simulated: Sequence[Simulated]) -> Residual:
        """Per sample and signal, in percent of full scale. Source: thesis Eq. 2.24, Table 4.9."""
        return self._over(np.array(self.full_scale) / 100, simulated[0])

    def _over(self, size: Array, simulated: Simulated) -> Residual:
        values = (self.measured.values - simulated.values) / size
        slopes = -simulated.slopes / size[:, None]
        return Residual(values.ravel(), slopes.reshape(values.size, -1))
