"""Where a model fails: a map of its residual over all tests, before and after."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from pysim.io import shown_point
from pysim.present import style
from pysim.present.charts import Chart, axis, heat_map
from pysim.present.diagnosis.figures.records import steps_compared
from pysim.present.notes import USES
from pysim.types import BadInput, Dataset, Diagnosis, ErrorStep, RecordFit

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.colors import LogNorm
    from matplotlib.figure import Figure
    from matplotlib.image import AxesImage

_WINDOWS = 12  # of a log over time
_COLOURS = "OrRd"


_Rows = dict[str, dict[str, float]]  # of a map: name of a row -> value by name of a column


def map_figure(diagnosis: Diagnosis, dataset: Dataset | None) -> Figure:
    """Residual of every test, before (the refitted base model) and after (with what was added).

    Stepped sines stand by offset and amplitude over frequency, other logs by record over equal shares of their time.
    Numbers are root-mean-square residuals over noise; white is noise alone.

    Args:
        dataset: says which test each record is of; None where it is not at hand.
    Raises:
        BadInput: no log was compared.
    """
    from matplotlib.colors import LogNorm

    shown = [(name, step, dataset) for name, step, _ in steps_compared(diagnosis)]
    if not any(step.records for _, step, _ in shown):
        raise BadInput("residual map: no log over time was compared")
    maps = [(title, rows) for title, rows in (*map(_sines, shown), *map(_logs, shown)) if rows]
    high = max(3.0, *(v for _, rows in maps for row in rows.values() for v in row.values()))
    figure = style.new_figure(8.2, 0.7 + sum(0.62 + 0.25 * len(rows) for _, rows in maps))
    axes = figure.subplots(len(maps), 1, squeeze=False, height_ratios=[1.6 + len(rows) for _, rows in maps])[:, 0]
    for own, (title, rows) in zip(axes, maps, strict=True):
        image = _draw(own, title, rows, LogNorm(1.0, high))
    bar = figure.colorbar(image, ax=list(axes), aspect=40, pad=0.015)
    bar.set_label("Residual over noise (-)", fontsize=style.TEXT)
    ticks = [t for t in (1, 2, 3, 5, 7, 10, 20, 30, 50, 100, 200, 300, 500, 1000) if t <= high]
    bar.set_ticks(ticks, labels=[f"{t:g}" for t in ticks])
    bar.ax.minorticks_off()
    bar.ax.tick_params(labelsize=style.SMALL)
    return figure


def _sines(shown: tuple[str, ErrorStep, Dataset | None]) -> tuple[str, _Rows]:
    """Rows by operating point; of a test that was repeated the worst is shown."""
    name, step, dataset = shown
    own = [record for record in step.records if record.harmonics]
    several = len({name for record in own for name in record.measured.names}) > 1
    rows: dict[tuple[_Point, str], dict[str, float]] = {}
    for record in own:
        point = _point(record, dataset)
        frequency = f"{record.harmonics[0].frequency:g}"
        for signal, value in record.rms.items():
            row = rows.setdefault((point, signal if several else ""), {})
            row[frequency] = max(value, row.get(frequency, 0.0))
    named = {f"{point.label}{f': {signal}' if signal else ''}": rows[point, signal] for point, signal in sorted(rows)}
    return f"Stepped sines by frequency (Hz), {name}", named


class _Point(NamedTuple):
    """What a stepped sine swings around and how far, the command's unit in SI; the log where that is not known."""

    command: str
    offset: float
    amplitude: float
    label: str


def _point(record: RecordFit, dataset: Dataset | None) -> _Point:
    test = dataset.logs()[record.index] if dataset is not None else None
    if dataset is None or test is None or test.offset is None or test.amplitude is None:
        return _Point("", 0.0, 0.0, record.source)
    unit = dataset.signal(test.command).unit if test.command else ""
    several = len({log.command for log in dataset.logs() if log.command}) > 1
    label = shown_point(test.offset, test.amplitude, unit, test.command if several else "")
    return _Point(test.command, test.offset, test.amplitude, label)


