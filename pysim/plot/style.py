"""One look for all figures: colours that colour-blind readers can tell apart, quiet axes, legible in print."""

from __future__ import annotations

from collections.abc import Sequence

from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FixedLocator, NullLocator, StrMethodFormatter

MEASURED = "#1a1a1a"
BAND = "#d9d9d9"
LIMIT = "#8c8c8c"
# Okabe and Ito's palette, strongest contrasts first; each set also has a marker and a dash of its own, for grey print
COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9")
MARKERS = ("o", "s", "^", "D", "v", "P")
DASHES = ("-", (0, (5, 2)), (0, (1, 1.4)), (0, (6, 2, 1, 2)), (0, (3, 1)), (0, (8, 3)))
TEXT = 9.0
SMALL = 8.0

_FREQUENCY_TICKS = (0.01, 0.03, 0.1, 0.3, 1, 3, 10, 30, 100, 300)


def new_figure(width: float, height: float) -> Figure:
    """An empty white figure, inches, that fits its own parts; no pyplot, so no global state."""
    return Figure(figsize=(width, height), layout="constrained", facecolor="white")


def quiet(axes: Axes) -> None:
    """Thin grid, no box on the right and above, small tick labels."""
    axes.grid(True, color="#e6e6e6", linewidth=0.6)
    axes.set_axisbelow(True)
    axes.spines[["top", "right"]].set_visible(False)
    axes.spines[["left", "bottom"]].set_color("#666666")
    axes.tick_params(labelsize=SMALL, color="#666666", length=3)


def frequency_axis(axes: Axes, low: float, high: float) -> None:
    """Logarithmic, from low to high in Hz, with plain numbers."""
    axes.set_xscale("log")
    axes.set_xlim(low, high)
    ticks = [tick for tick in _FREQUENCY_TICKS if low * 0.999 <= tick <= high * 1.001]
    axes.xaxis.set_major_locator(FixedLocator(ticks))
    axes.xaxis.set_minor_locator(NullLocator())
    axes.xaxis.set_major_formatter(StrMethodFormatter("{x:g}"))


def legend_above(figure: Figure, handles: Sequence[Artist], labels: Sequence[str]) -> None:
    """One legend for the whole figure, in a row above it."""
    figure.legend(handles, labels, loc="outside upper center", ncols=len(labels), frameon=False, fontsize=TEXT)
