"""Pictures of models against measured responses: Bode plots as in thesis Appendix C, and deviations by criterion."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np

from pysim.identify import FREQUENCY_CRITERIA, THESIS_REFERENCE_HZ, magnitude_db
from pysim.io import shown_point, shown_unit, shown_value
from pysim.present import style
from pysim.present.charts import LOOKS, Chart, axis, between, chart, plain
from pysim.present.comparison.answer import Comparisons
from pysim.present.render import Picture
from pysim.types import BadInput, Comparison, Criterion, FrequencyResponse, ResponseComparison

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_MAX_DB, _MAX_DEG = FREQUENCY_CRITERIA[1].limit, FREQUENCY_CRITERIA[3].limit
_ALL = "deviations"
_NEAR = 1e-3  # of the reference, by which the frequency of a log may be off, as in pysim.identify.greybox.stepped_sines
_NUMBERS = 6  # wanted along the frequencies; of two decades and more Plotly then takes 1, 2 and 5


def figures(result: Comparisons) -> Iterator[Picture]:
    """The deviation of every test, and a Bode plot per offset."""
    return (comparison_picture(result.sets, name) for name in picture_names(result.sets))


def picture_names(sets: Sequence[Comparison]) -> list[str]:
    """Of all pictures, in their order."""
    return [_ALL, *_offsets(sets)]


def comparison_picture(sets: Sequence[Comparison], name: str) -> Picture:
    """One of them; drawing is what takes time, so that several processes may share it."""
    if name == _ALL:
        caption = "Deviation of every test, criterion by criterion; hollow: beyond the limit."
        return Picture(name, caption, deviation_figure(sets))
    offset, first = _offsets(sets)[name], sets[0]
    around = shown_value(offset, first.command_unit)
    caption = f"Offset {around}: {first.measured_name}, and simulated; grey: what is allowed."
    return Picture(name, caption, bode_figure(sets, offset))


def _offsets(sets: Sequence[Comparison]) -> dict[str, float]:
    """Name of a Bode plot -> offset of its tests."""
    return {f"bode_O{offset:+g}": offset for offset in sorted({test.measured.test.offset for test in sets[0].tests})}


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
    figure, axes = style.panels(1.2 + 2.9 * count, 5.4, 2, count, sharex=True, sharey="row")
    handles: dict[str, Any] = {}
    for column in range(count):
        tests = [(comparison.label, tests[column]) for comparison, tests in zip(comparisons, columns, strict=True)]
        _draw_column(axes[0, column], axes[1, column], tests, handles, comparisons[0])
    measured = [test.measured.frequency for test in columns[0]]
    style.frequency_axis(axes[1, 0], min(f[0] for f in measured), max(f[-1] for f in measured))  # shared by all columns
    reference_hz = comparisons[0].reference_hz
    relative = "" if reference_hz is None else f" relative to {reference_hz:g} Hz"
    axes[0, 0].set_ylabel(f"Magnitude{relative} (dB)")
    axes[1, 0].set_ylabel("Phase (deg)")
    style.phase_axis(axes[1, 0])
    style.legend_above(figure, list(handles.values()), list(handles))
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
        band = axes.fill_between(f, values - limit, values + limit, color=style.BAND, alpha=0.6, linewidth=0)
        (line,) = axes.plot(f, values, color=style.MEASURED, linewidth=1.0, marker=".", markersize=5)
        handles.setdefault(comparison.measured_name, line)
        handles.setdefault(f"±{_MAX_DB:g} dB, ±{_MAX_DEG:g} deg (Table 1.3)", band)
    for i, (label, test) in enumerate(tests):
        if test.simulated is None:
            continue
        look = style.look(i, "linestyle")
        (line,) = top.plot(f, magnitude_db(test.simulated, reference_hz), **look, linewidth=1.7)
        bottom.plot(f, _degrees(test.simulated, measured), **look, linewidth=1.7)
        handles.setdefault(label, line)
    top.set_title(shown_point(measured.test.offset, measured.test.amplitude, unit), fontsize=style.TEXT)
    _write_verdicts(top, tests)
    bottom.set_xlabel("Frequency (Hz)")


def _write_verdicts(axes: Axes, tests: Sequence[tuple[str, ResponseComparison]]) -> None:
    """Pass or fail of each parameter set in the lower left corner."""
    for i, (label, test) in enumerate(tests):
        words = f"{label}: {'pass' if test.passes else 'fail'}"
        away = (6, 6 + 12 * (len(tests) - 1 - i))
        style.small_text(axes, words, (0, 0), away, xycoords="axes fraction", **style.look(i))


def _degrees(response: FrequencyResponse, beside: FrequencyResponse | None = None) -> Any:
    """Phase in degrees; in the same turn as the other's at the lowest frequency."""
    turns = 0.0 if beside is None else np.round((response.phase[0] - beside.phase[0]) / (2 * np.pi))
    return np.degrees(response.phase) - 360 * turns