def _logs(shown: tuple[str, ErrorStep, Dataset | None]) -> tuple[str, _Rows]:
    name, step, _ = shown
    rows = {
        f"{record.source} ({USES[record.use]}): {signal}": _windows(record, j)
        for record in step.records
        if not record.harmonics
        for j, signal in enumerate(record.measured.names)
    }
    return f"Logs over time, in twelfths of their length, {name}", rows


def _windows(record: RecordFit, column: int) -> dict[str, float]:
    parts = np.array_split(record.residual.values[:, column], _WINDOWS)
    there = {str(k + 1): part[np.isfinite(part)] for k, part in enumerate(parts)}
    return {name: math.sqrt(float(np.mean(part**2))) for name, part in there.items() if part.size}


def _draw(axes: Axes, title: str, rows: _Rows, norm: LogNorm) -> AxesImage:
    columns = sorted({column for row in rows.values() for column in row}, key=float)
    values = np.array([[row.get(column, math.nan) for column in columns] for row in rows.values()])
    axes.set_facecolor(style.BAND)
    image = axes.imshow(np.maximum(values, 1.0), cmap=_COLOURS, norm=norm, aspect="auto")
    for i, row in enumerate(values):
        for j, value in enumerate(row):
            if math.isfinite(value):
                dark = norm(value) > 0.62
                look: dict[str, Any] = {"fontsize": 6.5, "color": "white" if dark else "#222222"}
                axes.text(j, i, _cell(value), ha="center", va="center", **look)
    axes.set_xticks(range(len(columns)), columns, fontsize=style.SMALL)
    axes.set_yticks(range(len(rows)), list(rows), fontsize=style.SMALL)
    axes.tick_params(length=0)
    axes.spines[:].set_visible(False)
    axes.set_title(title, fontsize=style.TEXT, loc="left")
    return image


def map_chart(
    rows: Sequence[str],
    columns: Sequence[str],
    values: Sequence[Sequence[float | None]],
    title: str,
    *,
    scale: bool = True,
) -> Chart:
    """Root-mean-square residual over noise of every test; numbers stand in the cells, so that no colour is needed.

    Args:
        values: per row, per column; None where no such test was run.
        title: of the columns.
        scale: whether a scale of the colours stands beside it.
    """
    shown = [[None if v is None else math.log10(max(v, 1.0)) for v in row] for row in values]
    high = max([10.0, *(v for row in values for v in row if v is not None)])
    ticks = [t for t in (1, 2, 5, 10, 20, 50, 100, 200, 500, 1000) if t <= high]
    bar: dict[str, Any] = {"tickvals": [math.log10(t) for t in ticks], "ticktext": [f"{t:g}" for t in ticks]}
    bar |= {"title": {"text": "over noise", "side": "right"}, "thickness": 10, "outlinewidth": 0, "len": 1}
    colours = {"zmin": 0, "zmax": math.log10(high), "colorscale": "@heat", "colorbar": bar, "showscale": scale}
    more = {**colours, "hoverongaps": False, "textfont": {"size": 11.5}}
    more["hovertemplate"] = "%{y}<br>%{x}: %{text} x noise<extra></extra>"
    text = [["" if v is None else _cell(v) for v in row] for row in values]
    across = axis(title, type="category", showgrid=False, side="bottom")
    return heat_map(rows, columns, shown, text, across, more, margin={"l": 40, "r": 10, "t": 10, "b": 46})


def map_words(dataset: Dataset) -> str:
    """What the numbers of a map are."""
    assumed = any(one.role == "output" and one.noise is None for one in dataset.signals)
    more = " The best model so far tells how large the noise is: a better one raises these numbers a little."
    return f"Residual in standard deviations of the noise. Click a cell to open its record.{more if assumed else ''}"


def _cell(value: float) -> str:
    return f"{value:.1f}" if value < 99.5 else f"{value:.0f}"
