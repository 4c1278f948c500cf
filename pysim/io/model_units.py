"""Data in the units in which a model counts."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from pysim.io.units import Scale
from pysim.types import Dataset, FrequencyResponse, MeasuredRecord, Model, Record, conversion


def in_model_units(dataset: Dataset, model: Model) -> Dataset:
    """A data set in the model's units, wherever these are of the same quantity as those of the signals.

    Fits and comparisons take the numbers of a model as they are. So does this: it moves the data. Signals whose
    variable is not in the model, or in a unit of another quantity, stay; `Model.measured` refuses those once they are
    looked at.

    Returns:
        the same data set where nothing differs, as between any data and a model in SI units.
    """
    units = {variable.name: variable.unit for variable in model.variables}
    found = {s.name: (units.get(s.variable, s.unit), s) for s in dataset.signals}
    pairs = {name: (unit, conversion(signal.unit, unit)) for name, (unit, signal) in found.items()}
    scales = {name: Scale(unit, *known) for name, (unit, known) in pairs.items() if known not in (None, (1.0, 0.0))}
    if not scales:
        return dataset
    return replace(
        dataset,
        signals=tuple(scales[s.name].signal(s) if s.name in scales else s for s in dataset.signals),
        records=tuple(_record(record, dataset, scales) for record in dataset.records),
    )


def _record(record: MeasuredRecord, dataset: Dataset, scales: Mapping[str, Scale]) -> MeasuredRecord:
    data = record.data
    if isinstance(data, FrequencyResponse):
        moved: Record | FrequencyResponse = _response(data, scales)
        command = data.test.input
    else:
        moved, inputs = _log(data, scales), dataset.columns(record, "input")
        command = record.command or (inputs[0] if len(inputs) == 1 else "")
    scale = scales.get(command)
    if scale is None:
        return replace(record, data=moved)
    offset = None if record.offset is None else scale.number(record.offset)
    amplitude = None if record.amplitude is None else scale.gain * record.amplitude
    return replace(record, data=moved, offset=offset, amplitude=amplitude)


def _log(log: Record, scales: Mapping[str, Scale]) -> Record:
    own = [scales.get(name, Scale(unit, 1.0)) for name, unit in zip(log.names, log.units, strict=True)]
    values = [log[name] * scale.gain + scale.zero for name, scale in zip(log.names, own, strict=True)]
    return replace(log, values=np.column_stack(values), units=tuple(scale.unit for scale in own))


def _response(response: FrequencyResponse, scales: Mapping[str, Scale]) -> FrequencyResponse:
    test, one = response.test, Scale("", 1.0)
    driven, answer = scales.get(test.input, one), scales.get(test.output, one)
    spread = np.array([answer.gain, 1.0, answer.gain])  # of amplitude, phase and mean
    return replace(
        response,
        gain=response.gain * (answer.gain / driven.gain),
        test=replace(test, offset=driven.number(test.offset), amplitude=driven.gain * test.amplitude),
        mean=None if response.mean is None else response.mean * answer.gain + answer.zero,
        covariance=None if response.covariance is None else response.covariance * np.outer(spread, spread),
    )
