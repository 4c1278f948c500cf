"""Where the error is: a cell per test."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

from pysim.present.interactive.look import Figure, axis, figure, plain


def map_figure(
    rows: Sequence[str],
    columns: Sequence[str],
    values: Sequence[Sequence[float | None]],
    title: str,
    *,
    scale: bool = True,
) -> Figure:
    """Root-mean-square residual over noise of every test; numbers stand in the cells, so that no colour is needed.

    Args:
        values: per row, per column; None where no such test was run.
        title: of the columns.
        scale: whether a scale of the colours stands beside it.
    """
    shown = [[None if v is None else math.log10(max(v, 1.0)) for v in row] for row in values]
    text = [["" if v is None else f"{v:.1f}" if v < 99.5 else f"{v:.0f}" for v in row] for row in values]
    high = max([10.0, *(v for row in values for v in row if v is not None)])
    ticks = [t for t in (1, 2, 5, 10, 20, 50, 100, 200, 500, 1000) if t <= high]
    bar: dict[str, Any] = {
        "title": {"text": "residual over noise", "side": "right"},
        "tickvals": [math.log10(t) for t in ticks],
    }
    bar |= {"ticktext": [f"{t:g}" for t in ticks], "thickness": 10, "outlinewidth": 0, "len": 1}
    heat: dict[str, Any] = {
        "type": "heatmap",
        "x": [plain(c) for c in columns],
        "y": [plain(r) for r in rows],
        "z": shown,
    }
    heat |= {"text": text, "texttemplate": "%{text}", "zmin": 0, "zmax": math.log10(high), "colorscale": "@heat"}
    heat |= {
        "colorbar": bar,
        "xgap": 2,
        "ygap": 2,
        "hoverongaps": False,
        "showscale": scale,
        "textfont": {"size": 11.5},
    }
    heat |= {"hovertemplate": "%{y}<br>%{x}: %{text} x noise<extra></extra>"}
    return figure(
        [heat],
        xaxis=axis(title, type="category", showgrid=False, side="bottom"),
        yaxis=axis(type="category", autorange="reversed", showgrid=False, ticksuffix="  "),
        margin={"l": 40, "r": 10, "t": 10, "b": 46},
        showlegend=False,
    )


def correlation_figure(names: Sequence[str], matrix: Sequence[Sequence[float | None]]) -> Figure:
    """Correlations of estimates, from -1 to 1; an empty cell where the data determine none."""
    shown = [[None if v is None or math.isnan(v) else v for v in row] for row in matrix]
    text = [["" if v is None else f"{v:.2f}" for v in row] for row in shown]
    words = [plain(name) for name in names]
    heat: dict[str, Any] = {"type": "heatmap", "x": words, "y": words, "z": shown, "text": text}
    heat |= {"texttemplate": "%{text}"}
    heat |= {"zmin": -1, "zmax": 1, "colorscale": "RdBu", "reversescale": True, "xgap": 2, "ygap": 2}
    return figure(
        [{**heat, "hovertemplate": "%{y}, %{x}: %{z:.3f}<extra></extra>"}],
        xaxis=axis(type="category", showgrid=False),
        yaxis=axis(type="category", autorange="reversed", showgrid=False, ticksuffix="  "),
        showlegend=False,
    )
