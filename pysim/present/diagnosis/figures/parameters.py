"""Parameters before and after: which of them were biased by what was missing."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from pysim.present import style
from pysim.types import BadInput, ErrorStep, Estimate

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_TICK: dict[str, Any] = {"marker": "|", "markersize": 9, "markeredgewidth": 2}
_LEAST = 0.1  # half widths of an interval at which the axis of the moves begins


def parameters_figure(before: ErrorStep, after: ErrorStep | None) -> Figure:
    """Left, each parameter between its bounds with its interval; right, by how many intervals it has moved.

    Args:
        before: the refitted base model.
        after: with what was added; None where nothing was.
    Raises:
        BadInput: no estimate.
    """
    if not before.estimates:
        raise BadInput("parameters figure: the refitted model has no estimates")
    ends = {} if after is None else {e.name: e for e in after.estimates}
    values = {} if after is None else before.on_the_scale_of(after)
    rows = [replace(e, value=values.get(e.name, e.value), interval=_along(e, values)) for e in before.estimates]
    held = {next(iter(d.exponents)) for d in (before if after is None else after).undetermined}
    ratios = [3, 2] if ends else [3]
    width, height = 7.8 if ends else 5.6, 1.1 + 0.27 * len(rows)
    figure, axes = style.panels(width, height, 1, len(ratios), sharey=True, width_ratios=ratios)
    left = axes[0, 0]
    for panel in axes.flat:
        panel.grid(False, axis="y")
    if after is not None:
        _moves(axes[0, -1], rows, after.moves_from(before), held)
    _between_bounds(left, rows, ends)
    left.set_ylim(len(rows) - 0.4, -0.6)
    names = [f"{e.name} ({e.unit})" if e.unit != "1" else e.name for e in rows]
    left.set_yticks(range(len(rows)), names, fontsize=style.SMALL)
    looks: dict[str, dict[str, Any]] = {
        "as it is": {**_TICK, "color": style.LIMIT, "linestyle": "none"},
        "refitted, 95 % interval": {"color": style.COLOURS[1], "marker": "s", "markersize": 4, "linewidth": 2},
        "with what was added, 95 % interval": {
            "color": style.COLOURS[0],
            "marker": "o",
            "markersize": 4,
            "linewidth": 2,
        },
    }
    shown = list(looks)[: 3 if ends else 2]
    style.legend_above(figure, [left.plot([], [], **looks[name])[0] for name in shown], shown)
    return figure


def _between_bounds(axes: Axes, rows: Sequence[Estimate], ends: dict[str, Estimate]) -> None:
    for i, first in enumerate(rows):
        axes.plot([0, 1], [i, i], color=style.BAND, linewidth=0.8, zorder=0)
        axes.plot(_share(first, first.start), i, color=style.LIMIT, **_TICK)
        _bar(axes, i - 0.14 if ends else i, first, first, style.COLOURS[1], "s")
        if first.name in ends:
            _bar(axes, i + 0.14, first, ends[first.name], style.COLOURS[0], "o")
    axes.set_xlim(-0.03, 1.03)
    axes.set_xticks([0, 0.5, 1], ["lower\nbound", "", "upper\nbound"], fontsize=style.SMALL)


def _bar(axes: Axes, y: float, scale: Estimate, estimate: Estimate, colour: str, marker: str) -> None:
    """An interval and the estimate in it; hollow where the data do not determine the parameter."""
    if estimate.determined:
        share = np.clip([_share(scale, v) for v in estimate.interval], 0, 1)
        axes.plot(share, [y, y], color=colour, linewidth=2, solid_capstyle="butt")
    face = colour if estimate.determined else "white"
    axes.plot(
        np.clip(_share(scale, estimate.value), 0, 1), y, color=colour, marker=marker, markersize=4, markerfacecolor=face
    )


def _share(scale: Estimate, value: float) -> float:
    """Of the way between the bounds; where one is infinite, between the values that occur."""
    finite = [v for v in (scale.value, scale.start, *scale.interval) if math.isfinite(v)]
    low = scale.lower if math.isfinite(scale.lower) else min(finite)
    high = scale.upper if math.isfinite(scale.upper) else max(finite)
    return (value - low) / (high - low) if high > low else 0.5


def _moves(axes: Axes, rows: Sequence[Estimate], moves: dict[str, float | None], held: set[str]) -> None:
    """Bars on a logarithmic axis from a tenth of an interval's half width."""
    axes.set_xscale("log")
    high = max([10.0, *(m for m in moves.values() if m is not None)])
    axes.set_xlim(_LEAST, 8 * high)
    axes.axvspan(_LEAST, 1.0, color=style.BAND, alpha=0.6, linewidth=0)
    for i, row in enumerate(rows):
        move = moves.get(row.name)
        if move is None:
            words = "held, sets the scale" if row.name in held else "not determined by itself"
            axes.text(1.2 * _LEAST, i, words, va="center", fontsize=style.SMALL, color="#5c5c5c")
            continue
        if move > _LEAST:
            axes.barh(i, move - _LEAST, left=_LEAST, height=0.56, color=style.COLOURS[0] if move > 1 else style.LIMIT)
        text = f"{move:.1f}" if move < 100 else f"{move:,.0f}"
        style.small_text(axes, text, (max(move, _LEAST), i), (4, 0), va="center")
    axes.set_xlabel("Moved by (half widths of its interval)")


def _along(estimate: Estimate, values: dict[str, float]) -> tuple[float, float]:
    """Its interval, moved by the same factor as its value."""
    factor = values.get(estimate.name, estimate.value) / estimate.value if estimate.value else 1.0
    return estimate.interval[0] * factor, estimate.interval[1] * factor
