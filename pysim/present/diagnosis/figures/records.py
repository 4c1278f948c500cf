"""Telling records of a diagnosis: measured beside the model before and after, and what is left in units of noise."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from pysim.present import style
from pysim.present.diagnosis.words import last_name
from pysim.present.overlay import Side, beside_figure
from pysim.types import BadInput, Diagnosis, ErrorStep, RecordFit
from pysim.types.answer import PRIOR, REFIT

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_PERIODS = 2.0  # of a stepped sine that are shown
_STRETCH = 2.0  # s of another log that are shown, where the refitted model fails most


def telling_records(diagnosis: Diagnosis) -> list[RecordFit]:
    """Records on which the base model fails most, as it has them: a log, a stepped sine, and one not fitted."""
    base = diagnosis.base
    kinds: dict[tuple[bool, bool], RecordFit] = {}
    for record in () if base is None else base.records:
        key = (bool(record.harmonics), record.held_out)
        if key not in kinds or _size(record) > _size(kinds[key]):
            kinds[key] = record
    order = ((False, False), (True, False), (False, True), (True, True))
    return [kinds[key] for key in order if key in kinds][:3]


def same_record(record: RecordFit, step: ErrorStep) -> RecordFit | None:
    """The record of the same log beside a model; None where that has none."""
    return next((one for one in step.records if one.index == record.index), None)


def steps_shown(diagnosis: Diagnosis) -> list[tuple[str, ErrorStep, str]]:
    """Untouched, refitted and final model: name, step and colour of each."""
    looks = {PRIOR: ("as it is", style.LIMIT), REFIT: ("refitted", style.COLOURS[1])}
    steps = [(*looks[step.step], step) for step in diagnosis.history if step.step in looks]
    if diagnosis.last is not None:
        steps.append((last_name(diagnosis), style.COLOURS[0], diagnosis.last))
    return [(name, step, colour) for name, colour, step in steps if step.records]


def steps_compared(diagnosis: Diagnosis) -> list[tuple[str, ErrorStep, str]]:
    """The same without the untouched model where there are others: what it leaves would hide theirs."""
    shown = steps_shown(diagnosis)
    return [one for one in shown if one[1].step != PRIOR] or shown


def overlay_figure(diagnosis: Diagnosis, record: RecordFit) -> Figure:
    """One record: each signal as measured and as the untouched, the refitted and the final model has it.

    Below, what each model leaves in standard deviations of the noise; the grey band holds 95 percent of noise alone.
    A stretch is shown where the refitted model fails most; a stepped sine by its last periods.

    Args:
        record: one of the base model's.
    Raises:
        BadInput: it is none of these.
    """
    base = diagnosis.base
    if base is None or not any(one is record for one in base.records):
        raise BadInput(f"overlay figure: {record.source!r} is no record of the diagnosis' base model")
    beside = [(name, same_record(record, step), colour) for name, step, colour in steps_shown(diagnosis)]
    shown = [(name, one, colour) for name, one, colour in beside if one is not None]
    dashes = reversed(style.DASHES[: len(shown)])  # the last: solid
    sides = [
        Side(name, name, one, {"color": colour, "linestyle": dash})
        for (name, one, colour), dash in zip(shown, dashes, strict=True)
    ]
    untouched = [one.name for one in sides[:-1][:1]]  # where there are others its residual would hide theirs
    return beside_figure(sides, _stretch(sides[len(untouched)].record), hidden=untouched)


def _stretch(record: RecordFit) -> slice:
    """Samples to show: the last periods of a stepped sine, else those where the residual is largest."""
    time = record.measured.time
    if record.harmonics:
        length = _PERIODS / record.harmonics[0].frequency
        return slice(int(np.searchsorted(time, time[-1] - length)), time.size)
    count = int(np.searchsorted(time, time[0] + _STRETCH))
    if count >= time.size:
        return slice(0, time.size)
    power = np.nansum(record.residual.values**2, axis=1)
    begin = int(np.argmax(np.convolve(power, np.ones(count), mode="valid")))
    return slice(begin, begin + count)


def _size(record: RecordFit) -> float:
    return math.sqrt(float(np.nanmean(record.residual.values**2)))
