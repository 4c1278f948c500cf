"""Charts: figures that move and zoom, as Plotly takes them; of the workbench, and by `as_plotly` of notebooks.

A chart stands beside the figure of the same thing, in one file. Colours are names such as "@ink", which the look of
the page fills in.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from html import escape
from typing import Any, NamedTuple

from pysim.io.named_columns import optional_package

Chart = dict[str, Any]


class Look(NamedTuple):
    """Of a line: words for its legend, colour, dash."""

    words: str
    colour: str
    dash: str


# Models from the untouched to the final one, told apart by colour and by dash.
LOOKS = {
    "measured": Look("measured", "@measured", "solid"),
    "prior": Look("as it is", "@prior", "dot"),
    "refit": Look("refitted", "@base", "dash"),
    "last": Look("with what was added", "@final", "solid"),
    "raw": Look("as logged", "@prior", "solid"),
}
# The light look of pysim/app/static/app.css.
COLOURS = {
    "ink": "#17212b", "quiet": "#5a6774", "line": "#d9dfe5", "grid": "#e8ecf0", "raised": "#ffffff",
    "final": "#0067b1", "finalband": "rgba(0, 103, 177, 0.16)", "base": "#bf4f05", "measured": "#17212b",
    "prior": "#8a95a1", "band": "rgba(110, 124, 140, 0.15)", "bad": "#b3261e",
}  # fmt: skip
HEAT = ("#f7f9fb", "#fdd9ab", "#ef7a43", "#9c1c06")


def plain(text: str) -> str:
    """A name of the user's inside a chart: shown as it is, whatever is in it."""
    return escape(text, quote=False)


def unit_text(unit: str) -> str:
    """A unit, as `shown_unit` gives it, behind a name."""
    return {"": "–", "-": "–", "deg": "°"}.get(unit, plain(unit))


def chart(data: Sequence[Mapping[str, Any]], **layout: Any) -> Chart:
    """With the one look of all charts."""
    base = {
        "paper_bgcolor": "rgba(0,0,0,0)",
        "plot_bgcolor": "rgba(0,0,0,0)",
        "font": {"family": "inherit", "size": 12.5, "color": "@ink"},
        "margin": {"l": 62, "r": 18, "t": 34, "b": 46},
        "hovermode": "closest",
        "hoverlabel": {"bgcolor": "@raised", "bordercolor": "@line", "font": {"color": "@ink", "size": 12.5}},
        "legend": {"orientation": "h", "x": 0, "y": 1.0, "yanchor": "bottom", "bgcolor": "rgba(0,0,0,0)"},
        "showlegend": True,
        "modebar": {"bgcolor": "rgba(0,0,0,0)", "color": "@quiet", "activecolor": "@ink"},
        "uirevision": "keep",
    }
    return {"data": list(data), "layout": {**base, **layout}}


def axis(title: str = "", **more: Any) -> dict[str, Any]:
    """A quiet axis; to look for labels that have no room would take a third of a drawing."""
    look = {"gridcolor": "@grid", "linecolor": "@line", "tickcolor": "@line", "zeroline": False}
    room = {"automargin": True, "ticklabeloverflow": "allow"}
    return {**look, **room, "title": {"text": title, "standoff": 8, "font": {"size": 12.5}}, **more}


def step_axis(names: Sequence[str]) -> dict[str, Any]:
    """Steps side by side, with room for three."""
    ends = [-0.5, max(len(names), 3) - 0.5]
    return axis(range=ends, tickvals=list(range(len(names))), ticktext=list(names), showgrid=False)


def size_axis(title: str, low: float, high: float, ticks: Sequence[float]) -> dict[str, Any]:
    """Logarithmic from low to high, with plain numbers."""
    ends, words = [math.log10(low), math.log10(high)], [f"{t:g}" for t in ticks]
    return axis(title, type="log", range=ends, tickvals=ticks, ticktext=words)


def level_line(y: float, colour: str, width: float) -> dict[str, Any]:
    """A line over the whole width."""
    line = {"color": colour, "width": width}
    return {"type": "line", "xref": "paper", "x0": 0, "x1": 1, "y0": y, "y1": y, "line": line}


def level_band(low: float, high: float, **where: str) -> dict[str, Any]:
    """A grey field over the whole width."""
    place = {"type": "rect", "xref": "paper", "x0": 0, "x1": 1, **where, "y0": low, "y1": high}
    return {**place, "fillcolor": "@band", "line": {"width": 0}, "layer": "below"}


def between(
    x: Sequence[float], low: Sequence[float], high: Sequence[float], colour: str, **more: Any
) -> dict[str, Any]:
    """A field between two curves."""
    edge = {"x": [*x, *reversed(x)], "y": [*high, *reversed(low)], "fill": "toself", "fillcolor": colour}
    return {**edge, "line": {"width": 0}, "mode": "lines", "hoverinfo": "skip", **more}


def heat_map(
    rows: Sequence[str],
    columns: Sequence[str],
    values: Sequence[Sequence[float | None]],
    text: Sequence[Sequence[str]],
    across: Mapping[str, Any],
    more: Mapping[str, Any],
    **layout: Any,
) -> Chart:
    """A field of numbers, the first row above.

    Args:
        across: the axis of the columns.
        more: of the field, such as its colours.
    """
    names = [plain(row).replace(" (", "<br>(") for row in rows]  # a narrow page has room for half of one
    heat: Chart = {"type": "heatmap", "x": [*map(plain, columns)], "y": names, "z": values, "text": text}
    heat |= {"texttemplate": "%{text}", "xgap": 2, "ygap": 2, **more}
    down = axis(type="category", autorange="reversed", showgrid=False, ticksuffix="  ")
    return chart([heat], xaxis=across, yaxis=down, showlegend=False, **layout)


def stairs(
    values: Sequence[float | None], line: Mapping[str, Any], mark: Mapping[str, Any], apart: bool = False, **more: Any
) -> list[Chart]:
    """A level per step, and a mark in its middle; a gap where there is no value.

    Args:
        line, mark: how both look; apart: levels are not joined.
        more: of both, such as their name; `text` and `hovertemplate` are the mark's.
    """
    told: dict[str, Any] = {key: more.pop(key) for key in ("text", "hovertemplate") if key in more}
    gap = (None,) * apart
    x = [edge for k in range(len(values)) for edge in (k - 0.5, k + 0.5, *gap)]
    level = {"x": x, "y": [one for v in values for one in (v, v, *gap)], "mode": "lines", "hoverinfo": "skip"}
    middle = {"x": [None, *range(len(values))], "y": [None, *values], "mode": "markers", "marker": mark}
    return [{**level, "line": line, "showlegend": False, **more}, {**middle, "line": line, **more, **told}]


def as_plotly(made: Chart) -> Any:
    """A `plotly.graph_objects.Figure`.

    Raises:
        BadInput: the package is not installed.
    """
    graph = optional_package(
        "plotly.graph_objects", "an interactive figure needs Plotly", '"hydraulic-test-bench[notebook]"'
    )
    return graph.Figure(coloured(made))


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
