"""Responses to chirps, shown: text, JSON, figures and page.

A figure has tops, bottoms and their mean in the arrangement of thesis Figures 2.7 and 4.4.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from pysim.identify import HALF_95, magnitude_db
from pysim.identify.chirp import Branch, ChirpAnalysis
from pysim.io import shown_value
from pysim.present.notes import words
from pysim.present.page import heading, items, pictures, table
from pysim.present.page import page as whole_page
from pysim.present.render import Drawing, Picture
from pysim.present.style import COLOURS, MEASURED, frequency_axis, legend_above, panels, phase_axis
from pysim.types import FrequencyResponse
from pysim.types.json_number import json_data

if TYPE_CHECKING:
    from matplotlib.artist import Artist
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_ROUND_HZ = (0.1, 0.2, 0.3, 0.5, 0.7, 1, 1.5, 2, 3, 4, 5, 6, 8, 10, 13, 16, 20, 25, 30, 40, 50, 70, 100, 150, 200)
_METHOD = (
    "To the logged command a chirp was fitted; to the output, around each of its tops and bottoms, a turn or more of a "
    "sine with harmonics whose amplitude and phase may drift.",
    "A top's magnitude is its height above the level by the command's amplitude (Eq. 2.15, the level taken off); its "
    "phase is its lag behind the command's top by the command's frequency there (Eq. 2.18). Bottoms likewise.",
    "The mean is that of a top and the bottom next to it, in decibels, degrees and hertz (Eq. 2.17, 2.20, 2.21).",
)
_LOOKS: dict[str, dict[str, Any]] = {
    "top": {"color": COLOURS[2], "linestyle": (0, (5, 1.5)), "linewidth": 1.1},
    "bottom": {"color": COLOURS[1], "linestyle": (0, (2, 1)), "linewidth": 1.1},
    "mean": {"color": COLOURS[0], "linestyle": "-", "linewidth": 1.6},
}


@dataclass(frozen=True)
class Chirps:
    """Those of one data set.

    Args:
        dataset: its name.
        stepped: for each chirp the stepped-sine response of its working point, or None; for the figures.
    """

    dataset: str
    analyses: tuple[ChirpAnalysis, ...]
    stepped: tuple[FrequencyResponse | None, ...]


def text(result: Chirps) -> str:
    """A table per chirp at round frequencies, with 95 percent intervals of the mean."""
    lines = []
    for one in result.analyses:
        lines += [_title(one), "      Hz     mean dB             phase deg            top dB, deg       bottom dB, deg"]
        for f, (db, db_half), (deg, deg_half), top, bottom in _rows(one):
            lines.append(
                f"{f:8g}  {db:8.2f} ±{db_half:5.2f}  {deg:9.1f} ±{deg_half:5.1f}"
                f"  {top[0]:9.2f} {top[1]:8.1f}  {bottom[0]:9.2f} {bottom[1]:8.1f}"
            )
        lines += [*(f"  {words(note)}" for note in one.notes), ""]
    return "\n".join([*lines, "± is half a 95 percent interval. Magnitudes are absolute."])


def data(result: Chirps) -> dict[str, Any]:
    """Everything that was found; magnitudes in dB, phases in degrees, doubts as standard deviations."""
    return json_data({"dataset": result.dataset, "chirps": [*map(_analysis, result.analyses)]})


def figures(result: Chirps) -> Iterator[Picture]:
    """One per chirp."""
    for i, (one, stepped) in enumerate(zip(result.analyses, result.stepped, strict=True)):
        name = "chirp" if len(result.analyses) == 1 else f"chirp_{i + 1}"
        caption = f"{one.source}: tops, bottoms and their mean with its 95 percent interval."
        yield Picture(name, caption, chirp_figure(one, stepped))


def page(result: Chirps, drawings: Sequence[Drawing], redo: str) -> str:
    """How it was done, a picture and a table per chirp, notes."""
    parts = [heading("How it was done"), items(_METHOD), heading("Responses"), *pictures(drawings)]
    for one in result.analyses:
        head = ["Hz", "mean (dB)", "±", "mean (deg)", "±", "top (dB)", "top (deg)", "bottom (dB)", "bottom (deg)"]
        rows = [
            [f"{f:g}", *(f"{x:.2f}" for x in (*mean, *phase, *top, *bottom))]
            for f, mean, phase, top, bottom in _rows(one)
        ]
        parts.append(table(_title(one), head, rows))
        parts += [items(map(words, one.notes))] if one.notes else []
    return whole_page("Response to chirps", f"Chirps of {result.dataset}.", parts, redo)


def _title(one: ChirpAnalysis) -> str:
    wave = one.command
    ends = wave.frequency_at(np.array([wave.start, wave.end]))
    offset, amplitude = (shown_value(x, one.input_unit, ".4g") for x in (wave.offset, wave.amplitude))
    return (
        f"{one.source}: {one.output} to {one.input} around {offset}, amplitude {amplitude}, "
        f"{ends[0]:.3g} to {ends[1]:.3g} Hz at {wave.rate:.3g} Hz/s"
    )


def _rows(one: ChirpAnalysis) -> list[tuple[float, Any, Any, Any, Any]]:
    """At round frequencies within the sweep: mean and half interval of dB and degrees, top and bottom."""
    low = max(branch.frequency[0] for branch in (one.top, one.bottom, one.mean))
    high = min(branch.frequency[-1] for branch in (one.top, one.bottom, one.mean))
    rows = []
    for f in (f for f in _ROUND_HZ if low <= f <= high):
        magnitude, phase = (float(x) for x in one.mean.at(np.array(f)))
        db_half = HALF_95 * float(np.interp(f, one.mean.frequency, one.mean.magnitude_deviation_db))
        deg_half = HALF_95 * float(np.degrees(np.interp(f, one.mean.frequency, one.mean.phase_deviation)))
        top, bottom = (tuple(float(x) for x in branch.at(np.array(f))) for branch in (one.top, one.bottom))
        rows.append((f, (magnitude, db_half), (phase, deg_half), top, bottom))
    return rows


def _analysis(one: ChirpAnalysis) -> dict[str, Any]:
    wave = one.command
    return {
        **{key: getattr(one, key) for key in ("source", "input", "output", "input_unit", "output_unit")},
        "offset": wave.offset,
        "amplitude": wave.amplitude,
        "start_hz": wave.frequency,
        "rate_hz_per_s": wave.rate,
        "onset_s": wave.start,
        "level": one.level,
        "noise": one.noise,
        "top": _branch(one.top),
        "bottom": _branch(one.bottom),
        "mean": _branch(one.mean),
        "remarks": [words(note) for note in one.notes],
    }


def _branch(branch: Branch) -> dict[str, Any]:
    return {
        "frequency_hz": branch.frequency,
        "magnitude_db": branch.magnitude_db,
        "magnitude_db_deviation": branch.magnitude_deviation_db,
        "phase_deg": branch.phase_deg,
        "phase_deg_deviation": np.degrees(branch.phase_deviation),
    }


def chirp_figure(analysis: ChirpAnalysis, stepped: FrequencyResponse | None = None) -> Figure:
    """Magnitude (dB, absolute) above phase (deg) over frequency; shaded: the mean's 95 percent interval.

    Args:
        stepped: the stepped-sine response of the same working point, as dots.
    """
    figure, ((top,), (bottom,)) = panels(7.2, 6.4, 2, sharex=True)
    branches = {"top": analysis.top, "bottom": analysis.bottom, "mean": analysis.mean}
    handles: dict[str, Artist] = {}
    for name, branch in branches.items():
        handles[name] = _draw(top, bottom, branch, _LOOKS[name], band=name == "mean")
    if stepped is not None:
        look: dict[str, Any] = {"color": MEASURED, "linestyle": "none", "marker": "o", "markersize": 4.0, "zorder": 5}
        (dots,) = top.plot(stepped.frequency, magnitude_db(stepped, None), **look)
        bottom.plot(stepped.frequency, np.degrees(stepped.phase) - 360 * _turns(stepped, analysis.mean), **look)
        handles["stepped sine"] = dots
    f = [analysis.mean.frequency] if stepped is None else [analysis.mean.frequency, stepped.frequency]
    frequency_axis(bottom, 0.95 * min(float(x[0]) for x in f), 1.05 * max(float(x[-1]) for x in f))
    phase_axis(bottom)
    top.set_ylabel("Magnitude (dB)")
    bottom.set(xlabel="Frequency (Hz)", ylabel="Phase (deg)")
    figure.align_ylabels([top, bottom])
    legend_above(figure, list(handles.values()), list(handles))
    return figure


def _turns(stepped: FrequencyResponse, mean: Branch) -> int:
    """By how many whole turns the sines' phase is above the chirp's.

    At the first sine that the chirp swept over, or else at the one nearest to its sweep.
    """
    f = np.log(stepped.frequency)
    outside = np.abs(f - np.clip(f, *np.log(mean.frequency[[0, -1]])))
    k = int(np.argmin(outside))
    swept = np.interp(stepped.frequency[k], mean.frequency, mean.phase)
    return round(float(stepped.phase[k] - swept) / (2 * np.pi))


def _draw(top: Axes, bottom: Axes, branch: Branch, look: dict[str, Any], *, band: bool) -> Artist:
    f = branch.frequency
    for axes, values, deviation in (
        (top, branch.magnitude_db, branch.magnitude_deviation_db),
        (bottom, branch.phase_deg, np.degrees(branch.phase_deviation)),
    ):
        (line,) = axes.plot(f, values, **look)
        if band:
            half = HALF_95 * deviation
            axes.fill_between(f, values - half, values + half, color=look["color"], alpha=0.18, linewidth=0)
    return line
