"""Table 4.2: the pressure drop over the orifice is no orifice's alone."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import NDArray
from scipy.optimize import linprog

from pysim.present.style import COLOURS, DASHES, MEASURED, SMALL, TEXT, new_figure, quiet
from pysim.thesis import read_csv
from validation.findings import Finding

_ROUNDING = 0.5  # bar, half the last digit
MEAN_FLOW = 102.95  # l/min at full angle, Section 3.4.4


def notes() -> Sequence[str]:
    """What the table cannot say."""
    return (
        "These five pressures are measurements, the only ones of the load that were printed. No model of ours makes "
        "them: the orifice's size was not published.",
    )


def run() -> Iterator[Finding]:
    """A root law with a flow that passes beside the orifice; without it the table cannot be had."""
    angle, drop = _table()
    slope, zero = _law(angle, drop)
    off = np.abs((slope * angle + zero) ** 2 - drop)
    claim = "drop against (c (angle - a))^2 with one c and one a, within the rounding of the table"
    yield Finding(claim, float(off.max()), _ROUNDING, "bar")
    beside = -zero / slope
    alone = float(np.abs(_alone(angle, drop) - drop).max())
    claim = (
        f"an orifice alone misses the table by {alone:.1f} bar; the law above has {beside * MEAN_FLOW / 100:.0f} l/min "
        f"({beside:.0f} % of full flow) go past it; short of the rounding by"
    )
    yield Finding(claim, max(0.0, _ROUNDING - alone), 0.0, "bar")


def _table() -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    rows = read_csv(Path(__file__).parent / "published.csv")
    return np.array([float(r["angle_percent"]) for r in rows]), np.array([float(r["drop_bar"]) for r in rows])


def _law(angle: NDArray[np.float64], drop: NDArray[np.float64]) -> tuple[float, float]:
    """c and -c a of the line through the roots of the drops whose largest miss, in bar, is smallest."""
    root = np.sqrt(drop)
    lines = np.column_stack([angle, np.ones_like(angle), -1 / (2 * root)])
    mirrored = np.column_stack([-lines[:, :2], lines[:, 2]])
    bounds = [(None, None), (None, None), (0, None)]
    best = linprog([0, 0, 1], A_ub=np.vstack([lines, mirrored]), b_ub=np.concatenate([root, -root]), bounds=bounds)
    return float(best.x[0]), float(best.x[1])


def _alone(angle: NDArray[np.float64], drop: NDArray[np.float64]) -> NDArray[np.float64]:
    """The nearest c angle^2."""
    share: NDArray[np.float64] = angle**2 * float(drop @ angle**2 / (angle**2 @ angle**2))
    return share


def pictures() -> Mapping[str, Figure]:
    """Table and both laws."""
    angle, drop = _table()
    slope, zero = _law(angle, drop)
    dense = np.linspace(20, 90, 200)
    figure = new_figure(7.2, 3.0)
    axes = figure.subplots()
    quiet(axes)
    axes.plot(
        dense, np.maximum(slope * dense + zero, 0) ** 2, color=COLOURS[0], linewidth=1.4, label="orifice, flow past it"
    )
    scale = float(drop @ angle**2 / (angle**2 @ angle**2))
    axes.plot(dense, scale * dense**2, color=COLOURS[1], linestyle=DASHES[1], linewidth=1.2, label="orifice alone")
    axes.plot(angle, drop, "o", color=MEASURED, markersize=5, label="Table 4.2")
    axes.set_xlim(20, 90)
    axes.set_ylim(0, 85)
    axes.set_xlabel("Swash plate angle (%)", fontsize=TEXT)
    axes.set_ylabel("Pressure drop (bar)", fontsize=TEXT)
    axes.legend(frameon=False, fontsize=SMALL)
    return {"Table 4.2: pressure drop over the orifice, and what laws make of it.": figure}
