"""Parameters between their bounds."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from pysim.present.interactive.look import Figure, axis, figure, plain


def parameters_figure(rows: Sequence[Mapping[str, Any]]) -> Figure:
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
        share = [[_share(v, row["lower"], row["upper"]) for v in three] for _, row, three in own]
        error = {"type": "data", "symmetric": False, "thickness": 1.8, "width": 3, "color": colour}
        error |= {"array": [s[2] - s[0] for s in share], "arrayminus": [s[0] - s[1] for s in share]}
        hover = [f"{names[k]} {words}: {t[0]:.4g} ({t[1]:.4g} to {t[2]:.4g})" for k, _, t in own]
        data.append(
            {"x": [s[0] for s in share], "y": [k + shift for k, *_ in own], "mode": "markers", "name": words}
            | {"marker": {"color": colour, "size": 8, "symbol": symbol}, "error_x": error, "text": hover}
            | {"hovertemplate": "%{text}<extra></extra>"}
        )
    return figure(
        data,
        xaxis=axis("Place between its bounds (%)", range=[-3, 103]),
        yaxis=axis(tickvals=list(range(len(names))), ticktext=names, autorange="reversed", ticksuffix="  "),
        margin={"l": 40, "r": 18, "t": 30, "b": 46},
    )


def _share(value: float, lower: float, upper: float) -> float:
    """Percent of the way from the lower to the upper bound."""
    return 100 * (min(max(value, lower), upper) - lower) / (upper - lower)
