"""A log beside models: measured and simulated, and below it what each model leaves; and where a model fails."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from pysim.identify import HALF_95
from pysim.io import shown_unit
from pysim.present import style
from pysim.types import BadInput, RecordFit
from pysim.types.answer import Failure

if TYPE_CHECKING:
    from matplotlib.artist import Artist
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_MANY = 5000  # samples beyond which lines are drawn as pixels
_SMOOTH = 5  # samples of the running mean that shows what of a residual is more than noise
_COARSE = 100  # samples up to which a residual needs no running mean
_WORST = 12  # regions that are drawn


class Side(NamedTuple):
    """A model beside a log: its name, words for the legend, and the colour and dash of its lines."""

    name: str
    words: str
    record: RecordFit
    look: Mapping[str, Any]


def logs_figure(beside: Mapping[str, RecordFit]) -> Figure:
    """One log beside some models.

    The legend tells each model's fit in percent, 100 (1 - |measured - simulated| / |measured - its mean|), signal by
    signal.

    Args:
        beside: name of a model -> the same log beside it.
    Raises:
        BadInput: no model.
    """
    if not beside:
        raise BadInput("overlay: name at least one model")
    named = enumerate(beside.items())
    return beside_figure([Side(n, f"{n}: {_percent(r)}", r, style.look(k, "linestyle")) for k, (n, r) in named])


def beside_figure(sides: Sequence[Side], part: slice = slice(None), *, hidden: Sequence[str] = ()) -> Figure:
    """A column a signal: measured and simulated above, the residuals in standard deviations of the noise below.

    Of many samples running means are drawn as well; grey holds 95 percent of noise alone.

    Args:
        sides: at least one, of the same log.
        part: samples that are shown.
        hidden: names of models whose residual is not drawn.
    """
    names = sides[0].record.measured.names
    width = 1.2 + 4.6 * max(len(names), 1.4)
    figure, axes = style.panels(width, 4.8, 2, len(names), sharex=True, height_ratios=(3, 2))
    for j in range(len(names)):
        handles = _signal(axes[0, j], sides, j, part)
        _residual(axes[1, j], [one for one in sides if one.name not in hidden], j, part)
    style.legend_above(figure, handles, ["measured", *(one.words for one in sides)])
    return figure


def _signal(axes: Axes, sides: Sequence[Side], j: int, part: slice) -> list[Artist]:
    measured = sides[0].record.measured
    time, (unit, factor) = measured.time[part], shown_unit(measured.units[j])
    dots: dict[str, Any] = {"color": style.MEASURED, "markersize": 2.4, "rasterized": True}
    handles: list[Artist] = [*axes.plot(time, factor * measured.values[part, j], ".", **dots)]
    for one in sides:
        simulated = one.record.simulated
        more = {**one.look, "linewidth": 1.5, "rasterized": time.size > _MANY}
        handles += axes.plot(simulated.time[part], factor * simulated.values[part, j], **more)
    axes.set_ylabel(f"{measured.names[j]} ({unit})")
    return handles


def _residual(axes: Axes, sides: Sequence[Side], j: int, part: slice) -> None:
    axes.axhspan(-HALF_95, HALF_95, color=style.BAND, linewidth=0)
    words = []
    for one in sides:
        residual, colour = one.record.residual, one.look["color"]
        time, values = residual.time[part], residual.values[part, j]
        look = {"color": colour, "linewidth": 1.4, "rasterized": time.size > _MANY}
        if values.size > _COARSE:
            axes.plot(time, values, ".", color=colour, markersize=1.6, alpha=0.5, rasterized=True)
            values = np.convolve(values, np.ones(_SMOOTH) / _SMOOTH, mode="valid")
            time = time[_SMOOTH // 2 : _SMOOTH // 2 + values.size]
        axes.plot(time, values, **look)
        words.append(f"{one.name} {math.sqrt(float(np.mean(residual.values[:, j] ** 2))):.2f}")
    axes.set_title(f"rms of the whole record: {', '.join(words)}", fontsize=style.SMALL, loc="left", color="#444444")
    axes.set(xlabel="Time (s)", ylabel="Residual over noise (-)")


def _percent(record: RecordFit) -> str:
    fits = record.fit_percent
    if len(fits) == 1:
        return f"fit {next(iter(fits.values())):.1f} %"
    return "fit " + ", ".join(f"{name} {value:.1f} %" for name, value in fits.items())


def regions_figure(failures: Sequence[Failure]) -> Figure:
    """Where a model fails, the worst regions above, with their residual in standard deviations of the noise.

    Raises:
        BadInput: no log was compared.
    """
    if not failures:
        raise BadInput("regions: no log over time was compared, so there is nothing to draw")
    rows = failures[:_WORST]
    figure, ((axes,),) = style.panels(7.4, 0.9 + 0.27 * len(rows))
    axes.barh(range(len(rows)), [one.error for one in rows], color=style.COLOURS[0], height=0.7)
    axes.axvline(1.0, color=style.MEASURED, linewidth=0.9)
    names = [f"{one.record}, {one.signal}: {one.region}" for one in rows]
    axes.set_yticks(range(len(rows)), names, fontsize=style.SMALL)
    axes.invert_yaxis()
    axes.set_xlabel("Residual over noise (1: noise alone)")
    return figure
