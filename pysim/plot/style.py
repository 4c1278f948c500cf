"""One look for all figures: colours that colour-blind readers can tell apart, quiet axes, legible in print."""

from __future__ import annotations

import math
from collections.abc import Sequence

from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FixedLocator, Locator, NullLocator, StrMethodFormatter

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


def size_axis(axes: Axes) -> None:
    """Logarithmic upwards, with plain numbers however few decades there are."""
    axes.set_yscale("log")
    axes.yaxis.set_major_locator(_Sizes())
    axes.yaxis.set_minor_locator(NullLocator())
    axes.yaxis.set_major_formatter(StrMethodFormatter("{x:g}"))


class _Sizes(Locator):
    """1, 2 and 5 of each decade; fewer where there are many decades."""

    def __call__(self) -> list[float]:
        assert self.axis is not None
        return self.tick_values(*self.axis.get_view_interval())

    def tick_values(self, vmin: float, vmax: float) -> list[float]:
        low, high = sorted((max(vmin, 1e-300), max(vmax, 1e-300)))
        decades = math.log10(high / low)
        first, last = math.floor(math.log10(low)), math.ceil(math.log10(high))
        step = max(1, round(decades / 6))
        parts = (1, 2, 5) if decades < 2.2 else (1, 3) if decades < 3.6 else (1,)
        ticks = [part * 10.0**power for power in range(first, last + 1) for part in parts if power % step == 0]
        return [tick for tick in ticks if low * 0.999 <= tick <= high * 1.001]


def legend_above(figure: Figure, handles: Sequence[Artist], labels: Sequence[str]) -> None:
    """One legend for the whole figure, in a row above it."""
    figure.legend(handles, labels, loc="outside upper center", ncols=len(labels), frameon=False, fontsize=TEXT)
