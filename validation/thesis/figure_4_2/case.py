"""Tables 4.3 and 4.1 at 75 percent offset: with a load and without (Figures 4.2 and 4.3)."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

import numpy as np
from matplotlib.figure import Figure

from pysim.identify import frequency_deviations
from pysim.present.style import COLOURS
from pysim.thesis import FREQUENCIES_HZ, loaded_responses, measured_responses
from pysim.types import FrequencyResponse
from validation.findings import Finding
from validation.thesis.drawing import bode_axes, draw, finish


def notes() -> Sequence[str]:
    """What stands in."""
    return ("Transfer functions of Tables 4.1 and 4.3 stand for the measured dots, which were not published.",)


def _pairs(frequencies: Sequence[float]) -> Iterator[tuple[FrequencyResponse, FrequencyResponse]]:
    free = {(r.test.offset, r.test.amplitude): r for r in measured_responses(frequencies)}
    for loaded in loaded_responses(frequencies):
        yield loaded, free[loaded.test.offset, loaded.test.amplitude]


def run() -> Iterator[Finding]:
    """Negligible is taken to be: no larger than a model may be off (Table 1.3)."""
    for loaded, free in _pairs(FREQUENCIES_HZ):
        for deviation in frequency_deviations(loaded, free):
            limit, unit = deviation.criterion.limit, deviation.criterion.unit
            claim = f"amplitude {free.test.amplitude:g} %, load against no load: {deviation.criterion.name}"
            yield Finding(claim, deviation.value, limit, unit)


def pictures() -> Mapping[str, Figure]:
    """Load in blue, without in red, as in the thesis."""
    drawn = {}
    dense = np.concatenate([[0.1], np.geomspace(0.1, 30, 60)[1:]])
    for (loaded, free), name in zip(_pairs(tuple(dense)), ("4.2", "4.3"), strict=True):
        figure, pairs = bode_axes()
        draw(pairs[0], loaded, "orifice as load", color=COLOURS[0], marker="o", linestyle="none", markersize=3.5)
        draw(pairs[0], free, "without load", color=COLOURS[1], marker="^", linestyle="none", markersize=3.5)
        drawn[f"Figure {name} redone: offset 75 %, amplitude {free.test.amplitude:g} %."] = finish(figure, pairs)
    return drawn
