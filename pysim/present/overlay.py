"""One log beside several models: measured and simulated, and what each model leaves."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

import numpy as np

from pysim.identify import HALF_95
from pysim.io import shown_unit
from pysim.present.style import BAND, COLOURS, DASHES, MEASURED, SMALL, TEXT, legend_above, new_figure, quiet
from pysim.types import BadInput, RecordFit
from pysim.types.answer import Failure

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from matplotlib.lines import Line2D

_WORST = 12  # regions that are drawn


def logs_figure(beside: Mapping[str, RecordFit]) -> Figure:
    """A column a signal: measured and simulated above, the residuals in standard deviations of the noise below.

    The legend tells each model's fit in percent, 100 (1 - |measured - simulated| / |measured - its mean|), signal by
    signal; grey holds 95 percent of noise.

    Args:
        beside: name of a model -> the same log beside it.
    Raises:
        BadInput: no model.
    """
    if not beside:
        raise BadInput("overlay: name at least one model")
    first = next(iter(beside.values()))
    names = first.measured.names
    figure = new_figure(1.2 + 4.6 * max(len(names), 1.4), 4.8)
    axes = figure.subplots(2, len(names), sharex=True, squeeze=False, height_ratios=(3, 2))
    handles, labels = [], []
    for j, name in enumerate(names):
        unit, factor = shown_unit(first.measured.units[j])
        top, low = axes[0, j], axes[1, j]
        (dots,) = top.plot(
            first.measured.time, factor * first.measured.values[:, j], ".", color=MEASURED, markersize=2.4,
            rasterized=True,
        )  # fmt: skip
        lines = [_model(top, low, record, j, factor, k) for k, record in enumerate(beside.values())]
        low.axhspan(-HALF_95, HALF_95, color=BAND, linewidth=0, zorder=0)
        top.set_ylabel(f"{name} ({unit})", fontsize=TEXT)
        low.set_ylabel("Residual over noise (-)", fontsize=TEXT)
        low.set_xlabel("Time (s)", fontsize=TEXT)
        quiet(top)
        quiet(low)
        if j == 0:
            handles, labels = [dots, *lines], ["measured", *(f"{n}: {_percent(r)}" for n, r in beside.items())]
    legend_above(figure, handles, labels)
    return figure


def _model(top: Axes, low: Axes, record: RecordFit, j: int, factor: float, k: int) -> Line2D:
    colour, dash = COLOURS[k % len(COLOURS)], DASHES[k % len(DASHES)]
    (line,) = top.plot(
        record.simulated.time, factor * record.simulated.values[:, j], color=colour, linestyle=dash, linewidth=1.5
    )
    low.plot(record.residual.time, record.residual.values[:, j], color=colour, linewidth=0.9, alpha=0.8)
    return line


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
    rows = list(failures[:_WORST])
    figure = new_figure(7.4, 0.9 + 0.27 * len(rows))
    axes = figure.subplots()
    places = np.arange(len(rows))
    axes.barh(places, [one.error for one in rows], color=COLOURS[0], height=0.7)
    axes.axvline(1.0, color=MEASURED, linewidth=0.9)
    axes.set_yticks(places, [f"{one.record}, {one.signal}: {one.region}" for one in rows], fontsize=SMALL)
    axes.invert_yaxis()
    axes.set_xlabel("Residual over noise (1: noise alone)", fontsize=TEXT)
    quiet(axes)
    return figure
