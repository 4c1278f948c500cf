"""Records over time, one above the other."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

from pysim.io import shown_unit
from pysim.present.style import COLOURS, DASHES, MEASURED, legend_above, panels
from pysim.types import BadInput, Record

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def time_response_figure(records: Mapping[str, Record], signals: Sequence[str]) -> Figure:
    """A panel per signal with every record laid over the others, the first one as the reference in black.

    Args:
        records: label -> record; each has all signals.
        signals: names, from top to bottom; pressures are drawn in bar, lengths in mm, angles in degrees,
            speeds in rpm or mm/s.
    Raises:
        BadInput: no record, no signal, or a record without one of them.
    """
    if not records or not signals:
        raise BadInput("time response figure: needs at least one record and one signal")
    figure, grid = panels(8.0, 0.9 + 1.7 * len(signals), len(signals), sharex=True)
    axes, handles = grid[:, 0], []
    for i, record in enumerate(records.values()):
        colour = MEASURED if i == 0 else COLOURS[(i - 1) % len(COLOURS)]
        for panel, name in zip(axes, signals, strict=True):
            unit, factor = shown_unit(record.units[record.names.index(name)] if name in record.names else "1")
            dash = "-" if i == 0 else DASHES[i % len(DASHES)]
            (line,) = panel.plot(record.time, factor * record[name], color=colour, linestyle=dash, linewidth=1.3)
            panel.set_ylabel(f"{name} ({unit})")
        handles.append(line)
    axes[-1].set_xlabel("Time (s)")
    legend_above(figure, handles, list(records))
    return figure
