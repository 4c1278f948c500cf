"""A co-simulation: for a terminal, for JSON and for the page."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from pysim.present.page import cell, commands, heading, page, paragraph, picture, table
from pysim.types import Outcome, Record

# Name, what it is, inputs and outputs of a member; source, target, factor and offset of a connection.
Parts = Sequence[tuple[str, str, int, int]]
Wires = Sequence[tuple[str, str, float, float]]


def cosim_text(name: str, record: Record, seconds: float) -> str:
    """How the run went, and where each signal went.

    Args:
        seconds: that it took.
    """
    lines = [_how(name, record, seconds)]
    width = max(map(len, record.names), default=0)
    for signal, unit, (low, high, last) in zip(record.names, record.units, _ranges(record), strict=True):
        lines.append(
            f"  {signal:<{width}}  {low:12.5g} ... {high:<12.5g} at the end {last:.5g} {unit.removeprefix('1')}"
        )
    return "\n".join(line.rstrip() for line in lines)


def cosim_data(name: str, record: Record, seconds: float) -> dict[str, Any]:
    """What the run came to, for JSON; SI units or %."""
    signals = [
        {"name": signal, "unit": unit, "low": low, "high": high, "end": last}
        for signal, unit, (low, high, last) in zip(record.names, record.units, _ranges(record), strict=True)
    ]
    return {
        "name": name,
        "outcome": record.outcome.name.lower(),
        "message": record.message,
        "rows": int(record.time.size),
        "end_s": float(record.time[-1]) if record.time.size else None,
        "took_s": seconds,
        "statistics": dict(record.statistics),
        "signals": signals,
    }


def cosim_page(
    name: str,
    record: Record,
    seconds: float,
    *,
    parts: Parts,
    wires: Wires,
    pictures: Mapping[str, bytes],
    redo: str,
) -> str:
    """A self-contained HTML page.

    Args:
        pictures: caption -> SVG.
        redo: the command line that makes this page again.
    """
    body = [heading("Verdict"), paragraph(_how(name, record, seconds), note=record.outcome is not Outcome.DONE)]
    body += [heading("Pictures"), *(picture(svg, caption) for caption, svg in pictures.items())]
    rows = [
        [cell(signal, "words"), cell(unit, "words"), *(cell(f"{value:.5g}") for value in values)]
        for signal, unit, values in zip(record.names, record.units, _ranges(record), strict=True)
    ]
    body += [heading("Signals"), table("In SI units or %", ["", "unit", "lowest", "highest", "at the end"], rows)]
    rows = [[cell(n, "words"), cell(what, "words"), cell(str(i)), cell(str(o))] for n, what, i, o in parts]
    body += [heading("Members"), table("What the system is made of", ["", "", "inputs", "outputs"], rows)]
    if wires:
        body += [heading("Connections"), _wiring(wires)]
    body += [heading("Do it again"), commands(redo)]
    return page(f"Co-simulation {name}", "Members stepped side by side and wired at communication points.", body)


def _wiring(wires: Wires) -> str:
    """The connections, with a column of offsets where there are any."""
    law, head, last = "input = factor * output", ["from", "to", "factor"], 3
    if any(offset for *_, offset in wires):
        law, head, last = f"{law} + offset", [*head, "offset"], 4
    rows = [[cell(w[0], "words"), cell(w[1], "words"), *(cell(f"{number:.9g}") for number in w[2:last])] for w in wires]
    return table(law, head, rows)


def _how(name: str, record: Record, seconds: float) -> str:
    reached = f"{record.time[-1]:g} s" if record.time.size else "nothing"
    counts = ", ".join(f"{count} {what}" for what, count in record.statistics.items() if count)
    if record.outcome is not Outcome.DONE:
        return f"{name} stopped: {record.message}; recorded up to {reached}."
    pace = f", {(record.time[-1] - record.time[0]) / seconds:.3g} times as fast as real time" if seconds > 0 else ""
    return f"{name}: {reached} simulated in {seconds:.3g} s{pace} ({counts or 'no steps'})."


def _ranges(record: Record) -> list[tuple[float, float, float]]:
    """Lowest, highest and last value of each signal."""
    if record.time.size == 0:
        return [(0.0, 0.0, 0.0)] * len(record.names)
    low, high = np.min(record.values, axis=0), np.max(record.values, axis=0)
    return list(zip(low.tolist(), high.tolist(), record.values[-1].tolist(), strict=True))
