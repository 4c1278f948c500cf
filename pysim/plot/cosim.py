"""What a co-simulation recorded: a panel per unit, signals of one unit together."""

from __future__ import annotations

from collections.abc import Sequence

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from pysim.io import shown_unit
from pysim.present.style import COLOURS, DASHES, SMALL, TEXT, new_figure, quiet
from pysim.types import BadInput, Record

_MOST = len(COLOURS)  # lines of a panel; more cannot be told apart
_LABELS = 40  # characters of a name in a legend


def cosim_figure(record: Record) -> Figure:
    """Every signal of a record over time; pressures in bar, lengths in mm, angles in degrees, speeds in rpm.

    Raises:
        BadInput: a record without rows.
    """
    if record.time.size == 0:
        raise BadInput("co-simulation figure: the record has no rows; nothing can be drawn")
    panels = _panels(record)
    figure = new_figure(8.0, 0.7 + 1.75 * len(panels))
    axes = figure.subplots(len(panels), 1, sharex=True, squeeze=False)[:, 0]
    for axis, (unit, names) in zip(axes, panels, strict=True):
        _draw(axis, record, unit, names)
    axes[-1].set_xlabel("Time (s)", fontsize=TEXT)
    return figure


def _panels(record: Record) -> list[tuple[str, Sequence[str]]]:
    """Unit and names of each panel, in the order of the record."""
    by_unit: dict[str, list[str]] = {}
    for name, unit in zip(record.names, record.units, strict=True):
        by_unit.setdefault(unit, []).append(name)
    return [
        (unit, names[first : first + _MOST]) for unit, names in by_unit.items() for first in range(0, len(names), _MOST)
    ]


def _draw(axis: Axes, record: Record, unit: str, names: Sequence[str]) -> None:
    shown, factor = shown_unit(unit)
    for i, name in enumerate(names):
        label = name if len(name) <= _LABELS else f"…{name[1 - _LABELS :]}"
        axis.plot(record.time, factor * record[name], color=COLOURS[i], linestyle=DASHES[i], linewidth=1.3, label=label)
    axis.set_ylabel(names[0] + f" ({shown})" if len(names) == 1 and len(names[0]) < 20 else f"({shown})", fontsize=TEXT)
    if len(names) > 1 or len(names[0]) >= 20:
        axis.legend(loc="center left", bbox_to_anchor=(1.01, 0.5), frameon=False, fontsize=SMALL)
    quiet(axis)
    axis.margins(x=0)
