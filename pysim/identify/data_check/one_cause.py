"""Several outputs that do not fit a model's answers, where one step explains them: a turned input, or a swap."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Mapping
from dataclasses import replace
from itertools import combinations
from typing import Any

import numpy as np

from pysim.identify.data_check.check import DataCheck
from pysim.identify.data_check.finding import Finding, FindingCode, finding
from pysim.identify.data_check.settings import ModelCheckSettings
from pysim.io.prepare import Flip, Rename, Step, logs_called
from pysim.types import Dataset, Record

_SETTINGS = ModelCheckSettings()

Checked = tuple[DataCheck, Mapping[str, Record]]


def with_one_cause(found: DataCheck, answers: Mapping[str, Record], check: Callable[[Step], Checked]) -> DataCheck:
    """The same check with one finding for all turned signs, where a single step leaves none and the logs fit as well,
    and one for two signals whose levels tell that their names are swapped.

    Args:
        answers: of the model to the logs.
        check: of the data after a step, with the model's answers to these.
    """
    found = _swapped_by_level(found, answers)
    signs = [one for one in found.beside_model if one.code is FindingCode.SIGN]
    outputs, dataset = tuple(str(one.values["signal"]) for one in signs), found.dataset
    some = {step.logs for one in signs for step in one.cure if isinstance(step, Flip)}
    if len(some) != 1 or dataset.responses():
        return found
    (logs,) = some
    those = {record.source for name in logs for record in logs_called(dataset, name)} or {*answers}
    steps: list[Any] = [Flip((one.name,), logs) for one in dataset.signals if one.role == "input"]
    steps += [] if logs else _swaps(dataset, outputs)

    def misfit(data: Dataset, its: Mapping[str, Record]) -> float:
        return _misfit(data, {source: answer for source, answer in its.items() if source in those})

    allowed = _SETTINGS.one_cause if len(signs) > 1 else _SETTINGS.one_output
    best, result = min(misfit(dataset, answers), allowed * misfit(Flip(outputs, logs).apply(dataset), answers)), found
    for step in steps:
        after, its = check(step)
        after = _swapped_by_level(after, its)
        size = misfit(after.dataset, its)
        if size < best and not any(one.code is FindingCode.SIGN for one in after.beside_model):
            best, cause = size, _cause(step, signs[0].source, outputs)
            result = replace(found, beside_model=(cause, *after.beside_model))
    return result


def _swapped_by_level(found: DataCheck, answers: Mapping[str, Record]) -> DataCheck:
    """The same with a finding for two signals that are near each other's simulated signal, and far from their own."""
    dataset, findings = found.dataset, list(found.beside_model)
    taken = {name for one in findings if one.code is FindingCode.SWAPPED for name in one.values.values()}
    outputs = [s.name for s in dataset.signals if s.role == "output"]
    for step in _swaps(dataset, outputs) if answers and not dataset.responses() else ():
        own = {*step.names}
        if own & taken:
            continue
        if _misfit(step.apply(dataset), answers, own) >= _SETTINGS.swapped_level * _misfit(dataset, answers, own):
            continue
        taken |= own
        findings = [
            one for one in findings if one.code is FindingCode.NOT_DRIVEN or one.values.get("signal") not in own
        ]
        findings.append(_cause(step, next(iter(answers)), ()))
    return replace(found, beside_model=tuple(findings))


def _swaps(dataset: Dataset, outputs: Iterable[str]) -> list[Rename]:
    """Of the names of two outputs in the same unit."""
    pairs = combinations(outputs, 2)
    return [Rename({a: b, b: a}) for a, b in pairs if dataset.signal(a).unit == dataset.signal(b).unit]


def _cause(step: Flip | Rename, source: str, outputs: tuple[str, ...]) -> Finding:
    if isinstance(step, Flip):
        told = {"signal": step.signals[0], "outputs": ", ".join(outputs)}
        told |= {"logs": ", ".join(step.logs)} if step.logs else {}
        return finding(FindingCode.TURNED_INPUT, source, step, **told)
    one, other = step.names
    return finding(FindingCode.SWAPPED, source, step, signal=one, other=other)


def _misfit(dataset: Dataset, answers: Mapping[str, Record], names: Collection[str] = ()) -> float:
    """Mean square of measured less simulated outputs, level and all, in units of the variance of each.

    Args:
        names: of the outputs; all where there are none.
    """
    parts = []
    for record in dataset.logs():
        log, answer = record.data, answers.get(record.source)
        for signal in dataset.signals:
            own = {signal.variable, signal.name} & {*answer.names} if answer else set()
            counts = signal.name in (names or dataset.columns(record, "output"))
            if answer and own and counts and isinstance(log, Record) and signal.name in log.names:
                simulated = answer[signal.variable if signal.variable in own else signal.name]
                away = log[signal.name] - np.interp(log.time, answer.time, simulated)
                parts.append(float(np.nanmean(away**2) / max(float(np.var(simulated)), np.finfo(float).tiny)))
    return float(np.mean(parts)) if parts else 0.0
