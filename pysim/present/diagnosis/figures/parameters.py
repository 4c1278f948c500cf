"""Parameters before and after: which of them were biased by what was missing."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

from pysim.present import style
from pysim.present.parameters import AFTER, BEFORE, START, between_bounds, parameters_legend
from pysim.types import BadInput, ErrorStep, Estimate

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

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
    looks = {"as it is": {**START, "linestyle": "none"}, "refitted, 95 % interval": BEFORE}
    if after is not None and ends:
        axes[0, -1].grid(False, axis="y")
        _moves(axes[0, -1], rows, after.moves_from(before), held)
        looks["with what was added, 95 % interval"] = AFTER
    between_bounds(axes[0, 0], rows, BEFORE, ends)
    parameters_legend(figure, axes[0, 0], looks)
    return figure


def _moves(axes: Axes, rows: Sequence[Estimate], moves: dict[str, float | None], held: set[str]) -> None:
    """Bars on a logarithmic axis from a tenth of an interval's half width."""
    from pysim.present.ticks import round_numbers

    axes.set_xscale("log")
    high = max([10.0, *(m for m in moves.values() if m is not None)])
    axes.set_xlim(_LEAST, 8 * high)
    style.plain_numbers(axes.xaxis, round_numbers(_LEAST, 8 * high))
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
    axes.set_xlabel("Moved by (half widths of its 95 % interval)")


def _along(estimate: Estimate, values: dict[str, float]) -> tuple[float, float]:
    """Its interval, moved by the same factor as its value."""
    factor = values.get(estimate.name, estimate.value) / estimate.value if estimate.value else 1.0
    return estimate.interval[0] * factor, estimate.interval[1] * factor
