"""Chirp analyses as text, as data and as a section of a report."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pysim.identify import HALF_95
from pysim.identify.chirp import Branch, ChirpAnalysis
from pysim.io import shown_value
from pysim.present.page import cell, commands, heading, items, page, picture, table

Array = NDArray[np.float64]

_ROUND_HZ = (0.1, 0.2, 0.3, 0.5, 0.7, 1, 1.5, 2, 3, 4, 5, 6, 8, 10, 13, 16, 20, 25, 30, 40, 50, 70, 100, 150, 200)
_METHOD = (
    "To the logged command a chirp was fitted; to the output, around each of its tops and bottoms, a turn or more of a "
    "sine with harmonics whose amplitude and phase may drift.",
    "A top's magnitude is its height above the level by the command's amplitude (Eq. 2.15, the level taken off); its "
    "phase is its lag behind the command's top by the command's frequency there (Eq. 2.18). Bottoms likewise.",
    "The mean is that of a top and the bottom next to it, in decibels, degrees and hertz (Eq. 2.17, 2.20, 2.21).",
)


def chirp_text(analyses: Sequence[ChirpAnalysis]) -> str:
    """A table per chirp at round frequencies, with 95 percent intervals of the mean."""
    lines = []
    for one in analyses:
        lines += [_title(one), "      Hz     mean dB             phase deg            top dB, deg       bottom dB, deg"]
        for f, (db, db_half), (deg, deg_half), top, bottom in _rows(one):
            lines.append(
                f"{f:8g}  {db:8.2f} ±{db_half:5.2f}  {deg:9.1f} ±{deg_half:5.1f}"
                f"  {top[0]:9.2f} {top[1]:8.1f}  {bottom[0]:9.2f} {bottom[1]:8.1f}"
            )
        lines += [f"  {remark}" for remark in one.remarks] + [""]
    return "\n".join([*lines, "± is half a 95 percent interval. Magnitudes are absolute."])


def chirp_data(analyses: Sequence[ChirpAnalysis], *, dataset: str) -> dict[str, Any]:
    """Everything that was found; magnitudes in dB, phases in degrees, doubts as standard deviations."""
    return {"dataset": dataset, "chirps": [_analysis(one) for one in analyses]}


def chirp_section(analyses: Sequence[ChirpAnalysis], pictures: Mapping[str, bytes]) -> list[str]:
    """Parts of a page: how it was done, a picture (caption -> SVG) and a table per chirp, remarks."""
    parts = [heading("How it was done"), items(_METHOD), heading("Responses")]
    parts += [picture(svg, caption) for caption, svg in pictures.items()]
    for one in analyses:
        head = ["Hz", "mean (dB)", "±", "mean (deg)", "±", "top (dB)", "top (deg)", "bottom (dB)", "bottom (deg)"]
        rows = [
            [cell(f"{f:g}"), *(cell(f"{x:.2f}") for x in (*mean, *phase, *top, *bottom))]
            for f, mean, phase, top, bottom in _rows(one)
        ]
        parts.append(table(_title(one), head, rows))
        if one.remarks:
            parts.append(items(one.remarks))
    return parts


def chirp_page(analyses: Sequence[ChirpAnalysis], *, dataset: str, pictures: Mapping[str, bytes], redo: str) -> str:
    """A self-contained HTML page; redo is the command line that makes it again."""
    parts = [*chirp_section(analyses, pictures), heading("Do it again"), commands(redo)]
    return page("Response to chirps", f"Chirps of {dataset}.", parts)


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
        "source": one.source,
        "input": one.input,
        "output": one.output,
        "input_unit": one.input_unit,
        "output_unit": one.output_unit,
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
        "remarks": list(one.remarks),
    }


def _branch(branch: Branch) -> dict[str, Any]:
    return {
        "frequency_hz": branch.frequency.tolist(),
        "magnitude_db": branch.magnitude_db.tolist(),
        "magnitude_db_deviation": branch.magnitude_deviation_db.tolist(),
        "phase_deg": branch.phase_deg.tolist(),
        "phase_deg_deviation": np.degrees(branch.phase_deviation).tolist(),
    }
