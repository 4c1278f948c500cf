"""Heave compensation on the rig, shown: text, JSON, figures and page.

The figures are as in thesis Figures 6.4 to 6.6.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from pysim.present.page import heading, items, pictures, table
from pysim.present.page import page as whole_page
from pysim.present.render import Drawing, Picture
from pysim.present.rig import BAR, PULSES, REFERENCE, TRUE, within
from pysim.present.style import BAND, COLOURS, MEASURED, TEXT, legend_above, panels
from pysim.rig import HeaveFigures, HeaveTest, standstills
from pysim.rig.heave_test import slow_part
from pysim.types import BadInput, Record
from pysim.types.json_number import json_data

if TYPE_CHECKING:
    from matplotlib.artist import Artist
    from matplotlib.figure import Figure
    from numpy.typing import NDArray

    Array = NDArray[np.float64]

_HEAD = (
    "speed rms (rad/s)",
    "max",
    "pressure rms (bar)",
    "max",
    "below 1 Hz (bar)",
    "supply (bar)",
    "standstills",
    "longest (s)",
)
_METHOD = (
    "A vessel heaves in a stochastic wave; the crane makes references of it, drum speed and load pressure, and the rig "
    "follows (thesis Sections 5.7 and 6.3).",
    "Errors are true speed and load pressure less their references, the start left out. Below 1 Hz: what the waves "
    "leave, without stick and slip.",
    "The shaft stands still where it turns by less than 0.5 rad/s for 50 ms or more; the reference's own longest such "
    "span is given beside it.",
)


@dataclass(frozen=True)
class Heave:
    """Controllers in the same wave.

    Args:
        runs: label of each controller -> what its answer is worth.
        records: of each, for the figures; the first is shown in detail.
    """

    test: HeaveTest
    runs: Mapping[str, HeaveFigures]
    records: Mapping[str, Record]


def text(result: Heave) -> str:
    """A row per controller."""
    width = max(len(label) for label in result.runs)
    lines = [" " * width + "".join(f"{name:>20}" for name in _HEAD)]
    lines += [f"{label:<{width}}" + "".join(f"{x:>20}" for x in _cells(found)) for label, found in result.runs.items()]
    return "\n".join(lines)


def data(result: Heave) -> dict[str, Any]:
    """SI numbers, and the wave."""
    test = result.test
    wave = {"significant_height_m": test.significant_height, "peak_period_s": test.peak_period}
    return json_data(
        {
            "wave": {**wave, "length_s": test.length, "seed": test.seed},
            "controllers": {label: _data(one) for label, one in result.runs.items()},
        }
    )


def figures(result: Heave) -> Iterator[Picture]:
    """The first controller in detail, and the errors of all."""
    caption = "Speed, load pressure and supply pressure under the thesis' controllers, and a reversal in detail."
    yield Picture("heave", caption, rig_heave_figure(next(iter(result.records.values())), result.test))
    yield Picture("heave_error", "Load-pressure error of each controller.", rig_error_figure(result.records))


def page(result: Heave, drawings: Sequence[Drawing], redo: str) -> str:
    """How it was done, how well the references were followed, the pictures."""
    rows = [[label, *_cells(f)] for label, f in result.runs.items()]
    test = result.test
    lead = (
        f"Significant height {test.significant_height:g} m, peak period {test.peak_period:g} s, {test.length:g} s, "
        f"seed {test.seed}."
    )
    parts = [heading("How it was done"), items(_METHOD)]
    parts.append(table("How well the references were followed", ["controller", *_HEAD], rows, words=[0]))
    parts += pictures(drawings)
    return whole_page("Heave compensation on the rig", lead, parts, redo)


def _data(f: HeaveFigures) -> dict[str, Any]:
    keys = ("speed_rms", "speed_max", "pressure_rms", "pressure_max", "pressure_slow_rms", "supply_low", "supply_high")
    held = {"standstill_longest_s": f.held_longest, "standstill_longest_of_reference_s": f.held_reference}
    return {**{key: getattr(f, key) for key in keys}, "standstills": f.held, **held}


def _cells(f: HeaveFigures) -> list[str]:
    return [
        f"{f.speed_rms:.2f}",
        f"{f.speed_max:.1f}",
        f"{BAR * f.pressure_rms:.2f}",
        f"{BAR * f.pressure_max:.1f}",
        f"{BAR * f.pressure_slow_rms:.2f}",
        f"{BAR * f.supply_low:.0f} ... {BAR * f.supply_high:.0f}",
        f"{f.held.shape[0]}",
        f"{f.held_longest:.2f} ({f.held_reference:.2f})",
    ]


def rig_heave_figure(record: Record, test: HeaveTest) -> Figure:
    """Speed with its standstills, load pressure, supply pressure over the whole test; below one reversal in detail."""
    figure, axes = panels(9.0, 9.2, 4, height_ratios=(1.4, 1.0, 1.0, 1.3))
    speed, load, supply, close = axes[:, 0]
    handles: dict[str, Artist] = {}
    time, spans = record.time, standstills(record.time, record["rig.omega"])
    (handles["simulated"],) = speed.plot(time, record["rig.omega"], **TRUE)
    (handles["reference"],) = speed.plot(time, record["crane.omegaS_ref"], **REFERENCE)
    load.plot(time, BAR * record["rig.pL"], **TRUE)
    load.plot(time, BAR * record["crane.pL_ref"], **REFERENCE)
    supply.plot(time, BAR * record["rig.pS"], **TRUE)
    for panel, label in ((speed, "Speed (rad/s)"), (load, "Load pressure (bar)"), (supply, "Supply pressure (bar)")):
        panel.set(ylabel=label, xlim=(time[0], time[-1]))
    shown = within(time, _reversal(time, spans, test))
    (handles["by the pulses"],) = close.plot(time[shown], record["rig.omegaS"][shown], **PULSES)
    close.plot(time[shown], record["rig.omega"][shown], **TRUE)
    close.plot(time[shown], record["crane.omegaS_ref"][shown], **REFERENCE)
    for begin, end in spans:
        field = close.axvspan(begin, end, color=BAND, alpha=0.7, linewidth=0)
        handles["standing still"] = field
    close.set(xlabel="Time (s)", ylabel="Speed, a reversal (rad/s)", xlim=time[shown][[0, -1]])
    supply.set_xlabel("Time (s)")  # the first three share one span of time
    figure.align_ylabels(axes)
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
    figure, grid = panels(9.0, 1.0 + 1.9 * len(records), len(records), sharex=True, sharey=True)
    handles: dict[str, Artist] = {}
    for axes, (label, record) in zip(grid[:, 0], records.items(), strict=True):
        error = BAR * (record["rig.pL"] - record["crane.pL_ref"])
        (handles["load pressure less reference"],) = axes.plot(record.time, error, color=COLOURS[5], linewidth=0.7)
        (handles["below 1 Hz"],) = axes.plot(record.time, slow_part(error, record.time), color=MEASURED, linewidth=1.3)
        axes.set(ylabel="Error (bar)", xlim=record.time[[0, -1]])
        axes.set_title(label, fontsize=TEXT, loc="left")
    largest = max(float(np.abs(r["rig.pL"] - r["crane.pL_ref"])[r.time > 1.0].max()) for r in records.values()) * BAR
    grid[0, 0].set_ylim(-1.05 * largest, 1.05 * largest)  # the weight coming up in the first second is cut
    grid[-1, 0].set_xlabel("Time (s)")
    legend_above(figure, list(handles.values()), list(handles))
    return figure
