"""A figure of the page as a figure of the package Plotly, for notebooks."""

from __future__ import annotations

from typing import Any

from pysim.io.named_columns import optional_package
from pysim.present.interactive.look import Figure

# The light look of pysim/app/static/app.css.
COLOURS = {
    "ink": "#17212b", "quiet": "#5a6774", "line": "#d9dfe5", "grid": "#e8ecf0", "raised": "#ffffff",
    "final": "#0067b1", "finalband": "rgba(0, 103, 177, 0.16)", "base": "#bf4f05", "measured": "#17212b",
    "prior": "#8a95a1", "band": "rgba(110, 124, 140, 0.15)", "bad": "#b3261e",
}  # fmt: skip
HEAT = ("#f7f9fb", "#fdd9ab", "#ef7a43", "#9c1c06")


def as_plotly(figure: Figure) -> Any:
    """A `plotly.graph_objects.Figure`.

    Raises:
        BadInput: the package is not installed.
    """
    graph = optional_package(
        "plotly.graph_objects", "an interactive figure needs Plotly", '"hydraulic-test-bench[notebook]"'
    )
    return graph.Figure(coloured(figure))


def coloured(value: Any) -> Any:
    """With colours in place of their names."""
    if isinstance(value, str):
        if value == "@heat":
            return [[k / (len(HEAT) - 1), colour] for k, colour in enumerate(HEAT)]
        if value == "inherit":
            return "Roboto, system-ui, sans-serif"
        return COLOURS[value[1:]] if value.startswith("@") else value
    if isinstance(value, dict):
        return {key: coloured(one) for key, one in value.items()}
    return [coloured(one) for one in value] if isinstance(value, list | tuple) else value
