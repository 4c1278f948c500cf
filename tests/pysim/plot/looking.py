"""What a reader of a picture sees: the numbers on its axes, and whether all of it is on the page."""

from __future__ import annotations

from matplotlib.axis import Axis
from matplotlib.figure import Figure


def numbers(axis: Axis) -> list[str]:
    """The numbers within the ends of an axis, as they are written."""
    figure = axis.get_figure(root=True)
    assert isinstance(figure, Figure)
    figure.draw_without_rendering()
    low, high = sorted(axis.get_view_interval())
    room = 1e-3 * (high - low)
    shown = [tick for tick in axis.get_major_ticks() if low - room <= tick.get_loc() <= high + room]
    return [tick.label1.get_text().replace("\N{MINUS SIGN}", "-") for tick in shown]


def is_whole(figure: Figure) -> bool:
    """Whether nothing runs over the edges of the page."""
    figure.draw_without_rendering()
    drawn, page = figure.get_tightbbox(), figure.bbox_inches
    return bool(drawn.x0 >= 0 and drawn.y0 >= 0 and drawn.x1 <= page.x1 and drawn.y1 <= page.y1)
