"""Measured frequency responses, shown: text, JSON, figure and page."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from pysim.identify import HALF_95, THESIS_REFERENCE_HZ, MeasuredResponse, SinePoint, magnitude_db, standard_deviations
from pysim.io import shown_unit, shown_value
from pysim.present.notes import USES, words
from pysim.present.page import cell, heading, items, paragraph, pictures, table
from pysim.present.page import page as whole_page
from pysim.present.render import Drawing, Picture
from pysim.present.style import frequency_axis, legend_above, look, panels, phase_axis, size_axis
from pysim.types import BadInput
from pysim.types.json_number import json_data

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


_METHOD = (
    "To the command as it was logged a sine of the test's frequency was fitted, and to the output one with its "
    "harmonics, by least squares over the last whole periods, transients left out (thesis Sections 2.2, 2.3).",
    "Magnitude and phase are those of the output's sine against the command's.",
    "Intervals hold 95 percent. They come from the noise that the data set declares where the residuals agree with "
    "it, else from the residuals; where these have a memory, from their spectral density at the frequency.",
)


@dataclass(frozen=True)
class Responses:
    """Those of one data set.

    Args:
        dataset: its name.
        reference_hz: whose magnitude is 0 dB; None for absolute magnitudes.
    """

    dataset: str
    responses: tuple[MeasuredResponse, ...]
    reference_hz: float | None


def text(result: Responses) -> str:
    """A table per response with 95 percent intervals, and the notes below it."""
    lines = []
    for one in result.responses:
        mean_of = f"mean {shown_unit(one.output_unit)[0]}"
        lines += [_title(one), f"      Hz   magnitude dB      phase deg{mean_of:>11}    harmonics %   periods"]
        for row in _rows(one, result.reference_hz):
            f, (db, db_half), (deg, deg_half), mean, harmonics, sure, periods = row
            mark = "*" if sure else " "
            lines.append(
                f"{f:8g}  {db:8.3f} ±{db_half:5.3f}  {deg:8.2f} ±{deg_half:5.2f}  {mean:9.4g}"
                f"  {harmonics:9.2f} {mark} {periods:8d}"
            )
        lines += [*(f"  {words(note)}" for note in one.notes), ""]
    return "\n".join([*lines, *_legend(result.reference_hz)])


def data(result: Responses) -> dict[str, Any]:
    """Everything that was found; magnitudes in dB, phases in degrees, intervals as standard deviations."""
    responses = [_response(one, result.reference_hz) for one in result.responses]
    about = {"dataset": result.dataset, "reference_hz": result.reference_hz}
    return json_data({**about, "responses": responses})


def figures(result: Responses) -> Iterator[Picture]:
    """All responses in one."""
    caption = "Magnitude, phase and harmonics; bars: 95 percent intervals; filled: beyond the noise."
    yield Picture("frf", caption, frf_figure(result.responses, result.reference_hz))


def page(result: Responses, drawings: Sequence[Drawing], redo: str) -> str:
    """How it was done, the picture, a table per response with its notes."""
    parts = [heading("How it was done"), items(_METHOD), heading("Responses"), *pictures(drawings)]
    for one in result.responses:
        mean = f"mean ({shown_unit(one.output_unit)[0]})"
        head = ["Hz", "magnitude (dB)", "±", "phase (deg)", "±", mean, "harmonics (%)", "periods"]
        parts.append(table(_title(one), head, [_cells(row) for row in _rows(one, result.reference_hz)]))
        parts += [items(map(words, one.notes))] if one.notes else []
    parts.append(paragraph(" ".join(_legend(result.reference_hz))))
    return whole_page("Frequency responses", f"Stepped sines of {result.dataset}.", parts, redo)


def _title(one: MeasuredResponse) -> str:
    test = one.response.test
    offset, amplitude = (shown_value(x, one.input_unit) for x in (test.offset, test.amplitude))
    return (
        f"{test.output} to {test.input} around {offset}, amplitude {amplitude} ({one.response.origin}{_held_out(one)})"
    )


def _held_out(one: MeasuredResponse) -> str:
    return "" if one.use == "fit" else f", {USES[one.use]}"


def _rows(one: MeasuredResponse, reference_hz: float | None) -> list[tuple[Any, ...]]:
    response = one.response
    decibel, degrees = (HALF_95 * sigma for sigma in standard_deviations(response, reference_hz))
    magnitude, phase = magnitude_db(response, reference_hz), np.degrees(response.phase)
    factor = shown_unit(one.output_unit)[1]
    return [
        (p.frequency, (m, dm), (a, da), factor * p.mean, 100 * p.distortion, p.distorted, p.periods)
        for p, m, dm, a, da in zip(one.points, magnitude, decibel, phase, degrees, strict=True)
    ]


def _cells(row: tuple[Any, ...]) -> list[str]:
    f, (db, db_half), (deg, deg_half), mean, harmonics, sure, periods = row
    numbers = [f"{f:g}", f"{db:.3f}", f"{db_half:.3f}", f"{deg:.2f}", f"{deg_half:.2f}", f"{mean:.4g}"]
    return [*numbers, cell(f"{harmonics:.2f}", "differs" if sure else ""), f"{periods}"]


def _legend(reference_hz: float | None) -> list[str]:
    relative = (
        "Magnitudes are absolute." if reference_hz is None else f"Magnitudes are relative to {reference_hz:g} Hz."
    )
    return [f"{relative} ± is half a 95 percent interval. Harmonics: root of the sum of squares; marked where they are"
            " beyond the noise."]  # fmt: skip


def _response(one: MeasuredResponse, reference_hz: float | None) -> dict[str, Any]:
    response = one.response
    decibel, degrees = standard_deviations(response, reference_hz)
    return {
        **{key: getattr(response.test, key) for key in ("input", "output", "offset", "amplitude")},
        "input_unit": one.input_unit,
        "output_unit": one.output_unit,
        "origin": response.origin,
        "frequency_hz": response.frequency,
        "magnitude_db": magnitude_db(response, reference_hz),
        "magnitude_db_deviation": decibel,
        "gain": response.gain,
        "phase_deg": np.degrees(response.phase),
        "phase_deg_deviation": degrees,
        "mean": [point.mean for point in one.points],
        "points": [_point(point) for point in one.points],
        "remarks": [words(note) for note in one.notes],
    }


def _point(point: SinePoint) -> dict[str, Any]:
    return {
        **{key: getattr(point, key) for key in ("source", "periods", "harmonics", "harmonics_noise", "distorted")},
        "frequency_hz": point.frequency,
        "command_offset": point.command.offset,
        "command_amplitude": point.command.amplitude,
        "residual": point.noise.deviation,
        **{key: getattr(point.noise, key) for key in ("basis", "whiteness")},
        "remarks": [words(note) for note in point.notes],
    }


def frf_figure(responses: Sequence[MeasuredResponse], reference_hz: float | None = THESIS_REFERENCE_HZ) -> Figure:
    """Magnitude (dB), phase (deg) and total harmonic distortion (%) over frequency, a colour per response.

    Bars are 95 percent intervals; where they are shorter than the marker they hide in it. Filled marks of the
    distortion are beyond what noise alone gives.

    Args:
        reference_hz: whose magnitude is 0 dB; None for absolute magnitudes.
    Raises:
        BadInput: nothing to draw, or the reference frequency was not tested.
    """
    if not responses:
        raise BadInput("frequency response figure: there is no response")
    figure, ((top,), (middle,), (bottom,)) = panels(7.2, 7.6, 3, sharex=True, height_ratios=(1.3, 1.3, 0.8))
    axes = (top, middle, bottom)
    handles = []
    for i, one in enumerate(responses):
        own = {**look(i, "linestyle", "marker"), "markersize": 3.5, "linewidth": 1.0}
        handles.append(_draw(axes, one, reference_hz, own))
    f = np.concatenate([one.response.frequency for one in responses])
    frequency_axis(bottom, 0.93 * float(f.min()), 1.07 * float(f.max()))
    relative = "" if reference_hz is None else f" relative to {reference_hz:g} Hz"
    phase_axis(middle)
    size_axis(bottom)
    top.set_ylabel(f"Magnitude{relative} (dB)")
    middle.set_ylabel("Phase (deg)")
    bottom.set(xlabel="Frequency (Hz)", ylabel="Harmonics (%)")
    figure.align_ylabels(axes)
    several = len({(one.response.test.input, one.response.test.output) for one in responses}) > 1
    legend_above(figure, handles, [_label(one, signals=several) for one in responses])
    return figure


def _label(one: MeasuredResponse, *, signals: bool) -> str:
    """Offset and amplitude, with output and input ahead of them on request."""
    test = one.response.test
    of = f"{test.output} to {test.input}, " if signals else ""
    offset = shown_unit(one.input_unit)[1] * test.offset
    return f"{of}{offset:+g} ± {shown_value(test.amplitude, one.input_unit)}{_held_out(one)}"


def _draw(axes: Sequence[Axes], one: MeasuredResponse, reference_hz: float | None, own: dict[str, Any]) -> Any:
    response = one.response
    f = response.frequency
    decibel, degrees = standard_deviations(response, reference_hz)
    magnitude, phase = magnitude_db(response, reference_hz), np.degrees(response.phase)
    bars: dict[str, Any] = {"elinewidth": 0.9, "capsize": 2.0}
    handle = axes[0].errorbar(f, magnitude, yerr=HALF_95 * decibel, **own, **bars)
    axes[1].errorbar(f, phase, yerr=HALF_95 * degrees, **own, **bars)
    distortion = 100 * np.array([point.distortion for point in one.points])
    sure = np.array([point.distorted for point in one.points])
    axes[2].plot(f, distortion, **{**own, "marker": "none"})
    axes[2].plot(f[sure], distortion[sure], **{**own, "linestyle": "none"})
    axes[2].plot(f[~sure], distortion[~sure], **{**own, "linestyle": "none"}, markerfacecolor="white")
    return handle
