"""Bode plots of measured and simulated responses, in the arrangement of thesis Appendix C."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from pysim.identify import FREQUENCY_CRITERIA, magnitude_db
from pysim.io import shown_point
from pysim.present.style import (
    BAND,
    COLOURS,
    DASHES,
    MEASURED,
    SMALL,
    TEXT,
    frequency_axis,
    legend_above,
    new_figure,
    phase_axis,
    quiet,
)
from pysim.types import BadInput, Comparison, FrequencyResponse, ResponseComparison

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_MAX_DB, _MAX_DEG = FREQUENCY_CRITERIA[1].limit, FREQUENCY_CRITERIA[3].limit


def bode_figure(comparisons: Sequence[Comparison], offset: float) -> Figure:
    """Magnitude (dB, relative to the reference frequency) above phase (deg) over frequency; a column per amplitude.

    Args:
        comparisons: parameter sets against one data set, each in a colour of its own.
        offset: whose tests are shown, in the input's unit.
    Raises:
        BadInput: no test has that offset.
    """
    columns = [[test for test in c.tests if test.measured.test.offset == offset] for c in comparisons]
    if not columns or not columns[0]:
        raise BadInput(f"bode figure: no test at offset {offset:g}")
    count = len(columns[0])
    figure = new_figure(1.2 + 2.9 * count, 5.4)
    axes = figure.subplots(2, count, sharex=True, sharey="row", squeeze=False)
    handles: dict[str, Any] = {}
    for column in range(count):
        tests = [(comparison.label, tests[column]) for comparison, tests in zip(comparisons, columns, strict=True)]
        _draw_column(axes[0, column], axes[1, column], tests, handles, comparisons[0])
    measured = [test.measured.frequency for test in columns[0]]
    frequency_axis(axes[1, 0], min(f[0] for f in measured), max(f[-1] for f in measured))  # shared by all columns
    reference_hz = comparisons[0].reference_hz
    relative = "" if reference_hz is None else f" relative to {reference_hz:g} Hz"
    axes[0, 0].set_ylabel(f"Magnitude{relative} (dB)")
    axes[1, 0].set_ylabel("Phase (deg)")
    phase_axis(axes[1, 0])
    legend_above(figure, list(handles.values()), list(handles))
    return figure


def _draw_column(
    top: Axes,
    bottom: Axes,
    tests: Sequence[tuple[str, ResponseComparison]],
    handles: dict[str, Any],
    comparison: Comparison,
) -> None:
    """One test: the measured response with its band, then every parameter set."""
    measured = tests[0][1].measured
    f, reference_hz, unit = measured.frequency, comparison.reference_hz, comparison.command_unit
    for axes, values, limit in (
        (top, magnitude_db(measured, reference_hz), _MAX_DB),
        (bottom, _degrees(measured), _MAX_DEG),
    ):
        quiet(axes)
        band = axes.fill_between(f, values - limit, values + limit, color=BAND, alpha=0.6, linewidth=0)
        (line,) = axes.plot(f, values, color=MEASURED, linewidth=1.0, marker=".", markersize=5)
        handles.setdefault(comparison.measured_name, line)
        handles.setdefault(f"±{_MAX_DB:g} dB, ±{_MAX_DEG:g} deg (Table 1.3)", band)
    for i, (label, test) in enumerate(tests):
        if test.simulated is None:
            continue
        look: dict[str, Any] = {
            "color": COLOURS[i % len(COLOURS)],
            "linestyle": DASHES[i % len(DASHES)],
            "linewidth": 1.7,
        }
        (line,) = top.plot(f, magnitude_db(test.simulated, reference_hz), **look)
        bottom.plot(f, _degrees(test.simulated, measured), **look)
        handles.setdefault(label, line)
    top.set_title(shown_point(measured.test.offset, measured.test.amplitude, unit), fontsize=TEXT)
    _write_verdicts(top, tests)
    bottom.set_xlabel("Frequency (Hz)")


def _write_verdicts(axes: Axes, tests: Sequence[tuple[str, ResponseComparison]]) -> None:
    """Pass or fail of each parameter set in the lower left corner."""
    for i, (label, test) in enumerate(tests):
        words = f"{label}: {'pass' if test.passes else 'fail'}"
        place = {
            "xytext": (6, 6 + 12 * (len(tests) - 1 - i)),
            "textcoords": "offset points",
            "xycoords": "axes fraction",
        }
        axes.annotate(words, (0, 0), **place, color=COLOURS[i % len(COLOURS)], fontsize=SMALL)  # type: ignore[arg-type]


def _degrees(response: FrequencyResponse, beside: FrequencyResponse | None = None) -> Any:
    """Phase in degrees; in the same turn as the other's at the lowest frequency."""
    turns = 0.0 if beside is None else np.round((response.phase[0] - beside.phase[0]) / (2 * np.pi))
    return np.degrees(response.phase) - 360 * turns
