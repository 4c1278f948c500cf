"""A frequency response that is given as a table: magnitudes and phases compared with those of the model's orbits."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from pysim.identify.accuracy import frequency_deviations
from pysim.identify.greybox.context import Context
from pysim.identify.greybox.nuisance import Nuisance, SensorErrors
from pysim.identify.greybox.observation import Measure, Run, Simulated
from pysim.identify.greybox.response import (
    DB,
    MAGNITUDE_WEIGHT,
    LogResponse,
    beside_measured,
    differences,
    log_response,
    thesis_deviation,
)
from pysim.identify.greybox.sine_log import Sine
from pysim.identify.greybox.steady_run import settled_run
from pysim.types import BadInput, FrequencyResponse, MeasuredRecord, RecordFit, ResponseComparison, ResponseFit
from pysim.types.record_kind import RESPONSE_TABLE

Array = NDArray[np.float64]

# Standard deviations if a table has no covariance: a degree and a dB are weighted as in thesis Eq. 2.25.
UNSPECIFIED_DEG = 1.0
UNSPECIFIED_DB = UNSPECIFIED_DEG / MAGNITUDE_WEIGHT


@dataclass(frozen=True)
class ResponseTable:
    """One response.

    Args:
        dataset, source, use: of the table.
        measured: the response; its test names the columns of input and output.
        runs: one per frequency, recorded at equidistant points over one period.
        reference: index of the frequency whose gain counts as 0 dB; None: absolute gains.
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
    def sources(self) -> tuple[str, ...]:
        """The one table."""
        return (self.source,)

    def with_runs(self, runs: Sequence[Run]) -> ResponseTable:
        """See Observation."""
        return replace(self, runs=tuple(runs))

    def held_out(self) -> ResponseTable:
        """See Observation."""
        return replace(self, use="validate")

    def head(self, share: float) -> ResponseTable:
        """See Observation."""
        return self

    @property
    def specified(self) -> bool:
        """Whether the table has a covariance."""
        return self.measured.covariance is not None

    channels: tuple[str, ...] = ()
    noise: tuple[float, ...] = ()

    @property
    def channel_of_row(self) -> NDArray[np.intp]:
        """Zeros, since the rows are already in standard deviations."""
        return np.zeros(2 * self.measured.frequency.size, dtype=np.intp)

    @property
    def samples(self) -> Array:
        """None."""
        return np.zeros(0)

    @property
    def rest(self) -> Array:
        """None."""
        return np.zeros(0)

    def residual(self, answers: Sequence[Simulated], measure: Measure = Measure.SIGNAL) -> Array:
        """Magnitudes, then phases, over their standard deviations; or weighted as in thesis Eq. 2.25."""
        model = self.response(answers)
        if measure is Measure.THESIS:
            return thesis_deviation(self._logarithm, model, self.reference)
        magnitude, phase = differences(self._logarithm, model, self.reference)
        db, deg = self._deviations()
        return np.concatenate([magnitude / db[:, None], phase / deg[:, None]])

    def nuisance_columns(self, answers: Sequence[Simulated], nuisances: Sequence[Nuisance]) -> Array:
        """Zeros, since sensor errors are not modelled in a table."""
        return np.zeros((2 * self.measured.frequency.size, len(nuisances)))

    def sensed(self, answers: Sequence[Simulated], errors: SensorErrors) -> tuple[Simulated, ...]:
        """The results unchanged, since sensor errors are not modelled in a table."""
        return tuple(answers)

    def pieces(self, residual: Array, shortest: float) -> NDArray[np.intp]:
        """Magnitude and phase of each frequency are one piece."""
        return np.tile(np.arange(self.measured.frequency.size), 2)

    def response(self, answers: Sequence[Simulated]) -> LogResponse:
        """The model's response at the table's frequencies."""
        rows = []
        for answer in answers:
            n = answer.values.shape[0]
            phase = 2 * np.pi * np.arange(n) / n
            onto = 2 / n * np.stack([np.sin(phase), np.cos(phase)])
            rows.append(log_response(onto @ answer.values[:, 0], onto @ answer.slopes[:, 0], self._amplitude))
        return LogResponse(np.array([row[0] for row in rows]), np.array([row[1] for row in rows]))

    def beside(self, answers: Sequence[Simulated]) -> tuple[tuple[RecordFit, ...], tuple[ResponseFit, ...]]:
        """The response with the criteria of thesis Table 1.3."""
        model = beside_measured(self.measured, self.response(answers))
        reference = None if self.reference is None else float(self.measured.frequency[self.reference])
        deviations = frequency_deviations(model, self.measured, reference_hz=reference)
        return (), (ResponseFit(self.dataset, self.use, ResponseComparison(self.measured, model, deviations)),)

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
            return UNSPECIFIED_DB * ones, UNSPECIFIED_DEG * ones
        amplitude = self.measured.gain * self._amplitude
        return DB * np.sqrt(covariance[:, 0, 0]) / amplitude, np.degrees(np.sqrt(covariance[:, 1, 1]))


def response_table(context: Context, record: MeasuredRecord, response: FrequencyResponse) -> ResponseTable:
    """The observation of one table of a data set.

    Raises:
        BadInput: no row at the reference frequency.
    """
    test, reference_hz = response.test, context.treatment.reference_hz
    near = np.flatnonzero(np.isclose(response.frequency, reference_hz or -1.0, rtol=1e-6))
    if reference_hz is not None and not near.size:
        raise BadInput(
            f"{record.source}: magnitudes relative to {reference_hz:g} Hz need that frequency; measured are "
            f"{response.frequency[0]:g} to {response.frequency[-1]:g} Hz: take one of these as the reference, or none"
        )
    sines = [Sine(test.offset, test.amplitude, f, 0.0, 0.0, math.inf) for f in response.frequency.tolist()]
    runs = tuple(settled_run(context, record.source, test, sine) for sine in sines)
    return ResponseTable(
        context.dataset.name, record.source, record.use, response, runs, int(near[0]) if near.size else None
    )
