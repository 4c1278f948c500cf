"""Ripple flow at both ports, over the number of pistons, and simplified (Figures 3.9, 3.10 and 3.11)."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from pysim.present.style import COLOURS, DASHES, SMALL, TEXT, new_figure, quiet
from validation.findings import Finding
from validation.pump_flow.case import turned
from validation.pump_flow.kinematics import LITRES, SPEED, Geometry
from validation.thesis.numbers import published

Array = NDArray[np.float64]
PISTONS = tuple(range(5, 16))


def notes() -> Sequence[str]:
    """What the printed numbers do not agree on."""
    return (
        "2.063 l/min (Eq. 3.52) is not 0.0198 of the mean, which Eq. 3.63 uses and the geometry has: MISPRINTS.md.",
        "The ratio is that of the spikes below the mean, as the printed numbers are, not of the largest flow above it.",
    )


def run() -> Iterator[Finding]:
    """The printed numbers from the geometry of Section 3.4.4, and from the FMU."""
    told, pump = published(__file__), Geometry()
    top, spike = (value * LITRES for value in pump.ripple())
    mean = pump.mean * LITRES
    yield Finding("mean flow, off the printed by", abs(mean - told["mean_flow"]), 0.005, "l/min")
    yield Finding("smooth top, off the printed by", abs(top - told["top"]), 0.5e-4, "l/min")
    yield Finding("ratio of spike and mean, off the printed by", abs(spike / mean - told["ratio"]), 0.5e-4, "")
    psi = top / (spike * (1 - 2 / np.pi))
    yield Finding(f"psi is {psi:.4f}, off the printed by", abs(psi - told["psi"]), 0.001, "(rounding of its factors)")
    strokes = SPEED / (2 * np.pi) * told["spikes"]
    yield Finding("strokes per second, off the printed by", abs(strokes - told["strokes"]), 0.5, "Hz")
    flow = turned()["kinematic.DQPA"] * LITRES
    drops = int((np.diff(flow) < -0.5 * spike).sum() + (np.diff(flow) > 0.5 * spike).sum())
    yield Finding("FMU: jumps of half a spike or more in a revolution, not as many as spikes", abs(drops - 18), 0, "")
    even = min(Geometry(n).ripple()[1] for n in (6, 8, 10))
    odd = max(Geometry(n).ripple()[1] for n in (7, 9, 11))
    yield Finding("Figure 3.10: even numbers of pistons ripple more than odd; less by", max(0.0, odd - even), 0, "m3/s")


def pictures() -> Mapping[str, Figure]:
    """Each figure in its own form."""
    record = turned()
    degrees = np.rad2deg(record["kinematic.theta"])
    ports = (("port A", record["kinematic.DQPA"]), ("port B", record["kinematic.DQPB"]))
    both = (("actual", record["kinematic.DQPA"]), ("simplified", record["simplified.DQPA"]))
    return {
        "Figure 3.9 redone: ripple flow in port A and port B over a revolution.": _curves(degrees, ports, 360),
        "Figure 3.10 redone: ratio between ripple flow and mean flow over the number of pistons.": _ratios(),
        "Figure 3.11 redone: simplified against actual ripple flow with nine pistons.": _curves(degrees, both, 90),
    }


def _curves(degrees: Array, curves: Sequence[tuple[str, Array]], end: float) -> Figure:
    figure = new_figure(7.2, 3.0)
    axes = _axes(figure, "Angle of the shaft (deg)", "Ripple flow (l/min)")
    for (label, flow), colour, dash in zip(curves, COLOURS, DASHES, strict=False):
        axes.plot(degrees, LITRES * flow, color=colour, linestyle=dash, linewidth=1.1, label=label)
    axes.set_xlim(0, end)
    axes.set_xticks(np.linspace(0, end, 7))
    figure.legend(loc="outside upper center", ncols=2, frameon=False, fontsize=SMALL)
    return figure


def _ratios() -> Figure:
    figure = new_figure(7.2, 3.0)
    axes = _axes(figure, "Number of pistons", "Ripple over mean flow (%)")
    ratios = [100 * Geometry(n).ripple()[1] / Geometry(n).mean for n in PISTONS]
    for odd, label in ((0, "even"), (1, "odd")):
        chosen = [k for k, n in enumerate(PISTONS) if n % 2 == odd]
        axes.bar([PISTONS[k] for k in chosen], [ratios[k] for k in chosen], 0.6, color=COLOURS[odd], label=label)
    axes.set_xticks(PISTONS)
    axes.legend(frameon=False, fontsize=SMALL)
    return figure


def _axes(figure: Figure, x: str, y: str) -> Axes:
    axes = figure.subplots()
    quiet(axes)
    axes.set_xlabel(x, fontsize=TEXT)
    axes.set_ylabel(y, fontsize=TEXT)
    return axes
