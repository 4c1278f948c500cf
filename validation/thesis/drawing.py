"""Bode plots as the thesis draws them: magnitude above phase, dots for what is measured."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MultipleLocator

from pysim.identify import magnitude_db
from pysim.present.style import TEXT, frequency_axis, legend_above, new_figure, quiet
from pysim.types import FrequencyResponse


def bode_axes(columns: int = 1) -> tuple[Figure, list[tuple[Axes, Axes]]]:
    """A figure with pairs of axes, magnitude above phase."""
    figure = new_figure(1.0 + (5.6 if columns == 1 else 4.4 * columns), 4.6)
    grid = figure.subplots(2, columns, sharex=True, sharey="row", squeeze=False)
    pairs = [(grid[0, k], grid[1, k]) for k in range(columns)]
    for top, bottom in pairs:
        quiet(top)
        quiet(bottom)
        bottom.set_xlabel("Frequency (Hz)", fontsize=TEXT)
        bottom.yaxis.set_major_locator(MultipleLocator(45.0))
    pairs[0][0].set_ylabel("Magnitude (dB)", fontsize=TEXT)
    pairs[0][1].set_ylabel("Phase (deg)", fontsize=TEXT)
    return figure, pairs


def draw(pair: tuple[Axes, Axes], response: FrequencyResponse, label: str, **look: object) -> None:
    """One response, relative to 0.1 Hz; its phase starts within half a turn of zero."""
    f = response.frequency
    degrees = np.degrees(response.phase)
    degrees = degrees - 360 * np.round(degrees[0] / 360)
    reference = 0.1 if np.any(np.isclose(f, 0.1)) else None
    pair[0].plot(f, magnitude_db(response, reference), label=label, **look)  # type: ignore[arg-type]
    pair[1].plot(f, degrees, label=label, **look)  # type: ignore[arg-type]


def finish(figure: Figure, pairs: Sequence[tuple[Axes, Axes]], low: float = 0.1, high: float = 30.0) -> Figure:
    """Frequency axis and legend."""
    for _, bottom in pairs:
        frequency_axis(bottom, 0.95 * low, 1.05 * high)
    handles, labels = pairs[0][0].get_legend_handles_labels()
    legend_above(figure, handles, labels)
    return figure
