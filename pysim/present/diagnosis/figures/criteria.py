"""The criteria of thesis Tables 1.3 and 1.4, step by step: a table below the falling error, and a chart."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

from pysim.present import style
from pysim.present.charts import Chart, chart, level_line, plain, size_axis, stairs, step_axis
from pysim.present.criteria import CRITERIA
from pysim.present.diagnosis.words import step_name
from pysim.types import Criterion, ErrorStep

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_PASS, _FAIL = "#14663a", "#b3261e"
_LEAST = 1e-3  # share of a limit below which nobody looks
# What is shown of a criterion: its colour by what is compared, its dash and mark by whether mean or maximum.
_GROUPS = {"E_M": "@final", "E_P": "@base", "E_t": "@measured"}


def criteria_rows(axes: Axes, steps: Sequence[ErrorStep], symbols: Sequence[str]) -> None:
    """A row per criterion, a column per step: its worst value, met or not."""
    axes.grid(False)
    for row, symbol in enumerate(symbols):
        for i, step in enumerate(steps):
            value, limit = step.criteria.get(symbol), CRITERIA[symbol].limit
            if value is None:
                continue
            met = value <= limit
            text = f"{value:.3g}  {'✓' if met else '✗'}"
            axes.text(
                i, row, text, ha="center", va="center", fontsize=style.SMALL, color=_PASS if met else _FAIL,
                fontweight="normal" if met else "bold",
            )  # fmt: skip
    axes.set_ylim(len(symbols) - 0.4, -0.6)
    axes.set_yticks(range(len(symbols)), [_limit(CRITERIA[s]) for s in symbols], fontsize=style.SMALL)
    axes.spines[:].set_visible(False)
    axes.tick_params(length=0, labelbottom=False)
    for row in range(len(symbols) + 1):
        axes.axhline(row - 0.5, color="#e6e6e6", linewidth=0.6)


def _limit(criterion: Criterion) -> str:
    words = criterion.name.removesuffix(" deviation")
    return f"{words} ≤ {criterion.limit:g} {criterion.unit}"


def criteria_chart(steps: Sequence[Mapping[str, Any]]) -> Chart:
    """Worst value of every criterion, step by step, over its limit, which is a line.

    Args:
        steps: of the error history as JSON has them; those without criteria leave a gap.
    """
    data: list[Chart] = []
    for symbol, one in CRITERIA.items():
        values = [step["criteria"].get(symbol) for step in steps]
        if all(value is None for value in values):
            continue
        told = ["" if v is None else f"{one.name} {v:.3g} of {one.limit:g} {one.unit}" for v in values]
        shares = [None if v is None else max(v / one.limit, _LEAST) for v in values]
        colour, mean = _GROUPS[symbol.partition(" ")[0]], symbol.endswith("mean")
        line = {"color": colour, "width": 2.5, "dash": "solid" if mean else "dash"}
        mark = {"color": colour, "size": 8, "symbol": "circle" if mean else "square"}
        hover: dict[str, Any] = {"text": ["", *told], "hovertemplate": "%{text}<extra></extra>"}
        name = one.name.replace(" deviation", "")
        data += stairs(shares, line, mark, legendgroup=symbol, name=name, **hover)
    known = [v for trace in data for v in trace["y"] if v is not None]
    low, high = min([0.3, *(0.6 * v for v in known)]), max([3.0, *(1.7 * v for v in known)])
    ticks = [d * 10.0**p for p in range(-4, 6) for d in (1, 3) if low <= d * 10.0**p <= high]
    words = {"xref": "paper", "x": 0.996, "y": 0.0, "text": "limit", "showarrow": False, "xanchor": "right"}
    return chart(
        data,
        xaxis=step_axis([plain(step_name(step["step"])) for step in steps]),
        yaxis=size_axis("Worst value over its limit (–)", low, high, ticks),
        shapes=[level_line(1, "@bad", 2)],
        annotations=[{**words, "yanchor": "bottom", "font": {"size": 12, "color": "@bad"}}],
        margin={"l": 62, "r": 18, "t": 50, "b": 30},
    )
