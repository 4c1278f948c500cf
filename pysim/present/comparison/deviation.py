"""How far each test is from its measurement, criterion by criterion."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from pysim.identify import FREQUENCY_CRITERIA
from pysim.io import shown_unit
from pysim.present.style import COLOURS, LIMIT, MARKERS, SMALL, legend_above, new_figure, quiet
from pysim.types import Comparison, Criterion

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


def deviation_figure(comparisons: Sequence[Comparison]) -> Figure:
    """A panel per criterion of Table 1.3, a row per test (offset / amplitude), the limit as the edge of a grey field.

    Filled markers are within the limit, hollow ones are not. A run that failed has no marker.
    """
    tests = [response.measured.test for response in comparisons[0].tests]
    figure = new_figure(10.0, 1.4 + 0.21 * max(len(tests), 5))  # at least as high as the label
    axes = figure.subplots(1, len(FREQUENCY_CRITERIA), sharey=True)
    handles = []
    for column, criterion in enumerate(FREQUENCY_CRITERIA):
        panel = axes[column]
        quiet(panel)
        for i, comparison in enumerate(comparisons):
            values = _values(comparison, column)
            colour, marker = COLOURS[i % len(COLOURS)], MARKERS[i % len(MARKERS)]
            inside, outside = values <= criterion.limit, values > criterion.limit
            rows = np.arange(values.size)
            look: dict[str, Any] = {"color": colour, "marker": marker, "linestyle": "none", "markersize": 5.5}
            (filled,) = panel.plot(values[inside], rows[inside], **look)
            panel.plot(values[outside], rows[outside], **look, markerfacecolor="white")
            if column == 0:
                handles.append(filled)
        _draw_limit(panel, criterion, max(float(np.nanmax(_values(c, column), initial=0.0)) for c in comparisons))
    unit, factor = shown_unit(comparisons[0].command_unit)
    axes[0].set_yticks(range(len(tests)), [f"{factor * test.offset:g} / {factor * test.amplitude:g}" for test in tests])
    axes[0].invert_yaxis()
    axes[0].set_ylabel(f"Offset / amplitude ({unit})")
    legend_above(figure, handles, [c.label for c in comparisons])
    return figure


def _values(comparison: Comparison, column: int) -> np.ndarray:
    """One criterion over the tests, (n_tests,); NaN where a run failed."""
    return np.array([test.deviations[column].value if test.deviations else np.nan for test in comparison.tests])


def _draw_limit(panel: Axes, criterion: Criterion, largest: float) -> None:
    right = 1.08 * max(largest, 1.15 * criterion.limit)
    panel.axvspan(criterion.limit, right, color=LIMIT, alpha=0.14, linewidth=0)
    panel.axvline(criterion.limit, color=LIMIT, linewidth=1.0)
    panel.set_xlim(0.0, right)
    panel.set_title(f"{criterion.name}\nlimit {criterion.limit:g} {criterion.unit}", fontsize=SMALL)
    panel.set_xlabel(criterion.unit)
