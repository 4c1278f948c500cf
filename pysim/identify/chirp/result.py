"""Result of the analysis of one chirp."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from pysim.identify.chirp.branch import Branch
from pysim.identify.logged import LoggedWave
from pysim.types import FrequencyResponse, SineTest
from pysim.types.note import Note


@dataclass(frozen=True)
class ChirpAnalysis:
    """Frequency responses from one chirp.

    Args:
        source: source of the record.
        command: the chirp of the logged command.
        level: reference from which tops and bottoms count, in the output's unit.
        top, bottom: n points each, in pairs of neighbouring extremes.
        mean: mean of each pair.
        apart: indices, from low frequency up, of means whose fits share no sample.
        noise: standard deviation of the output about the local fits, in its unit.
        input, output: names of the signals.
        input_unit, output_unit: units of the signals.
        notes: reasons why the numbers may be wrong.
    """

    source: str
    command: LoggedWave
    level: float
    top: Branch
    bottom: Branch
    mean: Branch
    apart: tuple[int, ...]
    noise: float
    input: str
    output: str
    input_unit: str
    output_unit: str
    notes: tuple[Note, ...]

    @property
    def response(self) -> FrequencyResponse:
        """The mean as a frequency response, reduced to points with independent noise (`apart`), as a fit assumes.

        The covariance is that of amplitudes: standard deviations of gains times the command's amplitude.
        """
        mean, places, amplitude = self.mean, list(self.apart), self.command.amplitude
        covariance = np.zeros((len(places), 3, 3))
        covariance[:, 0, 0] = (mean.gain_deviation[places] * amplitude) ** 2
        covariance[:, 1, 1] = mean.phase_deviation[places] ** 2
        return FrequencyResponse(
            frequency=mean.frequency[places],
            gain=mean.gain[places],
            phase=mean.phase[places],
            test=SineTest(self.command.offset, amplitude, self.input, self.output),
            origin=f"measured, chirp {self.source}",
            covariance=covariance,
        )
