"""Tuned loops as text, as data and as a page."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from pysim.control.tuning import Gains
from pysim.io import json_number
from pysim.present.page import cell, commands, heading, items, page, picture, table

_METHOD = (
    "The controller is K_p (1 + 1/(T_i s)), thesis Eq. 5.32. Phase margin and crossover fix both of its numbers.",
    "Margins count the plant's dead time, if it was given one; the steps over time are the sampled controller's.",
    "The maximum of sensitivity tells how much the loop amplifies a disturbance at the worst frequency; 1.5 to 2 is "
    "usual.",
)
_HEAD = ("K_p", "T_i (s)", "K_p/T_i", "crossover (Hz)", "phase margin (deg)", "gain margin (dB)", "delay (s)", "M_s")
_SHORT = ("K_p", "T_i (s)", "K_p/T_i", "cross (Hz)", "phase (deg)", "gain (dB)", "delay (s)", "M_s")  # of a terminal


def tuning_text(loops: Mapping[str, Gains]) -> str:
    """A row per loop: gains, crossover, phase, gain and delay margin, largest sensitivity."""
    rows = [["", *_SHORT], *([label, *_cells(gains)] for label, gains in loops.items())]
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    ends = ["stable", *("yes" if gains.loop.stable else "NO" for gains in loops.values())]
    lines = []
    for (label, *cells), end in zip(rows, ends, strict=True):
        numbers = "".join(f"  {text:>{width}}" for text, width in zip(cells, widths[1:], strict=True))
        lines.append(f"{label:<{widths[0]}}{numbers}  {end}")
    return "\n".join(lines)


def tuning_data(loops: Mapping[str, Gains]) -> dict[str, Any]:
    """Everything, frequencies in Hz, margins in degrees and dB; null where there is none."""
    return {label: _data(gains) for label, gains in loops.items()}


def tuning_page(loops: Mapping[str, Gains], *, pictures: Mapping[str, bytes], redo: str) -> str:
    """A self-contained HTML page; redo is the command line that makes it again."""
    first = next(iter(loops.values()))
    rows = [
        [cell(label, "words"), *(cell(x) for x in _cells(g)), cell("yes" if g.loop.stable else "no")]
        for label, g in loops.items()
    ]
    parts = [heading("How it was done"), items(_METHOD), heading("Loops")]
    parts += [picture(svg, caption) for caption, svg in pictures.items()]
    parts += [table("Gains and margins", ["", *_HEAD, "stable"], rows), heading("Do it again"), commands(redo)]
    return page("Tuning of a PI controller", f"Plant: {first.plant.name}.", parts)


def _cells(gains: Gains) -> list[str]:
    loop = gains.loop
    margin = 20 * math.log10(loop.gain_margin) if 0 < loop.gain_margin < math.inf else math.inf
    return [
        f"{gains.K_p:.4g}",
        f"{gains.T_i:.4g}",
        f"{gains.integral:.4g}",
        f"{loop.crossover / (2 * math.pi):.4g}",
        f"{math.degrees(loop.phase_margin):.2f}",
        f"{margin:.1f}",
        f"{loop.delay_margin:.3g}",
        f"{loop.peak_sensitivity:.2f}",
    ]


def _data(gains: Gains) -> dict[str, Any]:
    loop = gains.loop
    return {
        "plant": gains.plant.name,
        "K_p": gains.K_p,
        "T_i": gains.T_i,
        "crossover_hz": json_number(loop.crossover / (2 * math.pi)),
        "phase_margin_deg": json_number(math.degrees(loop.phase_margin)),
        "gain_margin_db": json_number(20 * math.log10(loop.gain_margin)),
        "delay_margin_s": json_number(loop.delay_margin),
        "peak_sensitivity": loop.peak_sensitivity,
        "bandwidth_hz": json_number(loop.bandwidth / (2 * math.pi)),
        "stable": loop.stable,
    }
