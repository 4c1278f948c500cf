"""What a data set covers, and its logs as small multiples."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, TypeVar

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from pysim.io import shown_unit
from pysim.plot.style import COLOURS, MEASURED, SMALL, TEXT, frequency_axis, legend_above, new_figure, quiet
from pysim.types import BadInput, Dataset, MeasuredRecord, Record

_T = TypeVar("_T")

_COLUMNS = 6  # frequencies shown per operating point
_ROWS = 8  # operating points, or records over time, per picture
_PERIODS = 2.0  # of a sine that are shown


def coverage_figure(dataset: Dataset) -> Figure:
    """A row per offset and amplitude, a dot per stepped sine over its frequency; hollow: held out for validation.

    Raises:
        BadInput: no stepped sine among the logs.
    """
    sines = [record for record in dataset.logs() if record.frequency is not None]
    if not sines:
        raise BadInput(f"data set {dataset.name!r} has no stepped sines to show")
    points = list(dict.fromkeys((record.offset, record.amplitude) for record in sines))
    figure = new_figure(7.5, 1.3 + 0.28 * len(points))
    axes = figure.subplots()
    quiet(axes)
    handles: dict[str, Any] = {}
    for use, label, face in (("fit", "to fit", COLOURS[0]), ("validate", "held out", "white")):
        chosen = [record for record in sines if record.use == use]
        rows = [points.index((record.offset, record.amplitude)) for record in chosen]
        frequencies = np.array([record.frequency for record in chosen])
        if chosen:
            (handles[label],) = axes.plot(frequencies, rows, "o", color=COLOURS[0], markerfacecolor=face, markersize=6)
    told = [record.frequency for record in sines if record.frequency is not None]
    frequency_axis(axes, 0.8 * min(told), 1.25 * max(told))
    unit, factor = _shown(dataset, sines[0].command)
    labels = [f"{factor * (offset or 0):g} / {factor * (amplitude or 0):g}" for offset, amplitude in points]
    axes.set_yticks(range(len(points)), labels)
    axes.invert_yaxis()
    axes.margins(y=0.5 / len(points))
    axes.set_ylabel(f"Offset / amplitude ({unit})", fontsize=TEXT)
    axes.set_xlabel("Frequency (Hz)", fontsize=TEXT)
    legend_above(figure, list(handles.values()), list(handles))
    return figure


def sine_logs_figure(dataset: Dataset) -> Figure:
    """A row per offset and amplitude, a panel per frequency: the last two periods of command and first output.

    At most eight rows and six columns, spread over what there is.

    Raises:
        BadInput: no stepped sine among the logs.
    """
    sines = [record for record in dataset.logs() if record.frequency is not None]
    if not sines:
        raise BadInput(f"data set {dataset.name!r} has no stepped sines to show")
    points = _spread(list(dict.fromkeys((record.offset, record.amplitude) for record in sines)), _ROWS)
    frequencies = _spread(sorted({record.frequency for record in sines if record.frequency is not None}), _COLUMNS)
    figure = new_figure(1.0 + 1.7 * len(frequencies), 0.9 + 1.2 * len(points))
    axes = figure.subplots(len(points), len(frequencies), sharey="row", squeeze=False)
    by_test = {(record.offset, record.amplitude, record.frequency): record for record in sines}
    for i, (offset, amplitude) in enumerate(points):
        for k, frequency in enumerate(frequencies):
            record = by_test.get((offset, amplitude, frequency))
            panel = axes[i, k]
            quiet(panel)
            panel.set_xticks([0, 1, 2], [] if i < len(points) - 1 else ["0", "1", "2"])
            if record is not None:
                _draw_periods(panel, dataset, record)
            if i == 0:
                panel.set_title(f"{frequency:g} Hz", fontsize=TEXT)
        unit, factor = _shown(dataset, sines[0].command)
        axes[i, 0].set_ylabel(f"{factor * (offset or 0):g} / {factor * (amplitude or 0):g} {unit}", fontsize=SMALL)
    figure.supxlabel("Last periods of the log", fontsize=TEXT)
    figure.align_ylabels()
    lines = [Line2D([], [], color=colour) for colour in (MEASURED, COLOURS[0])]
    legend_above(figure, lines, [sines[0].command, dataset.columns(sines[0], "output")[0]])
    return figure


def time_logs_figure(dataset: Dataset) -> Figure:
    """A row per log that is no stepped sine: inputs in black, outputs in colour, each unit with its own panel.

    At most eight logs.

    Raises:
        BadInput: no such log.
    """
    logs = [record for record in dataset.logs() if record.frequency is None][:_ROWS]
    if not logs:
        raise BadInput(f"data set {dataset.name!r} has no logs but stepped sines")
    units = list(dict.fromkeys(_shown(dataset, name)[0] for record in logs for name in _names(record)))
    names = list(dict.fromkeys(name for record in logs for name in _names(record)))
    figure = new_figure(1.0 + 5.5 * len(units), 0.9 + 1.5 * len(logs))
    axes = figure.subplots(len(logs), len(units), squeeze=False)
    for i, record in enumerate(logs):
        for k, unit in enumerate(units):
            panel = axes[i, k]
            quiet(panel)
            shown = [name for name in _names(record) if _shown(dataset, name)[0] == unit]
            if not shown:
                panel.set_axis_off()
                continue
            for name in shown:
                _draw(panel, dataset, record, name, names)
            panel.set_ylabel(f"({unit})", fontsize=TEXT)
            panel.set_title(f"{record.source}: {record.kind}, {record.use}", fontsize=SMALL, loc="left")
    for panel in axes[-1]:
        panel.set_xlabel("Time (s)", fontsize=TEXT)
    figure.align_ylabels()
    lines = [Line2D([], [], color=_colour(dataset, name, names)) for name in names]
    legend_above(figure, lines, names)
    return figure


def _names(record: MeasuredRecord) -> tuple[str, ...]:
    return record.data.names if isinstance(record.data, Record) else ()


def _shown(dataset: Dataset, name: str) -> tuple[str, float]:
    """The unit on an axis, and how many of it an SI unit is."""
    return shown_unit(dataset.signal(name).unit if name else "")


def _colour(dataset: Dataset, name: str, names: Sequence[str]) -> str:
    """Black for inputs; outputs each their own."""
    outputs = [other for other in names if dataset.signal(other).role == "output"]
    return COLOURS[outputs.index(name) % len(COLOURS)] if name in outputs else MEASURED


def _draw(panel: Axes, dataset: Dataset, record: MeasuredRecord, name: str, names: Sequence[str]) -> None:
    assert isinstance(record.data, Record)
    values = _shown(dataset, name)[1] * record.data[name]
    panel.plot(record.data.time, values, color=_colour(dataset, name, names), linewidth=0.7)


def _draw_periods(panel: Axes, dataset: Dataset, record: MeasuredRecord) -> None:
    """The last periods of a sine, time in periods."""
    assert isinstance(record.data, Record)
    log, frequency = record.data, float(record.frequency or 1.0)
    phase = (log.time - log.time[-1]) * frequency + _PERIODS
    late = phase >= -1e-9
    output = next(iter(dataset.columns(record, "output")))
    names = (record.command, output)
    for name in names:
        factor = _shown(dataset, name)[1]
        if _shown(dataset, name)[0] == _shown(dataset, record.command)[0]:
            panel.plot(phase[late], factor * log[name][late], color=_colour(dataset, name, names), linewidth=1.0)
    panel.set_xlim(0, _PERIODS)


def _spread(values: list[_T], most: int) -> list[_T]:
    """At most so many of the values, evenly spread, first and last among them."""
    if len(values) <= most:
        return values
    return [values[k] for k in np.unique(np.linspace(0, len(values) - 1, most).round().astype(int))]
