"""Columns over time, as they are and beside what models make of them."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from pysim.io import shown_unit
from pysim.present.interactive.look import LOOKS, Figure
from pysim.present.interactive.overlay import overlay_figure, signal_trace
from pysim.types import BadInput, Record, RecordFit

_MODELS = ("last", "refit", "prior")  # keys of LOOKS, in the order in which models are given


def lines_figure(records: Mapping[str, Record]) -> Figure:
    """A panel per signal and a line per record.

    Args:
        records: by name.
    Raises:
        BadInput: nothing to draw.
    """
    units = {n: unit for one in records.values() for n, unit in zip(one.names, one.units, strict=True)}
    if not units:
        raise BadInput("nothing to draw: there is no log over time")
    shown = {name: shown_unit(unit) for name, unit in units.items()}
    traces = []
    for k, (words, one) in enumerate(records.items()):
        for name in one.names:
            (unit, factor), panel = shown[name], list(units).index(name) + 1
            key = list(LOOKS)[k % len(LOOKS)]
            traces.append(_line(key, words, panel, one.time, factor * one[name], name == one.names[0], unit))
    return overlay_figure(list(units), [unit for unit, _ in shown.values()], [], traces)


def beside_figure(beside: Mapping[str, RecordFit]) -> Figure:
    """One log, measured and as each model has it, and below it what each leaves.

    Args:
        beside: name of a model -> the log beside it.
    """
    first = next(iter(beside.values())).measured
    shown = [shown_unit(unit) for unit in first.units]
    keys = {name: _MODELS[k % len(_MODELS)] for k, name in enumerate(beside)}
    traces = []
    for j, (unit, factor) in enumerate(shown):
        at = 2 * j + 1
        traces.append(_line("measured", "measured", at, first.time, factor * first.values[:, j], j == 0, unit))
        for name, one in beside.items():
            y = factor * one.simulated.values[:, j]
            words = f"{name}: fit {one.fit_percent[first.names[j]]:.1f} %"
            traces.append(_line(keys[name], words, at, one.simulated.time, y, j == 0, unit))
            left, unit_left = one.residual.values[:, j], "times the noise"
            traces.append(_line(keys[name], name, at + 1, one.residual.time, left, False, unit_left))
    models = [(key, name) for name, key in keys.items()]
    return overlay_figure(first.names, [unit for unit, _ in shown], models, traces)


def _line(key: str, words: str, panel: int, x: Any, y: Any, legend: bool, unit: str) -> dict[str, Any]:
    return signal_trace(key, words, panel, x.tolist(), y.tolist(), legend=legend, unit=unit) | {"legendgroup": words}
