"""Frequency responses of all stepped sines of a data set, one for each offset and amplitude."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from pysim.identify.columns import declared_noise, the_column
from pysim.identify.frf.sine_point import SinePoint, Window, sine_point
from pysim.io.prepare import refuse_missing_in
from pysim.types import BadInput, Dataset, FrequencyResponse, Record, SineTest
from pysim.types.note import Note, NoteCode
from pysim.types.record_kind import STEPPED_SINE


@dataclass(frozen=True)
class MeasuredResponse:
    """A frequency response and the logs behind it.

    Args:
        response: its covariance is that of amplitudes: standard deviations of gains times `test.amplitude`.
        points: one per frequency.
        input_unit, output_unit: units of the signals.
        use: use of the logs.
    """

    response: FrequencyResponse
    points: tuple[SinePoint, ...]
    input_unit: str
    output_unit: str
    use: str = "fit"

    @property
    def notes(self) -> tuple[Note, ...]:
        """The notes of all points with their frequencies, and one on significant harmonics, if there are any."""
        notes = [Note(one.code, {**one.values, "at": p.frequency}) for p in self.points for one in p.notes]
        distorted = [p for p in self.points if p.distorted]
        if distorted:
            worst = max(distorted, key=lambda p: p.distortion)
            counts = {"count": len(distorted), "points": len(self.points)}
            most = {"frequency": worst.frequency, "percent": 100 * worst.distortion}
            notes.append(Note(NoteCode.HARMONICS, {**counts, **most}))
        return tuple(notes)


class _Test(NamedTuple):
    """What the logs of one response have in common."""

    offset: float
    amplitude: float
    input: str
    output: str
    use: str


def measured_responses(
    dataset: Dataset,
    *,
    output: str | None = None,
    window: Window | None = None,
) -> tuple[MeasuredResponse, ...]:
    """Analyse every stepped sine.

    Records with the same nominal offset, amplitude and use form one response. If a frequency was tested again, the
    repeated logs form a second response.

    Args:
        output: the output signal; may be left out if the logs have only one.
        window: which periods of each log are fitted.
    Returns:
        responses in the order of the data set; their frequencies increase.
    Raises:
        BadInput: no such logs, no unique input or output, or a log that `sine_point` rejects.
    Source: thesis Section 2.3.
    """
    groups: dict[tuple[_Test, int], dict[float, SinePoint]] = {}
    seen: Counter[tuple[_Test, float]] = Counter()
    for record in dataset.records:
        if record.kind != STEPPED_SINE.name or not isinstance(record.data, Record):
            continue
        names = the_column(dataset, record, "input"), the_column(dataset, record, "output", output)
        refuse_missing_in(dataset, record, record.data, names)
        point = sine_point(record, *names, window=window, noise=declared_noise(dataset, names[1]))
        offset = _nominal(record.offset, point.command.offset)
        amplitude = _nominal(record.amplitude, point.command.amplitude)
        test = _Test(offset, amplitude, *names, record.use)
        groups.setdefault((test, seen[test, point.frequency]), {})[point.frequency] = point
        seen[test, point.frequency] += 1
    if not groups:
        raise BadInput(
            f'data set {dataset.name!r} has no log of kind "{STEPPED_SINE.name}"; give its stepped sines that kind'
        )
    return tuple(_response(dataset, test, again, points) for (test, again), points in groups.items())


def _nominal(told: float | None, fitted: float) -> float:
    """The value specified in the record, or else the fitted one, rounded to three digits."""
    return float(f"{fitted:.3g}") if told is None else told


def _response(dataset: Dataset, test: _Test, repetition: int, of_frequency: dict[float, SinePoint]) -> MeasuredResponse:
    points = tuple(of_frequency[f] for f in sorted(of_frequency))
    scale = np.diag([test.amplitude, 1.0, 1.0])
    ending = (f", repetition {repetition}" if repetition else "") + (", not fitted" if test.use != "fit" else "")
    response = FrequencyResponse(
        frequency=np.array([p.frequency for p in points]),
        gain=np.array([p.gain for p in points]),
        phase=np.unwrap([p.phase for p in points]),
        test=SineTest(test.offset, test.amplitude, test.input, test.output),
        origin=f"measured, {dataset.name}{ending}",
        mean=np.array([p.mean for p in points]),
        covariance=np.array([scale @ p.covariance @ scale for p in points]),
    )
    units = dataset.signal(test.input).unit, dataset.signal(test.output).unit
    return MeasuredResponse(response, points, *units, test.use)
