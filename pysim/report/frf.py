"""Measured frequency responses as text, as data and as a section of a report."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from pysim.identify import HALF_95, MeasuredResponse, SinePoint, magnitude_db, standard_deviations
from pysim.io import shown_unit, shown_value
from pysim.report.page import cell, commands, heading, items, page, paragraph, picture, table


def frf_text(responses: Sequence[MeasuredResponse], reference_hz: float | None) -> str:
    """A table per response with 95 percent intervals, and the remarks below it."""
    lines = []
    for one in responses:
        mean_of = f"mean {shown_unit(one.output_unit)[0]}"
        lines += [_title(one), f"      Hz   magnitude dB      phase deg{mean_of:>11}    harmonics %   periods"]
        for row in _rows(one, reference_hz):
            f, (db, db_half), (deg, deg_half), mean, harmonics, sure, periods = row
            mark = "*" if sure else " "
            lines.append(
                f"{f:8g}  {db:8.3f} ±{db_half:5.3f}  {deg:8.2f} ±{deg_half:5.2f}  {mean:9.4g}"
                f"  {harmonics:9.2f} {mark} {periods:8d}"
            )
        lines += [f"  {remark}" for remark in one.remarks] + [""]
    return "\n".join([*lines, *_legend(reference_hz)])


def frf_data(responses: Sequence[MeasuredResponse], reference_hz: float | None, *, dataset: str) -> dict[str, Any]:
    """Everything that was found; magnitudes in dB, phases in degrees, intervals as standard deviations."""
    return {
        "dataset": dataset,
        "reference_hz": reference_hz,
        "responses": [_response(one, reference_hz) for one in responses],
    }


def frf_section(
    responses: Sequence[MeasuredResponse], reference_hz: float | None, pictures: Mapping[str, bytes]
) -> list[str]:
    """Parts of a page: how it was done, pictures (caption -> SVG), a table per response, remarks."""
    parts = [heading("How it was done"), items(_method()), heading("Responses")]
    parts += [picture(svg, caption) for caption, svg in pictures.items()]
    for one in responses:
        rows = [_cells(row) for row in _rows(one, reference_hz)]
        head = [
            "Hz",
            "magnitude (dB)",
            "±",
            "phase (deg)",
            "±",
            f"mean ({shown_unit(one.output_unit)[0]})",
            "harmonics (%)",
            "periods",
        ]
        parts.append(table(_title(one), head, rows))
        if one.remarks:
            parts.append(items(one.remarks))
    return [*parts, paragraph(" ".join(_legend(reference_hz)))]


def frf_page(
    responses: Sequence[MeasuredResponse],
    reference_hz: float | None,
    *,
    dataset: str,
    pictures: Mapping[str, bytes],
    redo: str,
) -> str:
    """A self-contained HTML page; redo is the command line that makes it again."""
    parts = [*frf_section(responses, reference_hz, pictures), heading("Do it again"), commands(redo)]
    return page("Frequency responses", f"Stepped sines of {dataset}.", parts)


def _title(one: MeasuredResponse) -> str:
    test = one.response.test
    offset, amplitude = (shown_value(x, one.input_unit) for x in (test.offset, test.amplitude))
    held_out = ", held out" if one.use == "validate" else ""
    return f"{test.output} to {test.input} around {offset}, amplitude {amplitude} ({one.response.origin}{held_out})"


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
    return [*(cell(text) for text in numbers), cell(f"{harmonics:.2f}", "differs" if sure else ""), cell(f"{periods}")]


def _method() -> list[str]:
    return [
        "To the command as it was logged a sine of the test's frequency was fitted, and to the output one with its "
        "harmonics, by least squares over the last whole periods, transients left out (thesis Sections 2.2, 2.3).",
        "Magnitude and phase are those of the output's sine against the command's.",
        "Intervals hold 95 percent. They come from the noise that the data set declares where the residuals agree with "
        "it, else from the residuals; where these have a memory, from their spectral density at the frequency.",
    ]


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
        "input": response.test.input,
        "output": response.test.output,
        "offset": response.test.offset,
        "amplitude": response.test.amplitude,
        "input_unit": one.input_unit,
        "output_unit": one.output_unit,
        "origin": response.origin,
        "frequency_hz": response.frequency.tolist(),
        "magnitude_db": magnitude_db(response, reference_hz).tolist(),
        "magnitude_db_deviation": decibel.tolist(),
        "gain": response.gain.tolist(),
        "phase_deg": np.degrees(response.phase).tolist(),
        "phase_deg_deviation": degrees.tolist(),
        "mean": [point.mean for point in one.points],
        "points": [_point(point) for point in one.points],
        "remarks": list(one.remarks),
    }


def _point(point: SinePoint) -> dict[str, Any]:
    return {
        "source": point.source,
        "frequency_hz": point.frequency,
        "periods": point.periods,
        "command_offset": point.command.offset,
        "command_amplitude": point.command.amplitude,
        "harmonics": point.harmonics.tolist(),
        "harmonics_noise": point.harmonics_noise,
        "distorted": point.distorted,
        "residual": point.noise.deviation,
        "basis": point.noise.basis,
        "whiteness": point.noise.whiteness,
        "remarks": list(point.remarks),
    }
