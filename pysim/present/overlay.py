"""Records over time: laid over each other; a log beside models, and below it what each leaves; where a model fails."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from itertools import cycle
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from pysim.identify import HALF_95
from pysim.io import shown_unit
from pysim.present import style
from pysim.present.charts import LOOKS, Chart, axis, chart, level_band, plain, unit_text
from pysim.present.notes import USES
from pysim.types import BadInput, Record, RecordFit
from pysim.types.answer import Failure

if TYPE_CHECKING:
    from matplotlib.artist import Artist
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from numpy.typing import NDArray

    Array = NDArray[np.float64]

_MANY = 5000  # samples beyond which lines are drawn as pixels
_SMOOTH = 5  # samples of the running mean that shows what of a residual is more than noise
_COARSE = 100  # samples up to which a residual needs no running mean
_WORST = 12  # regions that are drawn
_MODELS = ("last", "refit", "prior")  # keys of LOOKS, in the order in which models are given


class Side(NamedTuple):
    """A model beside a log: its name, words for the legend, and the colour and dash of its lines."""

    name: str
    words: str
    record: RecordFit
    look: Mapping[str, Any]


def logs_figure(beside: Mapping[str, RecordFit]) -> Figure:
    """One log beside some models.

    The legend tells each model's fit in percent, 100 (1 - |measured - simulated| / |measured - its mean|), signal by
    signal.

    Args:
        beside: name of a model -> the same log beside it.
    Raises:
        BadInput: no model.
    """
    if not beside:
        raise BadInput("overlay: name at least one model")
    named = enumerate(beside.items())
    return beside_figure([Side(n, f"{n}: {_percent(r)}", r, style.look(k, "linestyle")) for k, (n, r) in named])


def beside_figure(sides: Sequence[Side], part: slice = slice(None), *, hidden: Sequence[str] = ()) -> Figure:
    """A column a signal: measured and simulated above, the residuals in standard deviations of the noise below.

    Of many samples running means are drawn as well; grey holds 95 percent of noise alone.

    Args:
        sides: at least one, of the same log.
        part: samples that are shown.
        hidden: names of models whose residual is not drawn.
    """
    names = sides[0].record.measured.names
    width = 1.2 + 4.6 * max(len(names), 1.4)
    figure, axes = style.panels(width, 4.8, 2, len(names), sharex=True, height_ratios=(3, 2))
    for j in range(len(names)):
        handles = _signal(axes[0, j], sides, j, part)
        _residual(axes[1, j], [one for one in sides if one.name not in hidden], j, part)
    axes[0, 0].set_title(_title(sides[0].record), fontsize=style.SMALL, loc="left")
    style.legend_above(figure, handles, ["measured", *(one.words for one in sides)])
    return figure


def _title(log: RecordFit) -> str:
    return f"{log.source} ({USES[log.use]})"


def _signal(axes: Axes, sides: Sequence[Side], j: int, part: slice) -> list[Artist]:
    measured = sides[0].record.measured
    time, (unit, factor) = measured.time[part], shown_unit(measured.units[j])
    dots: dict[str, Any] = {"color": style.MEASURED, "markersize": 2.4, "rasterized": True}
    handles: list[Artist] = [*axes.plot(time, factor * measured.values[part, j], ".", **dots)]
    for one in sides:
        simulated = one.record.simulated
        more = {**one.look, "linewidth": 1.5, "rasterized": time.size > _MANY}
        handles += axes.plot(simulated.time[part], factor * simulated.values[part, j], **more)
    axes.set_ylabel(f"{measured.names[j]} ({unit})")
    return handles


def _residual(axes: Axes, sides: Sequence[Side], j: int, part: slice) -> None:
    axes.axhspan(-HALF_95, HALF_95, color=style.BAND, linewidth=0)
    words = []
    for one in sides:
        residual, colour = one.record.residual, one.look["color"]
        time, values = residual.time[part], residual.values[part, j]
        look = {"color": colour, "linewidth": 1.4, "rasterized": time.size > _MANY}
        if values.size > _COARSE:
            axes.plot(time, values, ".", color=colour, markersize=1.6, alpha=0.5, rasterized=True)
            there, ones = np.isfinite(values), np.ones(_SMOOTH)
            count = np.convolve(there, ones, mode="valid")
            sums = np.convolve(np.where(there, values, 0.0), ones, mode="valid")
            values = np.divide(sums, count, out=np.full(sums.size, np.nan), where=count > 0.5)
            time = time[_SMOOTH // 2 : _SMOOTH // 2 + values.size]
        axes.plot(time, values, **look)
        words.append(f"{one.name} {math.sqrt(float(np.nanmean(residual.values[:, j] ** 2))):.2f}")
    axes.set_title(f"rms of the whole record: {', '.join(words)}", fontsize=style.SMALL, loc="left", color="#444444")
    axes.set(xlabel="Time (s)", ylabel="Residual over noise (-)")


def _percent(record: RecordFit) -> str:
    fits = record.fit_percent
    if len(fits) == 1:
        return f"fit {next(iter(fits.values())):.1f} %"
    return "fit " + ", ".join(f"{name} {value:.1f} %" for name, value in fits.items())


class Line(NamedTuple):
    """A line of an overlay: key of LOOKS, words, panel from 1, unit, times (n,) in s and values (n,) in that unit."""

    key: str
    words: str
    panel: int
    unit: str
    time: Array
    values: Array


def compared_lines(
    units: Sequence[str],
    time: Array,
    measured: Array,
    models: Sequence[tuple[str, str, Array, Array, Array | None]],
) -> list[Line]:
    """Each signal as measured and as models have it, and in the panel below it what each leaves.

    Args:
        units: of the signals, SI.
        time, measured: (n,) in s, and (n, n_y).
        models: key of LOOKS, words, times (m,), simulated (m, n_y), and what is left over noise (m, n_y), or None.
    """
    lines = []
    for j, (unit, factor) in enumerate(map(shown_unit, units)):
        lines.append(Line("measured", "measured", 2 * j + 1, unit, time, factor * measured[:, j]))
        lines += [Line(key, words, 2 * j + 1, unit, at, factor * y[:, j]) for key, words, at, y, _ in models]
        shown = [(key, words, at, left) for key, words, at, _, left in models if left is not None]
        lines += [Line(key, words, 2 * j + 2, "times the noise", at, left[:, j]) for key, words, at, left in shown]
    return lines


def beside_chart(beside: Mapping[str, RecordFit]) -> Chart:
    """One log, measured and as each model has it, and below it what each leaves.

    Args:
        beside: name of a model -> the log beside it.
    """
    first = next(iter(beside.values()))
    log = first.measured
    models = [
        (key, f"{name}: {_percent(one)}", one.simulated.time, one.simulated.values, one.residual.values)
        for (name, one), key in zip(beside.items(), cycle(_MODELS), strict=False)
    ]
    lines = compared_lines(log.units, log.time, log.values, models)
    shown = [shown_unit(unit)[0] for unit in log.units]
    found = overlay_chart(log.names, shown, [(key, words) for key, words, *_ in models], traces(lines))
    layout: dict[str, Any] = found["layout"]
    top = {
        "text": plain(_title(first)),
        "x": 0.02,
        "yref": "container",
        "y": 0.99,
        "yanchor": "top",
        "font": {"size": 13},
    }
    return {**found, "layout": {**layout, "title": top, "margin": {**layout["margin"], "t": 52}}}


def time_response_figure(records: Mapping[str, Record], signals: Sequence[str]) -> Figure:
    """A panel per signal with every record laid over the others, the first one as the reference in black.

    Args:
        records: label -> record; each has all signals.
        signals: names, from top to bottom; pressures are drawn in bar, lengths in mm, angles in degrees,
            speeds in rpm or mm/s.
    Raises:
        BadInput: no record, no signal, or a record without one of them.
    """
    if not records or not signals:
        raise BadInput("time response figure: needs at least one record and one signal")
    figure, grid = style.panels(8.0, 0.9 + 1.7 * len(signals), len(signals), sharex=True)
    axes, handles = grid[:, 0], []
    for i, record in enumerate(records.values()):
        colour = style.MEASURED if i == 0 else style.COLOURS[(i - 1) % len(style.COLOURS)]
        for panel, name in zip(axes, signals, strict=True):
            unit, factor = shown_unit(record.units[record.names.index(name)] if name in record.names else "1")
            dash = "-" if i == 0 else style.DASHES[i % len(style.DASHES)]
            (line,) = panel.plot(record.time, factor * record[name], color=colour, linestyle=dash, linewidth=1.3)
            panel.set_ylabel(f"{name} ({unit})")
        handles.append(line)
    axes[-1].set_xlabel("Time (s)")
    style.legend_above(figure, handles, list(records))
    return figure


def lines_chart(records: Mapping[str, Record]) -> Chart:
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
    lines = [
        Line(key, words, [*units].index(name) + 1, shown[name][0], one.time, shown[name][1] * one[name])
        for (words, one), key in zip(records.items(), cycle(LOOKS), strict=False)
        for name in one.names
    ]
    return overlay_chart([*units], [unit for unit, _ in shown.values()], [], traces(lines))


def traces(lines: Sequence[Line], points: Sequence[tuple[Any, Any]] = ()) -> list[dict[str, Any]]:
    """Lines as `overlay_chart` takes them, each name once in the legend.

    Args:
        points: of each line, times and values to draw; all samples where there are none.
    """
    found: list[dict[str, Any]] = []
    for line, (x, y) in zip(lines, points or [(one.time.tolist(), drawn(one.values)) for one in lines], strict=True):
        legend = all(line.words != one["legendgroup"] for one in found)
        trace = signal_trace(line.key, line.words, line.panel, x, y, legend=legend, unit=line.unit)
        found.append(trace | {"legendgroup": line.words})
    return found


def drawn(values: Array) -> list[float | None]:
    """Heights of a line, with a gap where nothing was measured."""
    return [None if math.isnan(one) else one for one in values.tolist()]


def overlay_chart(
    names: Sequence[str], units: Sequence[str], models: Sequence[tuple[str, str]], traces: Sequence[Mapping[str, Any]]
) -> Chart:
    """Each signal as measured and as the models have it, what each leaves below; all panels share the time axis.

    Args:
        names, units: of the signals.
        models: key of LOOKS and words of each model.
        traces: as `traces` gives them.
    """
    layout: dict[str, Any] = {"xaxis": axis("Time (s)", showgrid=True)}
    heights = [weight for _ in names for weight in ((3.0, 2.0) if models else (3.0,))]
    gap = 0.045
    free, top = 1.0 - gap * (len(heights) - 1), 1.0
    for k, weight in enumerate(heights):
        size = free * weight / sum(heights)
        name = names[k // 2] if models else names[k]
        unit = units[k // 2] if models else units[k]
        residual = bool(models) and k % 2 == 1
        title = "residual<br>(noise s.d.)" if residual else f"{plain(name)}<br>({unit_text(unit)})"
        low = max(top - size, 0.0)
        layout[f"yaxis{k + 1 if k else ''}"] = axis(title, domain=[low, top], anchor="x")
        top -= size + gap
    layout["xaxis"]["anchor"] = f"y{len(heights)}" if len(heights) > 1 else "y"
    bands = [level_band(-HALF_95, HALF_95, yref=f"y{2 * k + 2}") for k in range(len(names) if models else 0)]
    return chart(traces, **layout, shapes=bands, dragmode="zoom", margin={"l": 74, "r": 18, "t": 30, "b": 46})


def signal_trace(key: str, words: str, panel: int, x: Any, y: Any, *, legend: bool, unit: str = "") -> dict[str, Any]:
    """One line of an overlay.

    Args:
        key: of LOOKS.
        panel: from 1, from above.
    """
    _, colour, dash = LOOKS[key]
    look = {"color": colour, "width": 1.4 if key == "measured" else 1.8, "dash": dash}
    hover = f"{plain(words)}: %{{y:.4g}} {unit_text(unit)} at %{{x:.4g}} s<extra></extra>"
    place = {"xaxis": "x", "yaxis": f"y{panel}" if panel > 1 else "y"}
    return {"type": "scatter", "mode": "lines", "x": x, "y": y, "name": plain(words), "line": look, **place} | {
        "legendgroup": key, "showlegend": legend, "hovertemplate": hover,
    }  # fmt: skip


def regions_figure(failures: Sequence[Failure]) -> Figure:
    """Where a model fails, the worst regions above, with their residual in standard deviations of the noise.

    Raises:
        BadInput: no log was compared.
    """
    if not failures:
        raise BadInput("regions: no log over time was compared, so there is nothing to draw")
    rows = failures[:_WORST]
    figure, ((axes,),) = style.panels(7.4, 0.9 + 0.27 * len(rows))
    axes.barh(range(len(rows)), [one.error for one in rows], color=style.COLOURS[0], height=0.7)
    axes.axvline(1.0, color=style.MEASURED, linewidth=0.9)
    names = [f"{one.record}, {one.signal}: {one.region}" for one in rows]
    axes.set_yticks(range(len(rows)), names, fontsize=style.SMALL)
    axes.invert_yaxis()
    axes.set_xlabel("Residual over noise (1: noise alone)")
    return figure


def regions_chart(failures: Sequence[Failure]) -> Chart:
    """Where a model fails, the worst regions above, with their residual over noise."""
    worst = failures[:_WORST]
    names = [plain(f"{one.record}, {one.signal}: {one.region}") for one in worst]
    bars = {"type": "bar", "orientation": "h", "x": [one.error for one in worst], "y": names}
    return chart(
        [{**bars, "marker": {"color": "@final"}}],
        xaxis=axis("Residual over noise (1: noise alone)"),
        yaxis=axis(type="category", autorange="reversed", ticksuffix="  "),
        showlegend=False,
    )
