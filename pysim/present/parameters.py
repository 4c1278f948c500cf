"""Parameters between their bounds, with their intervals: of a fit, and of a model before and after it was extended."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from pysim.present import style
from pysim.present.charts import Chart, axis, chart, plain
from pysim.types import Estimate

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

START: dict[str, Any] = {"color": style.LIMIT, "marker": "|", "markersize": 9, "markeredgewidth": 2}
BEFORE, AFTER = ({**style.look(k, "marker"), "markersize": 4} for k in (1, 0))


def between_bounds(
    axes: Axes, rows: Sequence[Estimate], first: Mapping[str, Any], ends: Mapping[str, Estimate] | None = None
) -> None:
    """A row per estimate: its start, its interval and its value, and below it that of another fit.

    Args:
        rows: estimates, whose bounds are the scale.
        first: how they are drawn.
        ends: estimates of the other fit by their names.
    """
    for i, one in enumerate(rows):
        axes.plot([0, 1], [i, i], color=style.BAND, linewidth=0.8, zorder=0)
        axes.plot(_share(one, one.start), i, **START)
        _bar(axes, i - 0.14 if ends else i, one, one, first)
        if ends and one.name in ends:
            _bar(axes, i + 0.14, one, ends[one.name], AFTER)
    axes.grid(False, axis="y")
    axes.set_xlim(-0.03, 1.03)
    axes.set_xticks([0, 0.5, 1], ["lower\nbound", "", "upper\nbound"], fontsize=style.SMALL)
    axes.set_ylim(len(rows) - 0.4, -0.6)
    names = [f"{e.name} ({e.unit})" if e.unit != "1" else e.name for e in rows]
    axes.set_yticks(range(len(rows)), names, fontsize=style.SMALL)


def parameters_legend(figure: Figure, axes: Axes, looks: Mapping[str, Mapping[str, Any]]) -> None:
    """What the marks mean: words -> look."""
    style.legend_above(figure, [axes.plot([], [], **{"linewidth": 2, **look})[0] for look in looks.values()], [*looks])


def _bar(axes: Axes, y: float, scale: Estimate, estimate: Estimate, look: Mapping[str, Any]) -> None:
    """An interval and the estimate in it; hollow where the data do not determine the parameter."""
    if estimate.determined:
        share = np.clip([_share(scale, v) for v in estimate.interval], 0, 1)
        axes.plot(share, [y, y], color=look["color"], linewidth=2, solid_capstyle="butt")
    face = look["color"] if estimate.determined else "white"
    axes.plot(np.clip(_share(scale, estimate.value), 0, 1), y, **look, markerfacecolor=face)


def _share(scale: Estimate, value: float) -> float:
    """Of the way between the bounds; where one is infinite, between the values that occur."""
    finite = [v for v in (scale.value, scale.start, *scale.interval) if math.isfinite(v)]
    low = scale.lower if math.isfinite(scale.lower) else min(finite)
    high = scale.upper if math.isfinite(scale.upper) else max(finite)
    return (value - low) / (high - low) if high > low else 0.5


def parameters_chart(rows: Sequence[Mapping[str, Any]]) -> Chart:
    """Parameters before and after with their intervals, each on a scale between its bounds.

    Args:
        rows: `name`, `lower`, `upper`, and `before` and `after` as (value, low, high) or None.
    """
    data: list[dict[str, Any]] = []
    names = [plain(row["name"]) for row in rows]
    for key, words, colour, symbol, shift in (
        ("before", "before", "@base", "square", -0.17),
        ("after", "after", "@final", "circle", 0.17),
    ):
        own = [(k, row, row[key]) for k, row in enumerate(rows) if row.get(key)]
        if not own:
            continue
        share = [[_percent(v, row["lower"], row["upper"]) for v in three] for _, row, three in own]
        error = {"type": "data", "symmetric": False, "thickness": 1.8, "width": 3, "color": colour}
        error |= {"array": [s[2] - s[0] for s in share], "arrayminus": [s[0] - s[1] for s in share]}
        hover = [f"{names[k]} {words}: {t[0]:.4g} ({t[1]:.4g} to {t[2]:.4g})" for k, _, t in own]
        data.append(
            {"x": [s[0] for s in share], "y": [k + shift for k, *_ in own], "mode": "markers", "name": words}
            | {"marker": {"color": colour, "size": 8, "symbol": symbol}, "error_x": error, "text": hover}
            | {"hovertemplate": "%{text}<extra></extra>"}
        )
    return chart(
        data,
        xaxis=axis("Place between its bounds (%)", range=[-3, 103]),
        yaxis=axis(tickvals=list(range(len(names))), ticktext=names, autorange="reversed", ticksuffix="  "),
        margin={"l": 40, "r": 18, "t": 30, "b": 46},
    )


def _percent(value: float, lower: float, upper: float) -> float:
    """Of the way from the lower to the upper bound."""
    return 100 * (min(max(value, lower), upper) - lower) / (upper - lower)
