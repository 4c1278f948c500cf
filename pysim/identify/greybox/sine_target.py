"""The stepped sines of one test: their harmonics beside those of the model's periodic orbits."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from pysim.identify.greybox.response import LogResponse, log_response, thesis_deviation
from pysim.identify.greybox.sine_log import SineLog
from pysim.identify.greybox.target import Residual, Run, Simulated, stacked
from pysim.types.record_kind import STEPPED_SINE

Array = NDArray[np.float64]


@dataclass(frozen=True)
class SineTarget:
    """Logs at one offset and amplitude.

    Args:
        dataset, use: of the logs.
        logs: by increasing frequency.
        runs: one per log, recorded at equidistant points over one period.
        reference: place of the log whose gain counts as 0 dB; None: gains as they are.
    """

    dataset: str
    use: str
    logs: tuple[SineLog, ...]
    runs: tuple[Run, ...]
    reference: int | None
    kind: str = STEPPED_SINE.name
    domain: str = "frequency"

    def without(self, sources: Collection[str]) -> SineTarget:
        """The target without the logs of these sources; gains are as they are where the reference is among them."""
        kept = [i for i, log in enumerate(self.logs) if log.source not in sources]
        logs, runs = tuple(self.logs[i] for i in kept), tuple(self.runs[i] for i in kept)
        return replace(
            self, logs=logs, runs=runs, reference=kept.index(self.reference) if self.reference in kept else None
        )

    def weighted(self, simulated: Sequence[Simulated]) -> Residual:
        """Mean and harmonics, uncorrelated, over their noise."""
        parts = []
        for log, answer in zip(self.logs, simulated, strict=True):
            noise = np.array(log.noise)
            values = (log.harmonics - log.onto @ answer.values) / noise
            slopes = -np.tensordot(log.onto, answer.slopes, axes=1) / noise[:, None]
            parts.append(Residual(values.ravel(), slopes.reshape(values.size, -1)))
        return stacked(parts, parts[0].slopes.shape[1])

    def deviation(self, simulated: Sequence[Simulated]) -> Residual:
        """Magnitudes and phases of every compared signal. Source: thesis Eq. 2.11 to 2.13 and 2.25."""
        parts = []
        for j in range(len(self.logs[0].measured.names)):
            measured = np.array([self.measured_gains[i, j] for i in range(len(self.logs))])
            parts.append(thesis_deviation(measured, self.response(simulated, j), self.reference))
        return stacked(parts, parts[0].slopes.shape[1])

    @cached_property
    def measured_gains(self) -> NDArray[np.complex128]:
        """ln(gain) + j phase of every log and column, (n_f, n_y)."""
        return np.array([np.log(log.coefficients(log.harmonics)[1] / log.sine.amplitude) for log in self.logs])

    def response(self, simulated: Sequence[Simulated], column: int) -> LogResponse:
        """The model's response in one column."""
        rows = []
        for log, answer in zip(self.logs, simulated, strict=True):
            onto = log.fundamental() @ log.onto
            rows.append(
                log_response(onto @ answer.values[:, column], onto @ answer.slopes[:, column], log.sine.amplitude)
            )
        return LogResponse(np.array([row[0] for row in rows]), np.array([row[1] for row in rows]))
