"""Figures of a fit: what each record leaves over, responses with harmonics, parameters with their doubt."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from pysim.identify import HALF_95
from pysim.io import shown_unit, shown_value
from pysim.present import style
from pysim.present.fit.answer import Fitted
from pysim.present.render import Picture
from pysim.types import BadInput, Dataset, Estimate, Fit, RecordFit

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_MANY = 5000  # samples beyond which lines are drawn thin, and as pixels
_CELL_IN, _NAME_IN = 0.46, 0.075  # in, a cell of the correlations and a letter of a name


def figures(result: Fitted) -> Iterator[Picture]:
    """Its parameters, each log, and per operating point and signal the stepped sines."""
    fit, several = result.fit, len(result.datasets) > 1
    yield Picture("parameters", "Parameters between their bounds.", fit_parameters_figure(fit))
    yield Picture("correlation", "Correlations of the estimates.", fit_correlation_figure(fit))
    for i, record in enumerate(fit.records):
        if not record.harmonics:
            of = f"{record.dataset}, " if several else ""
            caption = f"{of}{record.source} ({record.use}): measured, fitted, and what is left."
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
    names = record.measured.names
    figure, axes = style.panels(1.0 + 5.4 * len(names), 4.6, 2, len(names), sharex=True, height_ratios=(3, 2))
    time, residual = record.measured.time, record.residual.values
    for j, (name, unit) in enumerate(zip(names, record.measured.units, strict=True)):
        top, low = axes[:, j]
        many = time.size > _MANY
        look: dict[str, Any] = {"linewidth": 0.7 if many else 1.2, "rasterized": many}
        shown, factor = shown_unit(unit)
        (measured,) = top.plot(time, factor * record.measured.values[:, j], color=style.MEASURED, **look)
        simulated = factor * record.simulated.values[:, j]
        (model,) = top.plot(time, simulated, color=style.COLOURS[1], linestyle="--", **look)
        low.axhspan(-HALF_95, HALF_95, color=style.BAND, linewidth=0)
        low.plot(time, residual[:, j], color=style.COLOURS[0], linewidth=0, marker=".", markersize=1.5, rasterized=many)
        top.set_ylabel(f"{name} ({shown})")
        low.set(xlabel="Time (s)", ylabel="Residual (noise s.d.)")
        low.set_title(f"rms {record.rms[name]:.3f}", fontsize=style.SMALL, loc="right")
    style.legend_above(figure, [measured, model], ["measured", "fitted model"])
    return figure


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
    """Each estimate with its 95 percent interval between its bounds; where a bound is infinite, around the estimate."""
    figure, ((axes,),) = style.panels(6.4, 0.9 + 0.32 * len(fit.estimates))
    for row, estimate in enumerate(fit.estimates):
        low, high = _range(estimate)
        share = [(v - low) / (high - low) for v in (estimate.value, *estimate.interval, estimate.start)]
        axes.plot([0, 1], [row, row], color=style.BAND, linewidth=5, solid_capstyle="butt")
        axes.plot(np.clip(share[1:3], 0, 1), [row, row], color=style.COLOURS[0], linewidth=2.2, solid_capstyle="butt")
        axes.plot(share[0], row, color=style.COLOURS[0], marker="o", markersize=5)
        axes.plot(np.clip(share[3], 0, 1), row, color=style.LIMIT, marker="|", markersize=9)
    axes.set_yticks(range(len(fit.estimates)), [e.name for e in fit.estimates], fontsize=style.SMALL)
    axes.set_xticks([0, 1], ["lower bound", "upper bound"])
    axes.set_xlim(-0.03, 1.03)
    axes.invert_yaxis()
    handles = [axes.plot([], [], color=style.COLOURS[0], marker="o", linewidth=2.2)[0]]
    handles.append(axes.plot([], [], color=style.LIMIT, marker="|", linewidth=0, markersize=9)[0])
    style.legend_above(figure, handles, ["estimate, 95 % interval", "start"])
    return figure


def _range(estimate: Estimate) -> tuple[float, float]:
    """What the axis of one parameter spans."""
    finite = [v for v in (estimate.value, estimate.start, *estimate.interval) if np.isfinite(v)]
    low = estimate.lower if np.isfinite(estimate.lower) else min(finite) - 0.1 * abs(min(finite)) - 1e-12
    high = estimate.upper if np.isfinite(estimate.upper) else max(finite) + 0.1 * abs(max(finite)) + 1e-12
    return low, high


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
