"""A frequency response that exists as a table only: magnitudes and phases beside those of the model's orbits."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pysim.identify.greybox.response import (
    DB,
    MAGNITUDE_WEIGHT,
    LogResponse,
    differences,
    log_response,
    thesis_deviation,
)
from pysim.identify.greybox.target import Residual, Run, Simulated, stacked
from pysim.types import FrequencyResponse
from pysim.types.record_kind import RESPONSE_TABLE

Array = NDArray[np.float64]

# Where a table has no covariance a degree counts as much as in Eq. 2.25, and a dB too.
_UNTOLD_DEG = 1.0
_UNTOLD_DB = _UNTOLD_DEG / MAGNITUDE_WEIGHT


@dataclass(frozen=True)
class TableTarget:
    """One response.

    Args:
        dataset, source, use: of the table.
        measured: the response; its test names columns.
        runs: one per frequency, recorded at equidistant points over one period.
        reference: place of the frequency whose gain counts as 0 dB; None: gains as they are.
    """

    dataset: str
    source: str
    use: str
    measured: FrequencyResponse
    runs: tuple[Run, ...]
    reference: int | None
    kind: str = RESPONSE_TABLE.name
    domain: str = "frequency"

    @property
    def told(self) -> bool:
        """Whether the table says how uncertain it is."""
        return self.measured.covariance is not None

    def weighted(self, simulated: Sequence[Simulated]) -> Residual:
        """Magnitudes, then phases, over their standard deviations."""
        magnitude, phase = differences(self._logarithm, self.response(simulated), self.reference)
        db, deg = self._deviations()
        parts = [Residual(r.values / s, r.slopes / s[:, None]) for r, s in ((magnitude, db), (phase, deg))]
        return stacked(parts, parts[0].slopes.shape[1])

    def deviation(self, simulated: Sequence[Simulated]) -> Residual:
        """Source: thesis Eq. 2.25."""
        return thesis_deviation(self._logarithm, self.response(simulated), self.reference)

    def response(self, simulated: Sequence[Simulated]) -> LogResponse:
        """The model's response at the table's frequencies."""
        rows = []
        for answer in simulated:
            n = answer.values.shape[0]
            phase = 2 * np.pi * np.arange(n) / n
            onto = 2 / n * np.stack([np.sin(phase), np.cos(phase)])
            rows.append(log_response(onto @ answer.values[:, 0], onto @ answer.slopes[:, 0], self._amplitude))
        return LogResponse(np.array([row[0] for row in rows]), np.array([row[1] for row in rows]))

    @property
    def _amplitude(self) -> float:
        return self.measured.test.amplitude

    @property
    def _logarithm(self) -> NDArray[np.complex128]:
        return np.asarray(np.log(self.measured.gain) + 1j * self.measured.phase)

    def _deviations(self) -> tuple[Array, Array]:
        """Standard deviations in dB and degrees, (n_f,) each."""
        covariance, ones = self.measured.covariance, np.ones(self.measured.frequency.size)
        if covariance is None:
            return _UNTOLD_DB * ones, _UNTOLD_DEG * ones
        amplitude = self.measured.gain * self._amplitude
        return DB * np.sqrt(covariance[:, 0, 0]) / amplitude, np.degrees(np.sqrt(covariance[:, 1, 1]))
