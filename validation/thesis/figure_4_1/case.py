"""Steady flow over the command, theoretical and of the pump block (Figure 4.1)."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

import numpy as np
from matplotlib.figure import Figure

from pysim.present.style import COLOURS, DASHES, LIMIT, SMALL, TEXT, new_figure, quiet
from validation.findings import Finding
from validation.pump_flow.case import swept
from validation.pump_flow.kinematics import LITRES, Geometry
from validation.thesis.numbers import published


def notes() -> Sequence[str]:
    """What stands in."""
    return (
        "The measured curves were not published; of them the text says that they are somewhat steeper than the "
        "theoretical flow, and end near 95 %. The pump block stands in: it ends there, and is not steeper.",
    )


def run() -> Iterator[Finding]:
    """The end of the flow, and the way there."""
    told, record = published(__file__), swept()
    flow, theory, command = record["pump.QActual"], record["Q_theory"], record["pump.alphaCMD"]
    share = 100 * float(flow.max()) / Geometry().mean
    yield Finding(f"flow ends at {share:.1f} % of the largest, off the printed by", abs(share - told["stop"]), 0.5, "%")
    inside = np.abs(command) < told["stop"] - 1
    off = 100 * float(np.abs(flow - theory)[inside].max()) / Geometry().mean
    yield Finding("before, off the theoretical flow by", off, told["accuracy"], "% (what the sensors were good for)")


def pictures() -> Mapping[str, Figure]:
    """Both curves; grey: what neither sensor saw."""
    record, told = swept(), published(__file__)
    order = np.argsort(record["pump.alphaCMD"])
    command = record["pump.alphaCMD"][order]
    figure = new_figure(7.2, 3.2)
    axes = figure.subplots()
    quiet(axes)
    axes.axhspan(told["small_sensor"], told["large_sensor"], color="#ececec", label="seen by neither flow sensor")
    axes.plot(command, LITRES * record["Q_theory"][order], color=LIMIT, linewidth=1.4, label="theoretical")
    flow = LITRES * record["pump.QActual"][order]
    axes.plot(command, flow, color=COLOURS[0], linestyle=DASHES[1], linewidth=1.4, label="pump block")
    axes.set_xlim(0, 100)
    axes.set_ylim(0, 110)
    axes.set_xlabel("Command of the angle (%)", fontsize=TEXT)
    axes.set_ylabel("Flow (l/min)", fontsize=TEXT)
    axes.legend(frameon=False, fontsize=SMALL)
    return {"Figure 4.1 redone: steady flow without load; the pump block stands in for the measurement.": figure}
