"""The criteria of thesis Tables 1.3 and 1.4 over their limits, step by step."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

from pysim.present.criteria import CRITERIA
from pysim.present.diagnosis.words import step_name
from pysim.present.interactive.look import Figure, axis, figure, plain

_LEAST = 1e-3  # share of a limit below which nobody looks
# What is shown of a criterion: its colour by what is compared, its dash and mark by whether mean or maximum.
_GROUPS = {"E_M": "@final", "E_P": "@base", "E_t": "@measured"}


def criteria_figure(steps: Sequence[Mapping[str, Any]]) -> Figure:
    """Worst value of every criterion of thesis Tables 1.3 and 1.4, step by step, over its limit, which is a line.

    Args:
        steps: of the error history; those without criteria leave a gap.
    """
    symbols = [symbol for symbol in CRITERIA if any(symbol in step["criteria"] for step in steps)]
    data: list[dict[str, Any]] = []
    for symbol in symbols:
        one = CRITERIA[symbol]
        values = [step["criteria"].get(symbol) for step in steps]
        told = ["" if v is None else f"{one.name} {v:.3g} of {one.limit:g} {one.unit}" for v in values]
        shares = [None if v is None else max(v / one.limit, _LEAST) for v in values]
        colour = _GROUPS[symbol.partition(" ")[0]]
        mean = symbol.endswith("mean")
        look = {"color": colour, "width": 2.5, "dash": "solid" if mean else "dash"}
        x = [edge for k in range(len(steps)) for edge in (k - 0.5, k + 0.5)]
        y = [v for v in shares for _ in range(2)]
        mark = {"color": colour, "size": 8, "symbol": "circle" if mean else "square"}
        group = {"legendgroup": symbol, "name": one.name.replace(" deviation", "")}
        data.append({"x": x, "y": y, "mode": "lines", "line": look, "hoverinfo": "skip", "showlegend": False, **group})
        middle = {"x": [None, *range(len(steps))], "y": [None, *shares], "text": ["", *told]}
        data.append(
            {**middle, "mode": "markers", "line": look, "marker": mark, "hovertemplate": "%{text}<extra></extra>"}
            | group
        )
    known = [v for trace in data for v in trace["y"] if v is not None]
    low, high = min([0.3, *(0.6 * v for v in known)]), max([3.0, *(1.7 * v for v in known)])
    limit = {"type": "line", "xref": "paper", "x0": 0, "x1": 1, "y0": 1, "y1": 1, "line": {"color": "@bad", "width": 2}}
    words = {"xref": "paper", "x": 0.996, "y": 0.0, "text": "limit", "showarrow": False, "xanchor": "right"}
    names = [plain(step_name(step["step"])) for step in steps]
    ticks = [d * 10.0**p for p in range(-4, 6) for d in (1, 3) if low <= d * 10.0**p <= high]
    return figure(
        data,
        xaxis=axis(
            range=[-0.5, max(len(names), 3) - 0.5], tickvals=list(range(len(names))), ticktext=names, showgrid=False
        ),
        yaxis=axis(
            "Worst value over its limit (–)", type="log", range=[math.log10(low), math.log10(high)], tickvals=ticks,
            ticktext=[f"{t:g}" for t in ticks],
        ),
        shapes=[limit],
        annotations=[{**words, "yanchor": "bottom", "font": {"size": 12, "color": "@bad"}}],
        margin={"l": 62, "r": 18, "t": 50, "b": 30},
    )  # fmt: skip
