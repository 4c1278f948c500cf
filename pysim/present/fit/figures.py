"""Figures of a fit: what each record leaves over, responses with harmonics, parameters with their doubt."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from pysim.identify import HALF_95
from pysim.io import shown_unit, shown_value
from pysim.present import style
from pysim.present.charts import Chart, axis, heat_map
from pysim.present.fit.answer import Fitted
from pysim.present.notes import USES
from pysim.present.overlay import Side, beside_figure
from pysim.present.parameters import AFTER, START, between_bounds, parameters_legend
from pysim.present.render import Picture
from pysim.types import BadInput, Dataset, Fit, RecordFit

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_CELL_IN, _NAME_IN = 0.46, 0.075  # in, a cell of the correlations and a letter of a name


def figures(result: Fitted) -> Iterator[Picture]:
    """Its parameters, each log, and per operating point and signal the stepped sines."""
    fit, several = result.fit, len(result.datasets) > 1
    yield Picture("parameters", "Parameters between their bounds.", fit_parameters_figure(fit))
    yield Picture("correlation", "Correlations of the estimates.", fit_correlation_figure(fit))
    for i, record in enumerate(fit.records):
        if not record.harmonics:
            of = f"{record.dataset}, " if several else ""
            caption = f"{of}{record.source} ({USES[record.use]}): measured, fitted, and what is left."
            yield Picture(f"record_{i}", caption, fit_record_figure(record))
    for i, (test, signal, records) in enumerate(_sines(fit.records, result.datasets)):
        caption = f"Stepped sines, {signal} {test}: points measured, lines fitted; grey: 95 percent of noise."
        yield Picture(f"sines_{i}", caption, fit_harmonics_figure(records, test, signal))


def _sines(records: Sequence[RecordFit], datasets: Sequence[Dataset]) -> list[tuple[str, str, list[RecordFit]]]:
    """Stepped sines that belong on one picture: operating point in words, signal, records."""
    found: dict[tuple[str, str], list[RecordFit]] = {}
    for record, test in zip(records, _tests(records, datasets), strict=True):
        for harmonics in record.harmonics:
            found.setdefault((test, harmonics.signal), []).append(record)
    return [(test, signal, own) for (test, signal), own in found.items()]


def _tests(records: Sequence[RecordFit], datasets: Sequence[Dataset]) -> list[str]:
    """What the data sets say of each record: where it was measured, and whose command swings how."""
    words = [f"of {Path(record.source).parent.as_posix()}" for record in records]
    for k, record in enumerate(records):
        own = [one for one in datasets if one.name == record.dataset]
        test = own[0].logs()[record.index] if len(own) == 1 else None
        if test is not None and test.command and test.offset is not None and test.amplitude is not None:
            unit = own[0].signal(test.command).unit
            around, swing = shown_value(test.offset, unit), shown_value(test.amplitude, unit)
            words[k] = f"at {test.command} {around}, amplitude {swing}"
    several = len(datasets) > 1
    return [f"{word} ({record.dataset})" if several else word for word, record in zip(words, records, strict=True)]


def fit_record_figure(record: RecordFit) -> Figure:
    """Measured and simulated, and below them the residual in standard deviations of the noise; a column per signal."""
    return beside_figure([Side("fitted model", "fitted model", record, style.look(0, "linestyle"))])


def fit_harmonics_figure(records: Sequence[RecordFit], title: str, signal: str) -> Figure:
    """Gain of the harmonics over the frequency of the test, and what is left in standard deviations.

    Args:
        records: stepped sines of one test.
        title: of the figure.
        signal: that answers.
    Raises:
        BadInput: a record without harmonics of that signal.
    """
    rows = sorted((h for one in records for h in one.harmonics if h.signal == signal), key=lambda h: h.frequency)
    if not rows or len(rows) < len(records):
        raise BadInput(f"harmonics figure: needs records of stepped sines that hold {signal}")
    figure, ((top,), (low,)) = style.panels(7.4, 5.2, 2, sharex=True, height_ratios=(3, 2))
    most = max(h.measured.size for h in rows)
    handles, labels, least = [], [], np.inf
    log = records[0].measured
    unit, factor = shown_unit(log.units[log.names.index(signal)])
    for k in range(1, most):
        own = [h for h in rows if h.measured.size > k]
        f = np.array([h.frequency for h in own])
        look = {**style.look(k - 1, "marker"), "markersize": 4, "linewidth": 0}
        measured = factor * np.abs([h.measured[k] for h in own])
        spread = factor * np.array([h.std[k] for h in own])
        least = min(least, float(np.min(spread)))
        (points,) = top.plot(f, measured, **look)
        low_end = np.maximum(measured - HALF_95 * spread, 0.1 * spread)
        top.vlines(f, low_end, measured + HALF_95 * spread, color=look["color"], linewidth=0.8)
        top.plot(f, factor * np.abs([h.simulated[k] for h in own]), color=look["color"], linewidth=1.1)
        left = factor * np.abs([h.measured[k] - h.simulated[k] for h in own]) / (spread * np.sqrt(2))
        low.plot(f, left, **look)
        handles.append(points)
        labels.append(str(k))
    low.axhspan(0, 1.73, color=style.BAND, linewidth=0)  # 95 percent of the sizes of complex normal errors
    style.size_axis(top)
    top.set_ylim(bottom=0.1 * least)  # a decade below the smallest noise there is nothing to see
    top.set_ylabel(f"Amplitude of {signal} ({unit})")
    low.set(xlabel="Frequency (Hz)", ylabel="Left over (s.d.)")
    for axes in (top, low):
        style.frequency_axis(axes, rows[0].frequency * 0.9, rows[-1].frequency * 1.1)
    top.set_title(title, fontsize=style.TEXT)
    beside = {"loc": "center left", "bbox_to_anchor": (1, 0.5)}
    top.legend(handles, labels, title="Harmonic", fontsize=style.SMALL, title_fontsize=style.SMALL, **beside)
    return figure


def fit_parameters_figure(fit: Fit) -> Figure:
    """Each estimate with its 95 percent interval between its bounds."""
    figure, ((axes,),) = style.panels(5.6, 1.1 + 0.27 * len(fit.estimates))
    between_bounds(axes, fit.estimates, AFTER)
    parameters_legend(figure, axes, {"estimate, 95 % interval": AFTER, "start": {**START, "linestyle": "none"}})
    return figure


def fit_correlation_figure(fit: Fit) -> Figure:
    """Correlations of the estimates as a field of numbers; grey where the data determine none."""
    names, matrix = [e.name for e in fit.estimates], fit.correlation
    n, name_in = len(names), _NAME_IN * max(len(e.name) for e in fit.estimates)
    figure = style.new_figure(max(1.8 + name_in + _CELL_IN * n, 3.6), 1.1 + 0.8 * name_in + _CELL_IN * n)
    axes = figure.subplots()
    image = axes.imshow(matrix, cmap="RdBu_r", vmin=-1, vmax=1, aspect="auto")
    axes.set_facecolor(style.BAND)
    for i in range(n):
        for j in range(n):
            if np.isfinite(matrix[i, j]):
                colour = "white" if abs(matrix[i, j]) > 0.6 else "black"
                axes.text(j, i, f"{matrix[i, j]:z.2f}", ha="center", va="center", fontsize=7, color=colour)
    axes.set_xticks(range(n), names, rotation=60, ha="right", rotation_mode="anchor", fontsize=style.SMALL)
    axes.set_yticks(range(n), names, fontsize=style.SMALL)
    bar = figure.colorbar(image, ax=axes, shrink=0.9, ticks=[-1, -0.5, 0, 0.5, 1])
    bar.ax.tick_params(labelsize=style.SMALL)
    bar.set_label("Correlation", fontsize=style.SMALL)
    if not np.isfinite(matrix).all():
        from matplotlib.patches import Patch

        style.legend_above(figure, [Patch(color=style.BAND)], ["not determined, or at a bound"])
    return figure


def fit_correlation_chart(names: Sequence[str], matrix: Sequence[Sequence[float | None]]) -> Chart:
    """The same as a chart; an empty cell where the data determine none."""
    shown = [[None if v is None or np.isnan(v) else v for v in row] for row in matrix]
    text = [["" if v is None else f"{v:.2f}" for v in row] for row in shown]
    colours = {"zmin": -1, "zmax": 1, "colorscale": "RdBu", "reversescale": True}
    hover = {"hovertemplate": "%{y}, %{x}: %{z:.3f}<extra></extra>"}
    return heat_map(names, names, shown, text, axis(type="category", showgrid=False), {**colours, **hover})
