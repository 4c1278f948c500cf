"""Numbers on axes by which a reader finds values: parts of a decade, parts of a turn, even steps."""

from __future__ import annotations

import math

from matplotlib.ticker import Locator, MaxNLocator

_FEWEST = 3  # numbers on an axis, that it can be read
_EVEN = (1, 2, 2.5, 5, 10)  # steps where no round numbers of a decade, or parts of a turn, fit
_PARTS_DEG = (360.0, 180.0, 90.0, 45.0, 30.0, 15.0)  # of a turn
_MOST_DECADES = 3.6  # with more than the powers of ten


class _Ticks(Locator):
    """Numbers that follow the limits of their axis."""

    def __call__(self) -> list[float]:
        assert self.axis is not None
        return self.tick_values(*self.axis.get_view_interval())

    def tick_values(self, vmin: float, vmax: float) -> list[float]:
        raise NotImplementedError


class Sizes(_Ticks):
    """1, 2 and 5 of each decade; fewer where there are many decades."""

    def tick_values(self, vmin: float, vmax: float) -> list[float]:
        low, high = sorted((max(vmin, 1e-300), max(vmax, 1e-300)))
        return round_numbers(low, high, dense=2.2)


class Degrees(_Ticks):
    """The largest part of a turn that leaves enough numbers."""

    def tick_values(self, vmin: float, vmax: float) -> list[float]:
        low, high = sorted((vmin, vmax))
        part = next((part for part in _PARTS_DEG if high - low >= _FEWEST * part), None)
        if part is None:
            return _even_numbers(low, high)
        part *= max(1, round((high - low) / part / 6))
        return [part * k for k in range(math.ceil(low / part), math.floor(high / part) + 1)]


def round_numbers(low: float, high: float, dense: float = 0.0) -> list[float]:
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
