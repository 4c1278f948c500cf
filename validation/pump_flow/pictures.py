"""`python -m validation.pump_flow.pictures FOLDER`: ripple.png and flow.png, thesis Fig. 3.9 to 3.11 and 4.1 redone."""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from pysim.present.render import render
from pysim.present.style import COLOURS, DASHES, LIMIT, SMALL, TEXT, new_figure, quiet
from validation.pump_flow.case import swept, turned
from validation.pump_flow.kinematics import LITRES, Geometry


def ripple_picture() -> Figure:
    """Ripple at both ports over a revolution, and true and simplified over a sixth of it."""
    figure = new_figure(7.2, 3.2)
    left, right = figure.subplots(1, 2)
    record = turned()
    degrees = np.rad2deg(record["kinematic.theta"])
    _lines(left, degrees, (("port A", record["kinematic.DQPA"]), ("port B", record["kinematic.DQPB"])), 360)
    shown = (("all pistons", record["kinematic.DQPA"]), ("simplified", record["simplified.DQPA"]))
    _lines(right, degrees, shown, 60)
    right.set_ylim(-2.3, 1.3)
    return figure


def _lines(axes: Axes, degrees: np.ndarray, curves: tuple[tuple[str, np.ndarray], ...], end: float) -> None:
    quiet(axes)
    for (label, flow), colour, dash in zip(curves, COLOURS, DASHES, strict=False):
        axes.plot(degrees, LITRES * flow, color=colour, linestyle=dash, linewidth=1.1, label=label)
    axes.set_xlim(0, end)
    axes.set_xticks(np.linspace(0, end, 7))
    axes.set_xlabel("Angle of the shaft (deg)", fontsize=TEXT)
    axes.set_ylabel("Flow above the mean (l/min)", fontsize=TEXT)
    axes.set_ylim(-2.3, 3.0)
    axes.legend(fontsize=SMALL, frameon=False, loc="upper left", ncols=2)


def flow_picture() -> Figure:
    """Ripple over the number of pistons, and steady flow over the command."""
    figure = new_figure(7.2, 3.2)
    left, right = figure.subplots(1, 2)
    quiet(left)
    counts = np.arange(5, 16)
    ratios = np.array([[100 * value / Geometry(int(n)).mean for value in Geometry(int(n)).ripple()] for n in counts])
    width = 0.38
    left.bar(counts - width / 2, ratios[:, 1], width, color=COLOURS[0], label="spikes, below the mean")
    left.bar(counts + width / 2, ratios[:, 0], width, color=COLOURS[1], label="tops, above it")
    left.set_xticks(counts)
    left.set_xlabel("Number of pistons", fontsize=TEXT)
    left.set_ylabel("Ripple over mean flow (%)", fontsize=TEXT)
    left.legend(fontsize=SMALL, frameon=False)
    record = swept()
    quiet(right)
    order = np.argsort(record["pump.alphaCMD"])
    command = record["pump.alphaCMD"][order]
    right.plot(command, LITRES * record["Q_theory"][order], color=LIMIT, linewidth=1.2, label="theoretical")
    right.plot(command, LITRES * record["pump.QActual"][order], color=COLOURS[0], linewidth=1.2, label="pump block")
    right.set_xlim(-100, 100)
    right.set_xlabel("Command of the angle (%)", fontsize=TEXT)
    right.set_ylabel("Flow (l/min)", fontsize=TEXT)
    right.legend(fontsize=SMALL, frameon=False)
    return figure


def main(folder: Path) -> None:
    """Write both pictures."""
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "ripple.png").write_bytes(render(ripple_picture(), "png"))
    (folder / "flow.png").write_bytes(render(flow_picture(), "png"))


if __name__ == "__main__":
    main(Path(sys.argv[1]))
