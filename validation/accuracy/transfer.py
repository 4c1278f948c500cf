"""The black box: a transfer function per fitted working point, as in thesis Table 4.1, and nothing in between."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray
from scipy.signal import lsim

from pysim.identify import TransferFunction, frequency_deviations, time_deviations
from pysim.identify.blackbox import FittedResponse, Structure, fit_dataset
from pysim.identify.frf import measured_responses
from pysim.types import Dataset, Deviation, MeasuredRecord, Record, SineTest
from validation.accuracy.judged import ANGLE, FIT, HELD_OUT, QUASI_STATIC_HZ, STEADY, Judged, Row

Array = NDArray[np.float64]
COMMAND = "alphaCMD"
LABEL = "black box"
FULL_SCALE = 100.0  # %
# Of those tried on the fitted tests the one that meets Table 1.3 at all of them. Table 4.1's five poles without zeros
# end at the edge of stability here: the dead band's share of small amplitudes looks like a resonance above 30 Hz.
STRUCTURE = Structure(poles=3, zeros=2, stable=True)


def black_box(dataset: Dataset, wave: str) -> Judged:
    """Fitted to the stepped sines that are not held out; a test or log elsewhere gets the nearest one's function.

    Args:
        wave: source of the log that is drawn.
    """
    fitted = fit_dataset(fitting(dataset), STRUCTURE, weights="relative", output=ANGLE)
    rows = [*_responses(dataset, fitted), *_steady(dataset, fitted)]
    drawn: Record | None = None
    for record in dataset.records:
        data = record.data
        if record.kind == "frequency-response" or not isinstance(data, Record):
            continue
        simulated = over_time(data, nearest(fitted, *_around(record, data)).fit.function)
        deviations = time_deviations(simulated, data[ANGLE], FULL_SCALE)
        rows.append(Row(f"{record.source}: {ANGLE}", record.use, deviations))
        if record.source == wave:
            drawn = Record(data.time, simulated[:, None], (ANGLE,), ("%",), origin="simulated")
    return Judged(LABEL, tuple(rows), {} if drawn is None else {LABEL: drawn})


def fitting(dataset: Dataset) -> Dataset:
    """Without what is held out."""
    return replace(dataset, records=tuple(record for record in dataset.records if record.use == FIT))


def nearest(fitted: Sequence[FittedResponse], offset: float, amplitude: float) -> FittedResponse:
    """The working point next to that one: by offset, then by amplitude, %."""

    def far(one: FittedResponse) -> tuple[float, float]:
        test = one.measured.test
        return abs(test.offset - offset), abs(test.amplitude - amplitude)

    return min(fitted, key=far)


def over_time(log: Record, function: TransferFunction) -> Array:
    """The angle (n_t,) in % that the function makes of the log's command, at rest with its first value."""
    time, command = log.time, log[COMMAND]
    _, moved, _ = lsim((function.numerator, function.denominator), command - command[0], time - time[0])
    return np.asarray(function.gain * command[0] + moved, dtype=np.float64)


def _around(record: MeasuredRecord, data: Record) -> tuple[float, float]:
    """Offset and amplitude of a log: as it says, else mean and largest swing of its command."""
    command = data[COMMAND]
    offset = float(np.mean(command)) if record.offset is None else record.offset
    return offset, float(np.abs(command - offset).max()) if record.amplitude is None else record.amplitude


def _responses(dataset: Dataset, fitted: Sequence[FittedResponse]) -> list[Row]:
    rows = []
    for one in measured_responses(dataset, output=ANGLE):
        test = one.response.test
        model = nearest(fitted, test.offset, test.amplitude).fit.function.response(one.response.frequency, test)
        rows.append(Row(f"{test.label}: {ANGLE}", _use(dataset, test), frequency_deviations(model, one.response)))
    return rows


def _steady(dataset: Dataset, fitted: Sequence[FittedResponse]) -> list[Row]:
    rows = []
    for one in measured_responses(dataset, output=ANGLE):
        test = one.response.test
        point = next(point for point in one.points if point.frequency == QUASI_STATIC_HZ)
        gain = nearest(fitted, test.offset, test.amplitude).fit.function.gain
        off = abs(gain * test.offset - point.mean)
        rows.append(Row(f"{test.label}: {ANGLE}", _use(dataset, test), (Deviation(STEADY, off),)))
    return rows


def _use(dataset: Dataset, test: SineTest) -> str:
    held = {(r.offset, r.amplitude) for r in dataset.records if r.use == HELD_OUT}
    return HELD_OUT if (test.offset, test.amplitude) in held else FIT
