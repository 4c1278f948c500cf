"""The falling error: a level per step and use of logs, as a figure and as a chart."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from pysim.present import style
from pysim.present.charts import Chart, chart, level_band, plain, size_axis, stairs, step_axis
from pysim.present.criteria import CRITERIA
from pysim.present.diagnosis.figures.criteria import criteria_rows
from pysim.present.diagnosis.words import errors, size_text, step_name
from pysim.present.notes import USES
from pysim.types import BadInput, ErrorStep

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_LOW = 0.6  # of the smallest value: room for its number below the line
TICKS = tuple(digit * 10.0**power for power in range(-2, 7) for digit in (1, 2, 5))
# Of a chart, by the use of logs: colour, dash and mark of its line, and where numbers stand that must not meet.
_MOVING = (("@final", "solid", "circle"), ("@base", "dash", "square"), ("@measured", "dot", "diamond"))
_LOOKS = dict(zip(USES.values(), _MOVING, strict=True))
_ABOVE, _BESIDE, _BELOW = {"yshift": 15}, {"xshift": 26}, {"yshift": -15}


@dataclass(frozen=True)
class Levels:
    """What is drawn.

    Args:
        lines: use of logs -> its residual over noise at each step, None where that is not known.
        low, high: ends of the axis.
        ticks: numbers on it.
    """

    lines: Mapping[str, tuple[float | None, ...]]
    low: float
    high: float
    ticks: tuple[float, ...]


def levels(steps: Sequence[ErrorStep]) -> Levels:
    """Of an error history; a use of which there are no logs has no line."""
    lines = {use: tuple(errors(step).get(use) for step in steps) for use in USES.values()}
    known = [value for values in lines.values() for value in values if value]
    low, high = min([_LOW, *(_LOW * v for v in known)]), max([1.6, *(1.7 * v for v in known)])
    shown = {use: values for use, values in lines.items() if any(value is not None for value in values)}
    return Levels(shown, low, high, tuple(t for t in TICKS if low <= t <= high))


def error_figure(steps: Sequence[ErrorStep]) -> Figure:
    """The residual over noise, step by step, of each use of logs; below, each criterion of Tables 1.3 and 1.4.

    Args:
        steps: of the error history, in order.
    Raises:
        BadInput: no step.
    """
    if not steps:
        raise BadInput("error figure: needs at least one step")
    symbols = [s for s in CRITERIA if any(s in step.criteria for step in steps)]
    width, height, ratios = max(6.6, 2.6 + 1.3 * len(steps)), 3.3 + 0.24 * len(symbols), [3.0]
    ratios += [0.3 + 0.27 * len(symbols)] if symbols else []
    figure, axes = style.panels(width, height, len(ratios), sharex=True, height_ratios=ratios)
    top = axes[0, 0]
    if symbols:
        criteria_rows(axes[1, 0], steps, symbols)
    _levels(figure, top, steps)
    top.set_xlim(-0.5, len(steps) - 0.5)
    top.set_xticks(range(len(steps)), [step_name(step.step) for step in steps], fontsize=style.TEXT)
    top.tick_params(labelbottom=True, bottom=False)
    return figure


def _levels(figure: Figure, axes: Axes, steps: Sequence[ErrorStep]) -> None:
    axes.grid(False, axis="x")
    axes.set_yscale("log")
    found = levels(steps)
    axes.set_ylim(found.low, found.high)
    style.plain_numbers(axes.yaxis, found.ticks)
    axes.axhspan(found.low, 1.0, color=style.BAND, alpha=0.6, linewidth=0)
    axes.axhline(1.0, color=style.LIMIT, linewidth=1.0)
    handles, names = [], []
    for k, name in enumerate(USES.values()):
        values = found.lines.get(name)
        if values is None:
            continue
        height = np.array([math.nan if v is None else v for v in values])
        edges = np.arange(-0.5, len(steps))
        handles.append(axes.stairs(height, edges, baseline=None, **style.look(k, "linestyle"), linewidth=2.0))
        axes.plot(np.arange(height.size), height, **style.look(k, "marker"), linestyle="none", markersize=5)
        names.append(name)
    for i, step in enumerate(steps):
        _numbers(axes, i, step)
    axes.set_ylabel("Residual over noise (-)")
    where = ("axes fraction", "data")
    style.small_text(axes, "noise alone", (0, 1.0), (4, -4), xycoords=where, va="top", color="#5c5c5c")
    style.legend_above(figure, handles, names)


def _numbers(axes: Axes, i: int, step: ErrorStep) -> None:
    """The largest one's value above its line, the smallest one's below, one between them beside, so that none meet."""
    known = errors(step)
    values = [(known[words], style.COLOURS[k]) for k, words in enumerate(USES.values()) if words in known]
    beside = [((8, 0), "left", "center")] * (len(values) - 2)
    places = [((0, 6), "center", "bottom"), *beside, ((0, -6), "center", "top")]
    for (value, colour), (away, ha, va) in zip(sorted(values, reverse=True), places, strict=False):
        style.small_text(axes, size_text(value), (i, value), away, ha=ha, va=va, color=colour)


def error_chart(steps: Sequence[ErrorStep], *, apart: bool = False) -> Chart:
    """The error over noise, step by step, of each use of logs.

    Args:
        steps: of the error history; the last ones of several histories where they stand `apart`.
    """
    names = [plain(step_name(step.step)) for step in steps]
    found = levels(steps)
    notes = [note for k in range(len(steps)) for note in _notes(k, {u: v[k] for u, v in found.lines.items()})]
    noise = {"xref": "paper", "x": 0.004, "y": math.log10(1.0), "text": "noise alone", "showarrow": False}
    notes.append({**noise, "xanchor": "left", "yanchor": "top", "font": {"size": 11.5, "color": "@quiet"}})
    return chart(
        [trace for use, values in found.lines.items() for trace in _stairs(use, values, apart=apart)],
        xaxis=step_axis(names),
        yaxis=size_axis("Error over noise (–)", found.low, found.high, found.ticks),
        shapes=[level_band(found.low, 1)],
        annotations=notes,
        margin={"l": 62, "r": 18, "t": 34, "b": 30},
    )


def _stairs(use: str, values: Sequence[float | None], *, apart: bool) -> list[Chart]:
    colour, dash, symbol = _LOOKS[use]
    line, mark = {"color": colour, "width": 3, "dash": dash}, {"color": colour, "size": 9, "symbol": symbol}
    told = f"{use}: %{{y:.3g}} times the noise<extra></extra>"
    return stairs(values, line, mark, apart=apart, name=use, hovertemplate=told)


def _notes(k: int, values: dict[str, float | None]) -> list[dict[str, Any]]:
    """The largest above its line, the smallest below, one between them beside."""
    known = sorted(((value, _LOOKS[use][0]) for use, value in values.items() if value), reverse=True)
    places = [_ABOVE, *[_BESIDE] * (len(known) - 2), _BELOW]
    return [
        {"x": k, "y": math.log10(value), "showarrow": False, **place, "text": f"<b>{size_text(value)}</b>"}
        | {"font": {"color": colour, "size": 13}}
        for (value, colour), place in zip(known, places, strict=False)
    ]
