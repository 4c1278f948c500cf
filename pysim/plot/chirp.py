"""The response to a chirp: tops, bottoms and their mean, in the arrangement of thesis Figures 2.7 and 4.4."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from pysim.identify import HALF_95, magnitude_db
from pysim.identify.chirp import Branch, ChirpAnalysis
from pysim.present.style import COLOURS, MEASURED, TEXT, frequency_axis, legend_above, new_figure, phase_axis, quiet
from pysim.types import FrequencyResponse

_LOOKS: dict[str, dict[str, Any]] = {
    "top": {"color": COLOURS[2], "linestyle": (0, (5, 1.5)), "linewidth": 1.1},
    "bottom": {"color": COLOURS[1], "linestyle": (0, (2, 1)), "linewidth": 1.1},
    "mean": {"color": COLOURS[0], "linestyle": "-", "linewidth": 1.6},
}


def chirp_figure(analysis: ChirpAnalysis, stepped: FrequencyResponse | None = None) -> Figure:
    """Magnitude (dB, absolute) above phase (deg) over frequency; shaded: the mean's 95 percent interval.

    Args:
        stepped: the stepped-sine response of the same working point, as dots.
    """
    figure = new_figure(7.2, 6.4)
    top, bottom = figure.subplots(2, 1, sharex=True)
    branches = {"top": analysis.top, "bottom": analysis.bottom, "mean": analysis.mean}
    handles: dict[str, Artist] = {}
    for name, branch in branches.items():
        handles[name] = _draw(top, bottom, branch, _LOOKS[name], band=name == "mean")
    if stepped is not None:
        look: dict[str, Any] = {"color": MEASURED, "linestyle": "none", "marker": "o", "markersize": 4.0, "zorder": 5}
        (dots,) = top.plot(stepped.frequency, magnitude_db(stepped, None), **look)
        bottom.plot(stepped.frequency, np.degrees(stepped.phase) - 360 * _turns(stepped, analysis.mean), **look)
        handles["stepped sine"] = dots
    for panel in (top, bottom):
        quiet(panel)
    f = [analysis.mean.frequency] if stepped is None else [analysis.mean.frequency, stepped.frequency]
    frequency_axis(bottom, 0.95 * min(float(x[0]) for x in f), 1.05 * max(float(x[-1]) for x in f))
    top.set_ylabel("Magnitude (dB)", fontsize=TEXT)
    bottom.set_ylabel("Phase (deg)", fontsize=TEXT)
    phase_axis(bottom)
    bottom.set_xlabel("Frequency (Hz)", fontsize=TEXT)
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
