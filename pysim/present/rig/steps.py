"""Step tests of the rig, shown: text, JSON, figures and page.

A figure is as in thesis Figures 6.7 and 6.8.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from pysim.present.page import heading, items, pictures, table
from pysim.present.page import page as whole_page
from pysim.present.render import Drawing, Picture
from pysim.present.rig import BAR, PULSES, REFERENCE, TRUE, within
from pysim.present.style import BAND, COLOURS, LIMIT, TEXT, legend_above, new_figure, quiet
from pysim.rig import StepFigures, StepTest
from pysim.types import Record
from pysim.types.json_number import json_number

if TYPE_CHECKING:
    from matplotlib.artist import Artist
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from numpy.typing import NDArray

    Array = NDArray[np.float64]

_HEAD = ("step of", "size", "steady error", "overshoot (%)", "rise (s)", "settling (s)")
_METHOD = (
    "Both references come up by ramps within a second; one of them steps, the other one is held (thesis Section 6.4).",
    "The steady error is the mean of the last second less the reference. Rise: from a tenth to nine tenths of the "
    "step. Settling: until the answer stays within 5 percent of the step.",
)


@dataclass(frozen=True)
class Steps:
    """Step tests of one rig.

    Args:
        steps: each test with what its answer is worth.
        records: of each test, for the figures.
    """

    steps: tuple[tuple[StepTest, StepFigures], ...]
    records: tuple[Record, ...]


def text(result: Steps) -> str:
    """A row per step."""
    lines = ["".join(f"{name:>16}" for name in _HEAD)]
    return "\n".join(lines + ["".join(f"{x:>16}" for x in _cells(*one)) for one in result.steps])


def data(result: Steps) -> list[dict[str, Any]]:
    """SI numbers; null where an answer did not get there."""
    return [
        {
            "kind": test.kind,
            "size": test.size,
            "steady_error": found.steady_error,
            "overshoot": found.overshoot,
            "rise_time_s": json_number(found.rise_time),
            "settling_time_s": json_number(found.settling_time),
            "settling_band": found.band,
        }
        for test, found in result.steps
    ]


def figures(result: Steps) -> Iterator[Picture]:
    """One per step."""
    for (test, _), record in zip(result.steps, result.records, strict=True):
        caption = f"Step of the {test.kind}; grey: 5 percent."
        yield Picture(f"step_{test.kind}", caption, rig_step_figure(record, test))


def page(result: Steps, drawings: Sequence[Drawing], redo: str) -> str:
    """How it was done, the answers' figures, the pictures."""
    rows = [_cells(*one) for one in result.steps]
    parts = [heading("How it was done"), items(_METHOD), table("Answers to steps", _HEAD, rows), *pictures(drawings)]
    lead = "Speed and load pressure of the test bench under its controllers."
    return whole_page("Step tests of the rig", lead, parts, redo)


def _cells(test: StepTest, found: StepFigures) -> list[str]:
    speed = test.kind == "speed"
    scale, unit = (1.0, "rad/s") if speed else (BAR, "bar")
    return [
        "speed" if speed else "load pressure",
        f"{test.size * scale:g} {unit}",
        f"{found.steady_error * scale:.2g} {unit}",
        f"{100 * found.overshoot:.1f}",
        f"{found.rise_time:.3f}",
        f"{found.settling_time:.2f}",
    ]


def rig_step_figure(record: Record, test: StepTest, *, band: float = 0.05) -> Figure:
    """Answer and reference, the first second again, the other reference's answer and the commands below.

    Args:
        band: share of the step, drawn around its end.
    """
    figure = new_figure(9.0, 5.6)
    axes = figure.subplot_mosaic([["whole", "close"], ["other", "command"]], height_ratios=(1.6, 1.0))
    handles: dict[str, Artist] = {}
    for name, span in (("whole", (test.at - 1, record.time[-1])), ("close", (test.at - 0.1, test.at + 1.4))):
        handles = _draw_quantity(axes[name], record, test, test.kind, span)
        base, end = (test.speed, test.speed + test.size) if test.kind == "speed" else (test.load, test.load + test.size)
        factor = 1.0 if test.kind == "speed" else BAR
        half = band * abs(test.size) * factor
        axes[name].axhspan(end * factor - half, end * factor + half, color=BAND, alpha=0.6, linewidth=0)
        axes[name].axhline(base * factor, color=LIMIT, linewidth=0.6)
    other = "load" if test.kind == "speed" else "speed"
    handles |= _draw_quantity(axes["other"], record, test, other, (test.at - 1, test.at + 9))
    shown = within(record.time, (test.at - 1, test.at + 9))
    pump, valve = record["speed.alphaCMD"], 100 * record["load.u_ref"]
    for values, label, colour in ((pump, "pump's command (%)", COLOURS[2]), (valve, "valve's command (%)", COLOURS[3])):
        axes["command"].plot(record.time[shown], values[shown], color=colour, linewidth=1.2, label=label)
    axes["command"].legend(fontsize=TEXT - 1, frameon=False)
    axes["command"].set(xlabel="Time (s)", ylabel="Command (%)")
    axes["other"].set_xlabel("Time (s)")
    for axis in axes.values():
        quiet(axis)
    legend_above(figure, list(handles.values()), list(handles))
    return figure


def _draw_quantity(
    axes: Axes, record: Record, test: StepTest, kind: str, span: tuple[float, float]
) -> dict[str, Artist]:
    """Reference and answer of the speed (rad/s) or the load pressure (bar) within a span of time."""
    shown = within(record.time, span)
    time = record.time[shown]
    factor = 1.0 if kind == "speed" else BAR
    handles: dict[str, Artist] = {}
    (handles["reference"],) = axes.plot(time, factor * np.asarray(test.reference(kind).value(time)), **REFERENCE)
    if kind == "speed":
        (handles["by the pulses"],) = axes.plot(time, record["rig.omegaS"][shown], **PULSES)
    signal = "rig.omega" if kind == "speed" else "rig.pL"
    (handles["simulated"],) = axes.plot(time, factor * record[signal][shown], **TRUE)
    axes.set_ylabel("Speed (rad/s)" if kind == "speed" else "Load pressure (bar)")
    return handles
