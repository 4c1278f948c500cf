"""The table of criteria as a figure, and the held-out wave over time."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from matplotlib.figure import Figure

from pysim.present.overlay import time_response_figure
from pysim.present.style import COLOURS, LIMIT, MARKERS, SMALL, TEXT, legend_above, new_figure, quiet
from pysim.types import Record
from validation.accuracy.judged import ANGLE, COLUMNS, FIT, HELD_OUT, VALVE, Judged

_BEGIN, _END = 5.0, 8.0  # s of the wave that are drawn
_COLUMNS = 3


def criteria_figure(models: Sequence[Judged]) -> Figure:
    """A panel per criterion, a row per model; filled is fitted, hollow is held out, the limit edges a grey field."""
    figure = new_figure(9.0, 6.6)
    axes = figure.subplots(-(-len(COLUMNS) // _COLUMNS), _COLUMNS, sharey=True).ravel()
    handles: list[Any] = []
    for panel, (criterion, signal) in zip(axes, COLUMNS, strict=True):
        quiet(panel)
        values = [[model.worst(criterion, use, signal) for use in (FIT, HELD_OUT)] for model in models]
        for k, pair in enumerate(values):
            look: dict[str, Any] = {"color": COLOURS[k], "marker": MARKERS[k], "linestyle": "none", "markersize": 6.5}
            for value, face, shift in zip(pair, (COLOURS[k], "white"), (-0.14, 0.14), strict=True):
                if value is not None:
                    (handle,) = panel.plot([value], [k + shift], markerfacecolor=face, **look)
                    handles += [handle] if panel is axes[0] and k == 0 else []
        right = 1.15 * max([criterion.limit, *(value for pair in values for value in pair if value is not None)])
        panel.axvspan(criterion.limit, right, color=LIMIT, alpha=0.14, linewidth=0)
        panel.axvline(criterion.limit, color=LIMIT, linewidth=1.0)
        panel.set_xlim(-0.03 * right, right)
        name = {ANGLE: "angle", VALVE: "valve"}[signal]
        panel.set_title(f"{name}: {criterion.name}\nlimit {criterion.limit:.2g} {criterion.unit}", fontsize=SMALL)
        panel.set_xlabel(criterion.unit, fontsize=TEXT)
        panel.set_yticks(range(len(models)), [model.label for model in models])
        panel.set_ylim(len(models) - 0.5, -0.5)
    legend_above(figure, handles, ["fitted", "held out"])
    return figure


def wave_figure(models: Sequence[Judged]) -> Figure:
    """Angle and valve of the held-out wave; only models that have a valve."""
    shown: dict[str, Record] = {}
    for model in models:
        for label, record in model.wave.items():
            if VALVE in record.names:
                shown.setdefault(label, _cut(record))
    return time_response_figure(shown, (ANGLE, VALVE))


def _cut(record: Record) -> Record:
    kept = (record.time >= _BEGIN) & (record.time <= _END)
    return Record(record.time[kept], record.values[kept], record.names, record.units, origin=record.origin)
