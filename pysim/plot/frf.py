"""Measured frequency responses with their intervals, and the harmonics beside them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from pysim.identify import HALF_95, THESIS_REFERENCE_HZ, MeasuredResponse, magnitude_db, standard_deviations
from pysim.io import shown_unit, shown_value
from pysim.plot.style import (
    COLOURS,
    DASHES,
    MARKERS,
    TEXT,
    frequency_axis,
    legend_above,
    new_figure,
    phase_axis,
    quiet,
    size_axis,
)
from pysim.types import BadInput


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
    figure = new_figure(7.2, 7.6)
    axes = figure.subplots(3, 1, sharex=True, height_ratios=(1.3, 1.3, 0.8))
    handles = []
    for i, one in enumerate(responses):
        look: dict[str, Any] = {
            "color": COLOURS[i % len(COLOURS)],
            "linestyle": DASHES[i % len(DASHES)],
            "marker": MARKERS[i % len(MARKERS)],
            "markersize": 3.5,
            "linewidth": 1.0,
        }
        handles.append(_draw(axes, one, reference_hz, look))
    for panel in axes:
        quiet(panel)
    f = np.concatenate([one.response.frequency for one in responses])
    frequency_axis(axes[2], 0.93 * float(f.min()), 1.07 * float(f.max()))
    relative = "" if reference_hz is None else f" relative to {reference_hz:g} Hz"
    axes[0].set_ylabel(f"Magnitude{relative} (dB)", fontsize=TEXT)
    axes[1].set_ylabel("Phase (deg)", fontsize=TEXT)
    phase_axis(axes[1])
    axes[2].set_ylabel("Harmonics (%)", fontsize=TEXT)
    size_axis(axes[2])
    axes[2].set_xlabel("Frequency (Hz)", fontsize=TEXT)
    figure.align_ylabels(axes)
    several = len({(one.response.test.input, one.response.test.output) for one in responses}) > 1
    legend_above(figure, handles, [_label(one, signals=several) for one in responses])
    return figure


def _label(one: MeasuredResponse, *, signals: bool) -> str:
    """Offset and amplitude, with output and input ahead of them on request."""
    test = one.response.test
    of = f"{test.output} to {test.input}, " if signals else ""
    offset = shown_unit(one.input_unit)[1] * test.offset
    held_out = ", held out" if one.use == "validate" else ""
    return f"{of}{offset:+g} ± {shown_value(test.amplitude, one.input_unit)}{held_out}"


def _draw(axes: Sequence[Axes], one: MeasuredResponse, reference_hz: float | None, look: dict[str, Any]) -> Any:
    response = one.response
    f = response.frequency
    decibel, degrees = standard_deviations(response, reference_hz)
    magnitude, phase = magnitude_db(response, reference_hz), np.degrees(response.phase)
    bars: dict[str, Any] = {"elinewidth": 0.9, "capsize": 2.0}
    handle = axes[0].errorbar(f, magnitude, yerr=HALF_95 * decibel, **look, **bars)
    axes[1].errorbar(f, phase, yerr=HALF_95 * degrees, **look, **bars)
    distortion = 100 * np.array([point.distortion for point in one.points])
    sure = np.array([point.distorted for point in one.points])
    axes[2].plot(f, distortion, **{**look, "marker": "none"})
    axes[2].plot(f[sure], distortion[sure], **{**look, "linestyle": "none"})
    axes[2].plot(f[~sure], distortion[~sure], **{**look, "linestyle": "none"}, markerfacecolor="white")
    return handle
