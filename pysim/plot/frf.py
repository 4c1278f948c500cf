"""Measured frequency responses with their intervals, and the harmonics beside them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MultipleLocator

from pysim.identify import HALF_95, THESIS_REFERENCE_HZ, MeasuredResponse, magnitude_db, standard_deviations
from pysim.plot.style import COLOURS, DASHES, MARKERS, TEXT, frequency_axis, new_figure, quiet, size_axis
from pysim.types import BadInput

_ROW = 5  # responses per row of the legend


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
    axes[1].yaxis.set_major_locator(MultipleLocator(45.0))
    axes[2].set_ylabel("Harmonics (%)", fontsize=TEXT)
    size_axis(axes[2])
    axes[2].set_xlabel("Frequency (Hz)", fontsize=TEXT)
    figure.align_ylabels(axes)
    labels = [_label(one) for one in responses]
    figure.legend(handles, labels, loc="outside upper center", ncols=_ROW, frameon=False, fontsize=TEXT)
    return figure


def _label(one: MeasuredResponse) -> str:
    test = one.response.test
    return f"{test.offset:+g} ± {test.amplitude:g} {one.input_unit}"


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
