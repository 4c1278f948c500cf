"""What logs over time leave over, by frequency: noise alone is flat at one."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
from scipy.special import chdtri

from pysim.identify.residual_spectrum import FEWEST, residual_spectrum
from pysim.present import style
from pysim.present.diagnosis.figures.records import same_record, steps_compared
from pysim.types import BadInput, Diagnosis, RecordFit

if TYPE_CHECKING:
    from matplotlib.artist import Artist
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from numpy.typing import NDArray

    Array = NDArray[np.float64]

_MANY = 3  # logs shown


def spectrum_figure(diagnosis: Diagnosis) -> Figure:
    """A panel per log and signal: power of the residual over frequency, of the refitted and the final model.

    The grey band holds 95 percent of what white noise of the stated size gives.

    Raises:
        BadInput: no log over time but stepped sines.
    """
    shown = steps_compared(diagnosis)
    panels = [
        (record, j)
        for record in ([] if not shown else shown[0][1].records)
        if not record.harmonics and record.residual.time.size >= FEWEST
        for j in range(len(record.measured.names))
    ][: 2 * _MANY]
    if not panels:
        raise BadInput("spectrum figure: no log over time but stepped sines was compared")
    columns = min(2, len(panels))
    rows = -(-len(panels) // columns)
    figure, axes = style.panels(8.2, 0.5 + 2.2 * rows, rows, columns, sharey=True)
    handles: dict[str, Artist] = {}
    for own, (record, j) in zip(axes.ravel(), panels, strict=False):
        for (name, step, colour), dash in zip(
            shown, reversed(style.DASHES[: len(shown)]), strict=True
        ):  # the last: solid
            one = same_record(record, step)
            if one is not None:
                handles[name] = _draw(own, one, j, {"color": colour, "linestyle": dash})
        own.set_title(f"{record.source}: {record.measured.names[j]}", fontsize=style.SMALL, loc="left")
    for own in axes.ravel()[len(panels) :]:
        own.set_visible(False)
    for own in axes[:, 0]:
        own.set_ylabel("Residual power over noise (-)")
    for own in axes.ravel()[max(0, len(panels) - columns) : len(panels)]:
        own.set_xlabel("Frequency (Hz)")
    style.legend_above(figure, list(handles.values()), list(handles))
    return figure


def _draw(axes: Axes, record: RecordFit, column: int, look: Mapping[str, Any]) -> Artist:
    residual = record.residual
    frequency, power, freedom = residual_spectrum(residual.time, residual.values[:, column])
    if not axes.lines:
        style.size_axis(axes)
        low, high = chdtri(freedom, [0.975, 0.025]) / freedom
        axes.axhspan(low, high, color=style.BAND, alpha=0.6, linewidth=0, zorder=0)
        axes.axhline(1.0, color=style.LIMIT, linewidth=0.8, zorder=1)
        style.frequency_axis(axes, float(frequency[0]), float(frequency[-1]))
    (line,) = axes.plot(frequency, power, **look, linewidth=1.2, zorder=3 if look["color"] == style.COLOURS[0] else 2)
    return line
