"""One look for all figures: colours that colour-blind readers can tell apart, quiet axes, legible in print."""

from __future__ import annotations

import math
from collections.abc import Sequence

from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FixedLocator, Locator, MaxNLocator, NullLocator, StrMethodFormatter

MEASURED = "#1a1a1a"
BAND = "#d9d9d9"
LIMIT = "#8c8c8c"
# Okabe and Ito's palette, strongest contrasts first; each set also has a marker and a dash of its own, for grey print
COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9")
MARKERS = ("o", "s", "^", "D", "v", "P")
DASHES = ("-", (0, (5, 2)), (0, (1, 1.4)), (0, (6, 2, 1, 2)), (0, (3, 1)), (0, (8, 3)))
TEXT = 9.0
SMALL = 8.0

_FEWEST = 3  # numbers on an axis, that it can be read
_EVEN = (1, 2, 2.5, 5, 10)  # steps where no round numbers of a decade, or parts of a turn, fit
_PARTS_DEG = (360.0, 180.0, 90.0, 45.0, 30.0, 15.0)  # of a turn
_MOST_DECADES = 3.6  # with more than the powers of ten
_LEGEND_ROW = 0.19  # in


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
    """Logarithmic, from low to high in Hz, with plain numbers however near the two are."""
    low, high = (low, high) if high > low else (0.9 * low, 1.1 * high)
    axes.set_xscale("log")
    axes.set_xlim(low, high)
    axes.xaxis.set_major_locator(FixedLocator(_round_numbers(low, high)))
    axes.xaxis.set_minor_locator(NullLocator())
    axes.xaxis.set_major_formatter(StrMethodFormatter("{x:g}"))


def size_axis(axes: Axes) -> None:
    """Logarithmic upwards, with plain numbers however few decades there are."""
    axes.set_yscale("log")
    axes.yaxis.set_major_locator(_Sizes())
    axes.yaxis.set_minor_locator(NullLocator())
    axes.yaxis.set_major_formatter(StrMethodFormatter("{x:g}"))


def phase_axis(axes: Axes) -> None:
    """Degrees upwards, read in parts of a turn, and in even steps where only little of one is shown."""
    axes.yaxis.set_major_locator(_Degrees())


class _Ticks(Locator):
    """Numbers that follow the limits of their axis."""

    def __call__(self) -> list[float]:
        assert self.axis is not None
        return self.tick_values(*self.axis.get_view_interval())

    def tick_values(self, vmin: float, vmax: float) -> list[float]:
        raise NotImplementedError


class _Sizes(_Ticks):
    """1, 2 and 5 of each decade; fewer where there are many decades."""

    def tick_values(self, vmin: float, vmax: float) -> list[float]:
        low, high = sorted((max(vmin, 1e-300), max(vmax, 1e-300)))
        return _round_numbers(low, high, dense=2.2)


class _Degrees(_Ticks):
    """The largest part of a turn that leaves enough numbers."""

    def tick_values(self, vmin: float, vmax: float) -> list[float]:
        low, high = sorted((vmin, vmax))
        part = next((part for part in _PARTS_DEG if high - low >= _FEWEST * part), None)
        if part is None:
            return _even_numbers(low, high)
        part *= max(1, round((high - low) / part / 6))
        return [part * k for k in range(math.ceil(low / part), math.floor(high / part) + 1)]


def _round_numbers(low: float, high: float, dense: float = 0.0) -> list[float]:
    """What a logarithmic axis is read by: 1 and 3 of each decade, with 1, 2 and 5 where these are too few, powers of
    ten where there are many decades, even steps where no round number would do.

    Args:
        dense: decades below which 1, 2 and 5 are taken at once.
    """
    decades = math.log10(high / low)
    first, last, step = math.floor(math.log10(low)), math.ceil(math.log10(high)), max(1, round(decades / 6))
    tried: tuple[tuple[int, ...], ...] = ((1, 3), (1, 2, 5))
    if decades < dense or decades >= _MOST_DECADES:
        tried = ((1, 2, 5),) if decades < dense else ((1,),)
    for parts in tried:
        ticks = [part * 10.0**power for power in range(first, last + 1) for part in parts if power % step == 0]
        inside = [tick for tick in ticks if low * 0.999 <= tick <= high * 1.001]
        if len(inside) >= _FEWEST:
            return inside
    return _even_numbers(low, high)


def _even_numbers(low: float, high: float) -> list[float]:
    ticks = MaxNLocator(6, steps=_EVEN, min_n_ticks=_FEWEST).tick_values(low, high)
    return [float(tick) for tick in ticks if low <= tick <= high]


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
