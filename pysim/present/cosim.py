"""A co-simulation, shown: text, JSON, figure and page."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from pysim.io import record_text, shown_unit
from pysim.present.page import heading, paragraph, pictures, table
from pysim.present.page import page as whole_page
from pysim.present.render import Drawing, Picture
from pysim.present.style import COLOURS, SMALL, look, panels
from pysim.types import BadInput, Outcome, Record

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

Parts = Sequence[tuple[str, str, int, int]]  # name, what it is, inputs and outputs of a member
Wires = Sequence[tuple[str, str, float, float]]  # source, target, factor and offset of a connection

_MOST = len(COLOURS)  # lines of a panel; more cannot be told apart
_LABELS = 40  # characters of a name in a legend


@dataclass(frozen=True)
class CoSimulation:
    """A run of a system.

    Args:
        name: of the system.
        seconds: that the run took.
        parts: members of the system.
        wires: its connections.
    """

    name: str
    record: Record
    seconds: float
    parts: Parts = ()
    wires: Wires = ()


def text(result: CoSimulation) -> str:
    """How the run went, and where each signal went."""
    lines = [_how(result)]
    width = max(map(len, result.record.names), default=0)
    for signal, unit, (low, high, last) in _signals(result.record):
        words = "" if unit == "1" else unit
        lines.append(f"  {signal:<{width}}  {low:12.5g} ... {high:<12.5g} at the end {last:.5g} {words}")
    return "\n".join(line.rstrip() for line in lines)


def data(result: CoSimulation) -> dict[str, Any]:
    """What the run came to; SI units or %."""
    signals = [
        {"name": signal, "unit": unit, "low": low, "high": high, "end": last}
        for signal, unit, (low, high, last) in _signals(result.record)
    ]
    return {
        "name": result.name,
        "outcome": result.record.outcome.name.lower(),
        "message": result.record.message,
        "rows": int(result.record.time.size),
        "end_s": float(result.record.time[-1]) if result.record.time.size else None,
        "took_s": result.seconds,
        "statistics": dict(result.record.statistics),
        "signals": signals,
    }


def figures(result: CoSimulation) -> Iterator[Picture]:
    """All signals in one; none where nothing was recorded."""
    if result.record.time.size:
        yield Picture("cosim", "Everything that was recorded, by unit.", cosim_figure(result.record))


def page(result: CoSimulation, drawings: Sequence[Drawing], redo: str) -> str:
    """How the run went, the picture, signals, members and connections."""
    body = [heading("Verdict"), paragraph(_how(result), note=result.record.outcome is not Outcome.DONE)]
    if drawings:
        body += [heading("Pictures"), *pictures(drawings)]
    rows = [[signal, unit, *(f"{value:.5g}" for value in values)] for signal, unit, values in _signals(result.record)]
    head = ["", "unit", "lowest", "highest", "at the end"]
    body += [heading("Signals"), table("In SI units or %", head, rows, words=[0, 1])]
    rows = [[name, what, str(ins), str(outs)] for name, what, ins, outs in result.parts]
    head = ["", "", "inputs", "outputs"]
    body += [heading("Members"), table("What the system is made of", head, rows, words=[0, 1])]
    if result.wires:
        body += [heading("Connections"), _wiring(result.wires)]
    lead = "Members stepped side by side and wired at communication points."
    return whole_page(f"Co-simulation {result.name}", lead, body, redo)


def files(result: CoSimulation) -> dict[str, str]:
    """The record, where anything was recorded."""
    return {"record.csv": record_text(result.record)} if result.record.time.size else {}


def _wiring(wires: Wires) -> str:
    """The connections, with a column of offsets where there are any."""
    law, head, last = "input = factor * output", ["from", "to", "factor"], 3
    if any(offset for *_, offset in wires):
        law, head, last = f"{law} + offset", [*head, "offset"], 4
    rows = [[*wire[:2], *(f"{number:.9g}" for number in wire[2:last])] for wire in wires]
    return table(law, head, rows, words=[0, 1])


def _how(result: CoSimulation) -> str:
    name, record, seconds = result.name, result.record, result.seconds
    reached = f"{record.time[-1]:g} s" if record.time.size else "nothing"
    counts = ", ".join(f"{count} {what}" for what, count in record.statistics.items() if count)
    if record.outcome is not Outcome.DONE:
        return f"{name} stopped: {record.message}; recorded up to {reached}."
    pace = f", {(record.time[-1] - record.time[0]) / seconds:.3g} times as fast as real time" if seconds > 0 else ""
    return f"{name}: {reached} simulated in {seconds:.3g} s{pace} ({counts or 'no steps'})."


def _signals(record: Record) -> list[tuple[str, str, tuple[float, float, float]]]:
    """Name and unit of each signal, with its lowest, highest and last value."""
    ends = [(0.0, 0.0, 0.0)] * len(record.names)
    if record.time.size:
        low, high = np.min(record.values, axis=0), np.max(record.values, axis=0)
        ends = list(zip(low.tolist(), high.tolist(), record.values[-1].tolist(), strict=True))
    return list(zip(record.names, record.units, ends, strict=True))


def cosim_figure(record: Record) -> Figure:
    """Every signal of a record over time; pressures in bar, lengths in mm, angles in degrees, speeds in rpm.

    Raises:
        BadInput: a record without rows.
    """
    if record.time.size == 0:
        raise BadInput("co-simulation figure: the record has no rows; nothing can be drawn")
    shown = _shown(record)
    figure, axes = panels(8.0, 0.7 + 1.75 * len(shown), len(shown), sharex=True)
    for axis, (unit, names) in zip(axes[:, 0], shown, strict=True):
        _draw(axis, record, unit, names)
    axes[-1, 0].set_xlabel("Time (s)")
    return figure


def _shown(record: Record) -> list[tuple[str, Sequence[str]]]:
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
        axis.plot(record.time, factor * record[name], **look(i, "linestyle"), linewidth=1.3, label=label)
    axis.set_ylabel(names[0] + f" ({shown})" if len(names) == 1 and len(names[0]) < 20 else f"({shown})")
    if len(names) > 1 or len(names[0]) >= 20:
        axis.legend(loc="center left", bbox_to_anchor=(1.01, 0.5), frameon=False, fontsize=SMALL)
    axis.margins(x=0)
