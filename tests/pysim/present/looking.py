"""What a reader of a picture sees: the numbers on its axes, whether all of it is on the page, and lines of a chart."""

from __future__ import annotations

from typing import Any

from matplotlib.axis import Axis
from matplotlib.figure import Figure


def numbers(axis: Axis) -> list[str]:
    """The numbers within the ends of an axis, as they are written; nothing is drawn for it."""
    low, high = sorted(axis.get_view_interval())
    room = 1e-3 * (high - low)
    places = axis.get_majorticklocs()
    words = axis.get_major_formatter().format_ticks(list(places))
    inside = [low - room <= place <= high + room for place in places]
    return [word.replace("\N{MINUS SIGN}", "-") for word, shown in zip(words, inside, strict=True) if shown]


def is_whole(figure: Figure) -> bool:
    """Whether nothing runs over the edges of the page."""
    figure.draw_without_rendering()
    drawn, page = figure.get_tightbbox(), figure.bbox_inches
    return bool(drawn.x0 >= 0 and drawn.y0 >= 0 and drawn.x1 <= page.x1 and drawn.y1 <= page.y1)


def trace(chart: dict[str, Any], name: str, panel: str = "y") -> dict[str, Any]:
    """The line of a chart with a name, in a panel."""
    return next(t for t in chart["data"] if t["name"].startswith(name) and t.get("yaxis", "y") == panel)
