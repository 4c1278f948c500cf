"""Where a model fails: a map of what it leaves over all tests, before and after, and the worst places by rank."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from pysim.io import shown_point
from pysim.present.diagnosis.figures.records import base_of, stages_compared
from pysim.present.style import BAND, COLOURS, LIMIT, SMALL, TEXT, legend_above, new_figure, quiet
from pysim.types import BadInput, Dataset, Diagnosis, MeasuredRecord, RecordFit, Stage

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.colors import LogNorm
    from matplotlib.figure import Figure
    from matplotlib.image import AxesImage
    from numpy.typing import NDArray

    Array = NDArray[np.float64]

_WINDOWS = 12  # of a log over time
_WORST = 12  # places shown by rank
_COLOURS = "OrRd"


@dataclass
class _Field:
    """A map under construction: rows (label -> value by column's label)."""

    title: str
    rows: dict[str, dict[str, float]] = field(default_factory=dict)

    def matrix(self, columns: Sequence[str]) -> Array:
        return np.array([[row.get(c, math.nan) for c in columns] for row in self.rows.values()])


def diagnosis_map_figure(diagnosis: Diagnosis, dataset: Dataset) -> Figure:
    """What is left over of every test, before (the refitted base model) and after (with what was added).

    Stepped sines stand by offset and amplitude over frequency, other logs by record over equal shares of their time.
    Numbers are root-mean-square residuals over noise; white is noise alone.

    Args:
        dataset: tells the tests of the records.
    Raises:
        BadInput: no log was compared.
    """
    from matplotlib.colors import LogNorm

    shown = [(name, stage) for name, stage, _ in stages_compared(diagnosis)]
    if not any(stage.records for _, stage in shown):
        raise BadInput("residual map: no log over time was compared")
    panels = [one for name, stage in shown for one in (_sines(name, stage, dataset), _logs(name, stage)) if one.rows]
    panels.sort(key=lambda panel: panel.title.startswith("Logs"))
    high = max(3.0, *(v for panel in panels for row in panel.rows.values() for v in row.values()))
    figure = new_figure(8.2, 0.7 + sum(0.62 + 0.25 * len(panel.rows) for panel in panels))
    axes = figure.subplots(len(panels), 1, squeeze=False, height_ratios=[1.6 + len(p.rows) for p in panels])[:, 0]
    for own, panel in zip(axes, panels, strict=True):
        image = _draw(own, panel, LogNorm(1.0, high))
    bar = figure.colorbar(image, ax=list(axes), aspect=40, pad=0.015)
    bar.set_label("Residual over noise (-)", fontsize=TEXT)
    ticks = [t for t in (1, 2, 3, 5, 7, 10, 20, 30, 50, 100, 200, 300, 500, 1000) if t <= high]
    bar.set_ticks(ticks, labels=[f"{t:g}" for t in ticks])
    bar.ax.minorticks_off()
    bar.ax.tick_params(labelsize=SMALL)
    return figure


def _sines(name: str, stage: Stage, dataset: Dataset) -> _Field:
    """Rows by operating point; of a test that was repeated the worst is shown."""
    logs = dataset.logs()
    own = [record for record in stage.records if record.harmonics]
    several = len({name for record in own for name in record.measured.names}) > 1
    rows: dict[tuple[_Point, str], dict[str, float]] = {}
    for record in own:
        point = _point(logs[record.index], dataset)
        frequency = f"{record.harmonics[0].frequency:g}"
        for signal, value in record.rms.items():
            row = rows.setdefault((point, signal if several else ""), {})
            row[frequency] = max(value, row.get(frequency, 0.0))
    named = {f"{point.label}{f': {signal}' if signal else ''}": rows[point, signal] for point, signal in sorted(rows)}
    return _Field(f"Stepped sines by frequency (Hz), {name}", named)


@dataclass(frozen=True, order=True)
class _Point:
    """What a stepped sine swings around and how far, the command's unit in SI; the log where that is not told."""

    command: str
    offset: float
    amplitude: float
    label: str


def _point(test: MeasuredRecord, dataset: Dataset) -> _Point:
    if test.offset is None or test.amplitude is None:
        return _Point("", 0.0, 0.0, test.source)
    unit = dataset.signal(test.command).unit if test.command else ""
    several = len({record.command for record in dataset.logs() if record.command}) > 1
    label = shown_point(test.offset, test.amplitude, unit, test.command if several else "")
    return _Point(test.command, test.offset, test.amplitude, label)


def _logs(name: str, stage: Stage) -> _Field:
    found = _Field(f"Logs over time, in twelfths of their length, {name}")
    for record in stage.records:
        if not record.harmonics:
            for signal in record.measured.names:
                found.rows[f"{_short(record)}: {signal}"] = _windows(record, record.measured.names.index(signal))
    return found


def _windows(record: RecordFit, column: int) -> dict[str, float]:
    parts = np.array_split(record.residual.values[:, column], _WINDOWS)
    return {str(k + 1): math.sqrt(float(np.mean(part**2))) for k, part in enumerate(parts) if part.size}


def _short(record: RecordFit) -> str:
    return f"{record.source} ({'held out' if record.use == 'validate' else 'fitted'})"


def _draw(axes: Axes, panel: _Field, norm: LogNorm) -> AxesImage:
    columns = list(dict.fromkeys(c for row in panel.rows.values() for c in row))
    columns.sort(key=float)
    values = panel.matrix(columns)
    axes.set_facecolor(BAND)
    image = axes.imshow(np.maximum(values, 1.0), cmap=_COLOURS, norm=norm, aspect="auto")
    for i, row in enumerate(values):
        for j, value in enumerate(row):
            if math.isfinite(value):
                dark = norm(value) > 0.62
                axes.text(
                    j, i, f"{value:.1f}" if value < 99.5 else f"{value:.0f}", ha="center", va="center", fontsize=6.5,
                    color="white" if dark else "#222222",
                )  # fmt: skip
    axes.set_xticks(range(len(columns)), columns, fontsize=SMALL)
    axes.set_yticks(range(len(panel.rows)), list(panel.rows), fontsize=SMALL)
    axes.tick_params(length=0)
    axes.spines[:].set_visible(False)
    axes.set_title(panel.title, fontsize=TEXT, loc="left")
    return image


def diagnosis_failures_figure(diagnosis: Diagnosis) -> Figure:
    """The places where the base model fails most, and what is left there at the end.

    Raises:
        BadInput: no such place.
    """
    rows = diagnosis.where[:_WORST]
    if not rows:
        raise BadInput("failures figure: the diagnosis names no place where the model fails")
    last = diagnosis.stages[-1] if diagnosis.added and diagnosis.stages else None
    after = {(f.record, f.signal, f.region): f.error for f in last.where} if last else {}
    figure = new_figure(7.6, 1.0 + 0.27 * len(rows))
    axes = figure.subplots()
    quiet(axes)
    axes.grid(False, axis="y")
    high = max(row.error for row in rows)
    handles = [axes.barh(range(len(rows)), [row.error for row in rows], height=0.6, color=COLOURS[1])[0]]
    base = base_of(diagnosis)
    names = ["model as it is" if base is not None and base.step == "prior" else "refitted base model"]
    if after:
        ends = [after.get((row.record, row.signal, row.region), math.nan) for row in rows]
        handles.append(axes.plot(ends, range(len(rows)), color=COLOURS[0], marker="o", linestyle="none")[0])
        names.append(stages_compared(diagnosis)[-1][0])
    for i, row in enumerate(rows):
        axes.annotate(
            f"{row.error:.2f}", (row.error, i), xytext=(4, 0), textcoords="offset points", va="center", fontsize=SMALL
        )
    axes.axvline(1.0, color=LIMIT, linewidth=1.0)
    axes.set_xlim(0, 1.12 * max(high, 1.0))
    axes.set_ylim(len(rows) - 0.4, -0.6)
    axes.set_yticks(range(len(rows)), [f"{f.record}, {f.signal}: {f.region}" for f in rows], fontsize=SMALL)
    axes.set_xlabel("Residual over noise (-); 1: noise alone", fontsize=TEXT)
    legend_above(figure, handles, names)
    return figure
