"""One look for all figures: colours that colour-blind readers can tell apart, quiet axes, legible in print.

Matplotlib is imported when a figure is made, so that a file that shows a method imports this one at its top.
"""

from __future__ import annotations

import io
import math
from collections.abc import Sequence
from functools import partial
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from matplotlib.artist import Artist
    from matplotlib.axes import Axes
    from matplotlib.axis import Axis
    from matplotlib.figure import Figure
    from matplotlib.ticker import Locator
    from numpy.typing import NDArray

MEASURED = "#1a1a1a"
BAND = "#d9d9d9"
LIMIT = "#8c8c8c"
# Okabe and Ito's palette, strongest contrasts first; each set also has a marker and a dash of its own, for grey print
COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9")
MARKERS = ("o", "s", "^", "D", "v", "P")
DASHES = ("-", (0, (5, 2)), (0, (1, 1.4)), (0, (6, 2, 1, 2)), (0, (3, 1)), (0, (8, 3)))
TEXT = 9.0
SMALL = 8.0

_LEGEND_ROW = 0.19  # in
_SCREEN_DPI = 100.0  # of a figure in a notebook


def new_figure(width: float, height: float) -> Figure:
    """An empty white figure, inches, that fits its own parts; no pyplot, so no global state."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(width, height), layout="constrained", facecolor="white")
    figure._repr_png_ = partial(_png, figure)  # type: ignore[attr-defined]
    return figure


def _png(figure: Figure) -> bytes:
    """What a notebook shows, which knows figures of pyplot alone by itself."""
    data = io.BytesIO()
    figure.savefig(data, format="png", dpi=_SCREEN_DPI)
    return data.getvalue()


def panels(width: float, height: float, rows: int = 1, columns: int = 1, **how: Any) -> tuple[Figure, NDArray[Any]]:
    """A figure, inches, and its quiet axes (rows, columns).

    Args:
        how: as `Figure.subplots` takes it, such as sharex or height_ratios.
    """
    figure = new_figure(width, height)
    axes = figure.subplots(rows, columns, squeeze=False, **how)
    for panel in axes.flat:
        quiet(panel)
    return figure, axes


def look(k: int, *parts: str) -> dict[str, Any]:
    """How the k-th of several sets is drawn: its colour, and of "linestyle" and "marker" those that are named."""
    own = {"linestyle": DASHES[k % len(DASHES)], "marker": MARKERS[k % len(MARKERS)]}
    return {"color": COLOURS[k % len(COLOURS)], **{part: own[part] for part in parts}}


def quiet(axes: Axes) -> None:
    """Thin grid, no box on the right and above, small tick labels, names of the axes in the size of text."""
    axes.grid(True, color="#e6e6e6", linewidth=0.6)
    axes.set_axisbelow(True)
    axes.spines[["top", "right"]].set_visible(False)
    axes.spines[["left", "bottom"]].set_color("#666666")
    axes.tick_params(labelsize=SMALL, color="#666666", length=3)
    for axis in (axes.xaxis, axes.yaxis):
        axis.label.set_fontsize(TEXT)


def frequency_axis(axes: Axes, low: float, high: float) -> None:
    """Logarithmic, from low to high in Hz, with plain numbers however near the two are."""
    from pysim.present.ticks import round_numbers

    low, high = (low, high) if high > low else (0.9 * low, 1.1 * high)
    axes.set_xscale("log")
    axes.set_xlim(low, high)
    plain_numbers(axes.xaxis, round_numbers(low, high))


def size_axis(axes: Axes) -> None:
    """Logarithmic upwards, with plain numbers however few decades there are."""
    from pysim.present.ticks import Sizes

    axes.set_yscale("log")
    plain_numbers(axes.yaxis, Sizes())


def phase_axis(axes: Axes) -> None:
    """Degrees upwards, read in parts of a turn, and in even steps where only little of one is shown."""
    from pysim.present.ticks import Degrees

    axes.yaxis.set_major_locator(Degrees())


def plain_numbers(axis: Axis, numbers: Locator | Sequence[float]) -> None:
    """These numbers and no other marks, without powers of ten."""
    from matplotlib.ticker import FixedLocator, Locator, NullLocator, StrMethodFormatter

    axis.set_major_locator(numbers if isinstance(numbers, Locator) else FixedLocator(numbers))
    axis.set_minor_locator(NullLocator())
    axis.set_major_formatter(StrMethodFormatter("{x:g}"))


def small_text(axes: Axes, text: str, at: tuple[float, float], away: tuple[float, float], **how: Any) -> None:
    """A word or two beside a place.

    Args:
        at: the place, in the axes' data, or in `xycoords`.
        away: points from there.
        how: as `Axes.annotate` takes it.
    """
    axes.annotate(text, at, xytext=away, textcoords="offset points", fontsize=SMALL, **how)


def legend_above(figure: Figure, handles: Sequence[Artist], labels: Sequence[str]) -> None:
    """One legend for the whole figure, in as few rows above it as its width allows; it grows by those after the first.

    Call it last, with all handles.
    """
    for columns in dict.fromkeys(math.ceil(len(labels) / rows) for rows in range(1, len(labels) + 1)):
        legend = figure.legend(handles, labels, loc="outside upper center", ncols=columns, frameon=False, fontsize=TEXT)
        if columns == 1 or legend.get_window_extent().width <= 0.98 * figure.bbox.width:
            rows = math.ceil(len(labels) / columns)
            figure.set_figheight(figure.get_figheight() + (rows - 1) * _LEGEND_ROW)
            return
        legend.remove()
