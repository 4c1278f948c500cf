"""All stepped sines of a data set, as a frequency response per offset and amplitude."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass

import numpy as np

from pysim.identify._columns import declared_noise, the_column
from pysim.identify.frf.sine_point import SinePoint, Window, sine_point
from pysim.identify.logged import STEPPED_SINE
from pysim.types import BadInput, Dataset, FrequencyResponse, Record, SineTest


@dataclass(frozen=True)
class MeasuredResponse:
    """A frequency response and the logs behind it.

    Args:
        response: its covariance is scaled to the test's nominal amplitude, so that the standard deviation of a gain is
            that of the amplitude over `test.amplitude`.
        points: (n_f,) one per frequency.
        input_unit, output_unit: of the signals.
    """

    response: FrequencyResponse
    points: tuple[SinePoint, ...]
    input_unit: str
    output_unit: str

    @property
    def remarks(self) -> tuple[str, ...]:
        """Those of all points, each with its frequency, and harmonics where there are any."""
        texts = [f"{p.frequency:g} Hz: {remark}" for p in self.points for remark in p.remarks]
        distorted = [p for p in self.points if p.distorted]
        if distorted:
            worst = max(distorted, key=lambda p: p.distortion)
            texts.append(
                f"harmonics beyond the noise at {len(distorted)} of {len(self.points)} frequencies, most at "
                f"{worst.frequency:g} Hz with {100 * worst.distortion:.2g} percent: the response is not linear there"
            )
        return tuple(texts)


def measured_responses(
    dataset: Dataset,
    *,
    output: str | None = None,
    window: Window | None = None,
) -> tuple[MeasuredResponse, ...]:
    """Analyse every log of kind "frequency-response".

    Records of one nominal offset and amplitude form a response; where a frequency was tested again, the second logs
    form a second one.

    Args:
        output: the responding signal; may be left out where the logs hold a single one.
        window: which periods of each log are fitted.
    Returns:
        in the order in which the groups appear in the data set; frequencies increase.
    Raises:
        BadInput: no such logs, no input or output to be told apart, or a log that `sine_point` refuses.
    Source: thesis Section 2.3.
    """
    groups: dict[tuple[float, float, str, str, int], dict[float, SinePoint]] = {}
    seen: Counter[tuple[float, float, str, str, float]] = Counter()
    for record in dataset.records:
        if record.kind != STEPPED_SINE or not isinstance(record.data, Record):
            continue
        names = the_column(dataset, record, "input"), the_column(dataset, record, "output", output)
        point = sine_point(record, *names, window=window, noise=declared_noise(dataset, names[1]))
        offset = _nominal(record.offset, point.command.offset)
        amplitude = _nominal(record.amplitude, point.command.amplitude)
        again = (offset, amplitude, *names, point.frequency)
        groups.setdefault((offset, amplitude, *names, seen[again]), {})[point.frequency] = point
        seen[again] += 1
    if not groups:
        raise BadInput(
            f'data set {dataset.name!r} has no log of kind "{STEPPED_SINE}"; give its stepped sines that kind'
        )
    return tuple(_response(dataset, *key, points) for key, points in groups.items())


def _nominal(told: float | None, fitted: float) -> float:
    """What the record tells, else the fit to three digits."""
    return float(f"{fitted:.3g}") if told is None else told


def _response(
    dataset: Dataset,
    offset: float,
    amplitude: float,
    input_: str,
    output: str,
    repetition: int,
    of_frequency: dict[float, SinePoint],
) -> MeasuredResponse:
    points = tuple(of_frequency[f] for f in sorted(of_frequency))
    scale = np.diag([amplitude, 1.0, 1.0])
    response = FrequencyResponse(
        frequency=np.array([p.frequency for p in points]),
        gain=np.array([p.gain for p in points]),
        phase=np.unwrap([p.phase for p in points]),
        test=SineTest(offset, amplitude, input_, output),
        origin=f"measured, {dataset.name}" + (f", repetition {repetition}" if repetition else ""),
        mean=np.array([p.mean for p in points]),
        covariance=np.array([scale @ p.covariance @ scale for p in points]),
    )
    return MeasuredResponse(response, points, dataset.signal(input_).unit, dataset.signal(output).unit)