def deviation_figure(comparisons: Sequence[Comparison]) -> Figure:
    """A panel per criterion of Table 1.3, a row per test (offset / amplitude), the limit as the edge of a grey field.

    Filled markers are within the limit, hollow ones are not. A run that failed has no marker.
    """
    tests = [response.measured.test for response in comparisons[0].tests]
    height = 1.4 + 0.21 * max(len(tests), 5)  # at least as high as the label
    figure, ((*axes,),) = style.panels(10.0, height, 1, len(FREQUENCY_CRITERIA), sharey=True)
    handles = []
    for column, criterion in enumerate(FREQUENCY_CRITERIA):
        panel = axes[column]
        for i, comparison in enumerate(comparisons):
            values = _values(comparison, column)
            inside, outside = values <= criterion.limit, values > criterion.limit
            rows = np.arange(values.size)
            look = {**style.look(i, "marker"), "linestyle": "none", "markersize": 5.5}
            (filled,) = panel.plot(values[inside], rows[inside], **look)
            panel.plot(values[outside], rows[outside], **look, markerfacecolor="white")
            if column == 0:
                handles.append(filled)
        _draw_limit(panel, criterion, max(float(np.nanmax(_values(c, column), initial=0.0)) for c in comparisons))
    unit, factor = shown_unit(comparisons[0].command_unit)
    axes[0].set_yticks(range(len(tests)), [f"{factor * test.offset:g} / {factor * test.amplitude:g}" for test in tests])
    axes[0].invert_yaxis()
    axes[0].set_ylabel(f"Offset / amplitude ({unit})")
    style.legend_above(figure, handles, [c.label for c in comparisons])
    return figure


def _values(comparison: Comparison, column: int) -> np.ndarray:
    """One criterion over the tests, (n_tests,); NaN where a run failed."""
    return np.array([test.deviations[column].value if test.deviations else np.nan for test in comparison.tests])


def _draw_limit(panel: Axes, criterion: Criterion, largest: float) -> None:
    right = 1.08 * max(largest, 1.15 * criterion.limit)
    panel.axvspan(criterion.limit, right, color=style.LIMIT, alpha=0.14, linewidth=0)
    panel.axvline(criterion.limit, color=style.LIMIT, linewidth=1.0)
    panel.set_title(f"{criterion.name}\nlimit {criterion.limit:g} {criterion.unit}", fontsize=style.SMALL)
    panel.set(xlabel=criterion.unit, xlim=(0.0, right))


def bode_chart(response: Mapping[str, Any], models: Sequence[tuple[str, str, Mapping[str, Any]]]) -> Chart:
    """Magnitude above phase, measured with the band of thesis Table 1.3 around it, and the models.

    Args:
        response: measured, `frequency` Hz, `gain`, `phase` rad.
        models: key of LOOKS, words, and the simulated `gain` and `phase`.
    """
    f, measured, reference = response["frequency"], response["measured"], reference_place(response["frequency"])
    relative = ", absolute" if reference is None else f" relative to {f[reference]:g} Hz"
    told = f"± {_MAX_DB:g} dB, ± {_MAX_DEG:g}° (Table 1.3)"
    shown: tuple[tuple[Callable[..., list[float]], float, str], ...]
    shown = ((partial(_decibels, reference=reference), _MAX_DB, "dB"), (_degrees_of, _MAX_DEG, "°"))
    data: list[Chart] = []
    for panel, (curve, limit, unit) in enumerate(shown):
        y, more = curve(measured), {"xaxis": "x", "yaxis": "y2" if panel else "y", "showlegend": not panel}
        low, high = [v - limit for v in y], [v + limit for v in y]
        data.append(between(f, low, high, "@band", name=told, legendgroup="band", **more))
        for key, words, side in [("measured", "measured", measured), *models]:
            _, colour, dash = LOOKS[key]
            values = curve(side)
            turn = 360 * round((values[0] - y[0]) / 360) if panel else 0
            line = {"x": f, "y": [v - turn for v in values], "line": {"color": colour, "width": 2, "dash": dash}}
            marks = {"mode": "lines+markers", "marker": {"size": 6, "color": colour}}
            hover = f"{plain(words)}: %{{y:.2f}} {unit} at %{{x:g}} Hz<extra></extra>"
            line |= {"mode": "lines", **(marks if key == "measured" else {}), **more}
            data.append({**line, "name": plain(words), "legendgroup": key, "hovertemplate": hover})
    return chart(
        data,
        xaxis=axis("Frequency (Hz)", type="log", nticks=_NUMBERS, tickformat="~g", anchor="y2"),
        yaxis=axis(f"Magnitude{relative} (dB)", domain=[0.53, 1]),
        yaxis2=axis("Phase (°)", domain=[0, 0.47], dtick=45 if max(map(abs, _degrees_of(measured))) > 60 else None),
    )


def reference_place(frequency: Sequence[float]) -> int | None:
    """Place of the frequency (Hz) whose gain counts as 0 dB on both sides where a response is judged; None: none does.

    A file of stages does not tell it. Logs of stepped sines are judged relative to 0.1 Hz where one of them is at that
    frequency, and as they are where none is; tables always have it.
    """
    near = np.flatnonzero(np.isclose(frequency, THESIS_REFERENCE_HZ, rtol=_NEAR))
    return int(near[0]) if near.size else None


def _decibels(side: Mapping[str, Any], *, reference: int | None) -> list[float]:
    """Magnitude over that at the place of the reference, or as it is."""
    base = 1.0 if reference is None else side["gain"][reference]
    return [20 * math.log10(v / base) for v in side["gain"]]


def _degrees_of(side: Mapping[str, Any]) -> list[float]:
    return [math.degrees(v) for v in side["phase"]]
