"""The best linear approximation with everything that is not linear beside it, on the same decibels."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from pysim.identify.multisine import gain_interval, gain_radius, pooled
from pysim.present.multisine.answer import Approximations
from pysim.present.render import Picture
from pysim.present.style import (
    COLOURS,
    LIMIT,
    MEASURED,
    TEXT,
    frequency_axis,
    legend_above,
    new_figure,
    phase_axis,
    quiet,
)
from pysim.types import BadInput, BestLinearApproximation, Distortion, Level

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from numpy.typing import NDArray

    Array = NDArray[np.float64]

_NOISE, _TOTAL, _EVEN, _ODD = LIMIT, MEASURED, COLOURS[1], COLOURS[0]
_SMOOTH = 6  # free lines in the mean that is drawn through the single ones
_SURE_DEG = 45.0  # phases less sure than this do not widen the axis
_NEARLY_NONE = 0.05
_BELOW_NOISE_DB = 6.0  # how far under the lowest noise the axis reaches


def figures(result: Approximations) -> Iterator[Picture]:
    """One per approximation."""
    for i, (name, bla) in enumerate(result.found, start=1):
        caption = f"{name}: gain with its 95 percent band, and the levels beside it; points are single lines."
        yield Picture(f"multisine_{i}", caption, multisine_figure([bla], [name]))


def multisine_figure(approximations: Sequence[BestLinearApproximation], titles: Sequence[str]) -> Figure:
    """Magnitude and levels (dB) above the phase (deg) over frequency; a column per approximation.

    Points are single lines, curves means over neighbouring ones; a level below what the noise lets see is not drawn.

    Args:
        approximations: at least one.
        titles: as many, what sets the columns apart.
    Raises:
        BadInput: no approximation, or another number of titles.
    """
    if not approximations or len(approximations) != len(titles):
        raise BadInput("multisine figure: give at least one approximation, and a title for each")
    count = len(approximations)
    figure = new_figure(max(8.0, 2.4 + 3.9 * count), 6.4)  # at least as wide as the legend
    axes = figure.subplots(2, count, sharex="col", sharey="row", squeeze=False, height_ratios=(2.2, 1))
    handles: dict[str, Any] = {}
    for column, (bla, title) in enumerate(zip(approximations, titles, strict=True)):
        top, bottom = axes[0, column], axes[1, column]
        quiet(top)
        quiet(bottom)
        _draw_levels(top, bla, handles)
        _draw_gain(top, bottom, bla, handles)
        top.set_title(title, fontsize=TEXT)
        frequency_axis(bottom, bla.frequency[0], bla.frequency[-1])
        bottom.set_xlabel("Frequency (Hz)", fontsize=TEXT)
    unit = _gain_unit(approximations[0])
    axes[0, 0].set_ylabel(f"Gain and levels (dB re 1{unit})", fontsize=TEXT)
    axes[1, 0].set_ylabel("Phase (deg)", fontsize=TEXT)
    phase_axis(axes[1, 0])
    axes[1, 0].set_ylim(*_phase_range(approximations))
    axes[0, 0].set_ylim(bottom=_floor(approximations))
    legend_above(figure, list(handles.values()), list(handles))
    return figure


def _draw_gain(top: Axes, bottom: Axes, bla: BestLinearApproximation, handles: dict[str, Any]) -> None:
    f, radius = bla.frequency, gain_radius(bla)
    size = np.abs(bla.gain)
    low, high = 20 * np.log10(np.maximum(size - radius, 1e-3 * size)), 20 * np.log10(size + radius)
    band = top.fill_between(f, low, high, color=COLOURS[2], alpha=0.3, linewidth=0)
    (line,) = top.plot(f, 20 * np.log10(size), color=COLOURS[2], linewidth=1.8)
    phase, half = _phase(bla)
    bottom.fill_between(f, phase - half, phase + half, color=COLOURS[2], alpha=0.3, linewidth=0)
    bottom.plot(f, phase, color=COLOURS[2], linewidth=1.8)
    handles.setdefault("best linear approximation", line)
    handles.setdefault("95 %", band)


def _phase(bla: BestLinearApproximation) -> tuple[Array, Array]:
    """Continuous phase and the half width of its interval, (n_f,) deg."""
    return np.degrees(np.unwrap(np.angle(bla.gain))), np.degrees(gain_interval(bla)[1])


def _phase_range(approximations: Sequence[BestLinearApproximation]) -> tuple[float, float]:
    """Ends of the phase axis: what is known at all, with its intervals."""
    ends = []
    for bla in approximations:
        phase, half = _phase(bla)
        sure = half < _SURE_DEG if np.any(half < _SURE_DEG) else np.full(half.size, True)
        ends += [float(np.min((phase - half)[sure])), float(np.max((phase + half)[sure]))]
    margin = 0.05 * (max(ends) - min(ends)) + 1.0
    return min(ends) - margin, max(ends) + margin


def _draw_levels(axes: Axes, bla: BestLinearApproximation, handles: dict[str, Any]) -> None:
    if bla.noise is not None:
        (line,) = axes.plot(bla.noise.frequency, _db(bla.noise.variance), color=_NOISE, linewidth=1.2)
        handles.setdefault("noise", line)
    elif bla.total is not None:
        (line,) = axes.plot(bla.total.frequency, _db(bla.total.variance), color=_NOISE, linewidth=1.2)
        handles.setdefault("noise and distortion", line)
    if bla.distortion is not None:
        handles.setdefault("distortion", _curve(axes, bla.distortion, _TOTAL, "-"))
    for name, level, colour, marker in (
        ("even part", bla.even, _EVEN, "s"),
        ("odd part", bla.odd, _ODD, "o"),
    ):
        if level is None:
            continue
        axes.plot(level.frequency, _db(level.variance), color=colour, linestyle="", marker=marker, markersize=2.6)
        f = bla.frequency[(bla.frequency >= level.frequency[0]) & (bla.frequency <= level.frequency[-1])]
        handles.setdefault(name, _curve(axes, _smoothed(level, f), colour, (0, (5, 2))))


def _smoothed(level: Distortion, frequency: Array) -> Level:
    return pooled(level, frequency, _SMOOTH) if frequency.size > 1 else level


def _curve(axes: Axes, level: Level, colour: str, dash: Any) -> Any:
    (line,) = axes.plot(level.frequency, _db(level.variance), color=colour, linewidth=1.4, linestyle=dash)
    return line


def _db(variance: Array) -> Array:
    """10 log10, with gaps where an estimate is below what can be seen."""
    return 10 * np.log10(np.where(variance > 0, variance, np.nan))


def _floor(approximations: Sequence[BestLinearApproximation]) -> float | None:
    """The lower end of the axis: a little under nearly all of the lowest noise."""
    levels = [bla.noise or bla.total for bla in approximations]
    seen = [float(np.nanquantile(_db(level.variance), _NEARLY_NONE)) for level in levels if level is not None]
    return min(seen) - _BELOW_NOISE_DB if seen and np.isfinite(seen).all() else None


def _gain_unit(bla: BestLinearApproximation) -> str:
    one, other = bla.test.output_unit, bla.test.input_unit
    if one == other:
        return ""
    return f" {one}" if other == "1" else f" {one}/{other}"
