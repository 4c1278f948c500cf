"""What all figures share: their look, and names and units of the user's as text."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from html import escape
from typing import Any, NamedTuple

Figure = dict[str, Any]


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
}


def plain(text: str) -> str:
    """A name of the user's inside a figure: shown as it is, whatever is in it."""
    return escape(text, quote=False)


def unit_text(unit: str) -> str:
    """A unit, as `shown_unit` gives it, behind a name."""
    return {"": "–", "-": "–", "deg": "°"}.get(unit, plain(unit))


def figure(data: Sequence[Mapping[str, Any]], **layout: Any) -> Figure:
    """With the one look of all figures."""
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
    """A quiet axis."""
    look = {"gridcolor": "@grid", "linecolor": "@line", "tickcolor": "@line", "zeroline": False, "automargin": True}
    return {**look, "title": {"text": title, "standoff": 8, "font": {"size": 12.5}}, **more}
