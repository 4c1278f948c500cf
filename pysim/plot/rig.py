"""The rig under its controllers: steps as in thesis Figures 6.7 and 6.8, heave as in Figures 6.4 to 6.6."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from pysim.present.style import BAND, COLOURS, DASHES, LIMIT, MEASURED, TEXT, legend_above, new_figure, quiet
from pysim.rig import HeaveTest, StepTest, standstills
from pysim.rig.heave_test import slow_part
from pysim.types import BadInput, Record

Array = NDArray[np.float64]

_BAR = 1e-5
_TRUE: dict[str, Any] = {"color": COLOURS[0], "linewidth": 1.3}
_PULSES: dict[str, Any] = {"color": COLOURS[1], "linestyle": DASHES[3], "linewidth": 1.0}
_REFERENCE: dict[str, Any] = {"color": MEASURED, "linestyle": DASHES[1], "linewidth": 1.1}


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
        factor = 1.0 if test.kind == "speed" else _BAR
        half = band * abs(test.size) * factor
        axes[name].axhspan(end * factor - half, end * factor + half, color=BAND, alpha=0.6, linewidth=0)
        axes[name].axhline(base * factor, color=LIMIT, linewidth=0.6)
    other = "load" if test.kind == "speed" else "speed"
    handles |= _draw_quantity(axes["other"], record, test, other, (test.at - 1, test.at + 9))
    shown = _within(record.time, (test.at - 1, test.at + 9))
    for k, (signal, label, factor) in enumerate(
        (("speed.alphaCMD", "pump's command (%)", 1.0), ("load.u_ref", "valve's command (%)", 100.0))
    ):
        axes["command"].plot(
            record.time[shown], factor * record[signal][shown], color=COLOURS[2 + k], linewidth=1.2, label=label
        )
    axes["command"].legend(fontsize=TEXT - 1, frameon=False)
    axes["command"].set_ylabel("Command (%)", fontsize=TEXT)
    for name in ("other", "command"):
        axes[name].set_xlabel("Time (s)", fontsize=TEXT)
    for axis in axes.values():
        quiet(axis)
    legend_above(figure, list(handles.values()), list(handles))
    return figure


def _draw_quantity(
    axes: Axes, record: Record, test: StepTest, kind: str, span: tuple[float, float]
) -> dict[str, Artist]:
    """Reference and answer of the speed (rad/s) or the load pressure (bar) within a span of time."""
    shown = _within(record.time, span)
    time = record.time[shown]
    factor = 1.0 if kind == "speed" else _BAR
    handles: dict[str, Artist] = {}
    (handles["reference"],) = axes.plot(time, factor * _reference(test, kind, time), **_REFERENCE)
    if kind == "speed":
        (handles["by the pulses"],) = axes.plot(time, record["rig.omegaS"][shown], **_PULSES)
    signal = "rig.omega" if kind == "speed" else "rig.pL"
    (handles["simulated"],) = axes.plot(time, factor * record[signal][shown], **_TRUE)
    axes.set_ylabel("Speed (rad/s)" if kind == "speed" else "Load pressure (bar)", fontsize=TEXT)
    return handles


def _reference(test: StepTest, kind: str, time: Array) -> Array:
    """The reference of a test at times (n,)."""
    return np.asarray(test.reference(kind).value(time))


def rig_heave_figure(record: Record, test: HeaveTest) -> Figure:
    """Speed with its standstills, load pressure, supply pressure over the whole test; below one reversal in detail."""
    figure = new_figure(9.0, 9.2)
    speed, load, supply, close = figure.subplots(4, 1, height_ratios=(1.4, 1.0, 1.0, 1.3))
    handles: dict[str, Artist] = {}
    time, spans = record.time, standstills(record.time, record["rig.omega"])
    (handles["simulated"],) = speed.plot(time, record["rig.omega"], **_TRUE)
    (handles["reference"],) = speed.plot(time, record["crane.omegaS_ref"], **_REFERENCE)
    load.plot(time, _BAR * record["rig.pL"], **_TRUE)
    load.plot(time, _BAR * record["crane.pL_ref"], **_REFERENCE)
    supply.plot(time, _BAR * record["rig.pS"], **_TRUE)
    for axes, label in ((speed, "Speed (rad/s)"), (load, "Load pressure (bar)"), (supply, "Supply pressure (bar)")):
        axes.set_ylabel(label, fontsize=TEXT)
        axes.set_xlim(time[0], time[-1])
    shown = _within(time, _reversal(time, spans, test))
    (handles["by the pulses"],) = close.plot(time[shown], record["rig.omegaS"][shown], **_PULSES)
    close.plot(time[shown], record["rig.omega"][shown], **_TRUE)
    close.plot(time[shown], record["crane.omegaS_ref"][shown], **_REFERENCE)
    close.set_xlim(time[shown][0], time[shown][-1])
    for begin, end in spans:
        field = close.axvspan(begin, end, color=BAND, alpha=0.7, linewidth=0)
        handles["standing still"] = field
    close.set_ylabel("Speed, a reversal (rad/s)", fontsize=TEXT)
    for axes in (supply, close):  # the first three share one span of time
        axes.set_xlabel("Time (s)", fontsize=TEXT)
    for axes in (speed, load, supply, close):
        quiet(axes)
    figure.align_ylabels([speed, load, supply, close])
    legend_above(figure, list(handles.values()), list(handles))
    return figure


def _reversal(time: Array, spans: Array, test: HeaveTest) -> tuple[float, float]:
    """Three seconds around the longest standstill that the figures count."""
    late = spans[spans[:, 0] >= test.settle]
    longest = late[np.argmax(late[:, 1] - late[:, 0])] if late.size else time[[0, -1]]
    middle = float(longest.mean())
    return middle - 1.5, middle + 1.5


def rig_error_figure(records: Mapping[str, Record]) -> Figure:
    """Load-pressure error of several controllers in the same wave, a panel each; dark: what is slower than 1 Hz.

    Raises:
        BadInput: no record.
    """
    if not records:
        raise BadInput("rig error figure: needs at least one record")
    figure = new_figure(9.0, 1.0 + 1.9 * len(records))
    panels = figure.subplots(len(records), 1, sharex=True, sharey=True, squeeze=False)[:, 0]
    handles: dict[str, Artist] = {}
    for axes, (label, record) in zip(panels, records.items(), strict=True):
        error = _BAR * (record["rig.pL"] - record["crane.pL_ref"])
        (handles["load pressure less reference"],) = axes.plot(record.time, error, color=COLOURS[5], linewidth=0.7)
        (handles["below 1 Hz"],) = axes.plot(record.time, slow_part(error, record.time), color=MEASURED, linewidth=1.3)
        axes.set_ylabel("Error (bar)", fontsize=TEXT)
        axes.set_title(label, fontsize=TEXT, loc="left")
        axes.set_xlim(record.time[0], record.time[-1])
        quiet(axes)
    largest = max(float(np.abs(r["rig.pL"] - r["crane.pL_ref"])[r.time > 1.0].max()) for r in records.values()) * _BAR
    panels[0].set_ylim(-1.05 * largest, 1.05 * largest)  # the weight coming up in the first second is cut
    panels[-1].set_xlabel("Time (s)", fontsize=TEXT)
    legend_above(figure, list(handles.values()), list(handles))
    return figure


def _within(time: Array, span: tuple[float, float]) -> NDArray[np.bool_]:
    return np.asarray((time >= span[0]) & (time <= span[1]))
