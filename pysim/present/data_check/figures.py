"""What a data set covers, and its logs as small multiples."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple, TypeVar

import numpy as np

from pysim.identify.data_check import DataCheck
from pysim.io import shown_unit
from pysim.present.notes import NOT_FITTED, USES
from pysim.present.render import Picture
from pysim.present.style import COLOURS, DASHES, MEASURED, SMALL, TEXT, frequency_axis, legend_above, panels
from pysim.types import BadInput, Dataset, MeasuredRecord, Record

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from numpy.typing import NDArray

_T = TypeVar("_T")

_COLUMNS = 6  # frequencies shown per operating point
_ROWS = 8  # operating points, or records over time, per picture
_PERIODS = 2.0  # of a sine that are shown
_COMMAND: dict[str, Any] = {"color": MEASURED, "linewidth": 1.0}
_ANSWER: dict[str, Any] = {"color": COLOURS[0], "linewidth": 1.2, "linestyle": DASHES[1]}  # in phase, both are seen


def figures(check: DataCheck) -> Iterator[Picture]:
    """What the stepped sines cover, their last periods, and the other logs over time; each where there are some."""
    dataset = check.dataset
    if any(record.frequency is not None for record in dataset.logs()):
        caption = "Offsets, amplitudes and frequencies of the stepped sines."
        yield Picture("coverage", caption, coverage_figure(dataset))
        caption = "The last two periods of stepped sines: the command, and what answered."
        yield Picture("sines", caption, sine_logs_figure(dataset))
    if any(record.frequency is None for record in dataset.logs()):
        yield Picture("logs", "Logs over time.", time_logs_figure(dataset))


class _Test(NamedTuple):
    """What the stepped sines of one row have in common, the numbers in the command's SI unit."""

    command: str
    offset: float
    amplitude: float


def _test(record: MeasuredRecord) -> _Test:
    return _Test(record.command, record.offset or 0.0, record.amplitude or 0.0)


def coverage_figure(dataset: Dataset) -> Figure:
    """A row per input, offset and amplitude, a dot per stepped sine over its frequency; hollow: not fitted.

    Raises:
        BadInput: no stepped sine among the logs.
    """
    sines = _sines(dataset)
    tests = list(dict.fromkeys(_test(record) for record in sines))
    figure, ((axes,),) = panels(7.5, 1.3 + 0.28 * max(len(tests), 4))  # at least as high as the label
    handles: dict[str, Any] = {}
    for held_out, label, face in ((False, USES["fit"], COLOURS[0]), (True, NOT_FITTED, "white")):
        chosen = [record for record in sines if record.held_out == held_out]
        rows = [tests.index(_test(record)) for record in chosen]
        frequencies = np.array([record.frequency for record in chosen])
        if chosen:
            (handles[label],) = axes.plot(frequencies, rows, "o", color=COLOURS[0], markerfacecolor=face, markersize=6)
    told = [record.frequency for record in sines if record.frequency is not None]
    frequency_axis(axes, 0.8 * min(told), 1.25 * max(told))
    several = len({test.command for test in tests}) > 1
    of = [f"{test.command}: " if several else "" for test in tests]
    labels = [f"{command}{_swing(dataset, test, unit=several)}" for command, test in zip(of, tests, strict=True)]
    axes.set_yticks(range(len(tests)), labels)
    axes.invert_yaxis()
    axes.margins(y=0.5 / len(tests))
    unit = "" if several else f" ({_shown(dataset, tests[0].command)[0]})"
    axes.set(xlabel="Frequency (Hz)", ylabel=f"Offset / amplitude{unit}")
    legend_above(figure, list(handles.values()), list(handles))
    return figure


def _sines(dataset: Dataset) -> list[MeasuredRecord]:
    found = [record for record in dataset.logs() if record.frequency is not None]
    if not found:
        raise BadInput(f"data set {dataset.name!r} has no stepped sines to show")
    return found


def sine_logs_figure(dataset: Dataset) -> Figure:
    """A row per input, offset and amplitude, a panel per frequency: the last two periods of command and answer.

    The answer is the output that most of the logs hold; one in another unit than the row's command has its own
    axis on the right, in its colour. At most eight rows and six columns, spread over what there is.

    Raises:
        BadInput: no stepped sine among the logs.
    """
    sines = _sines(dataset)
    tests = _spread(list(dict.fromkeys(_test(record) for record in sines)), _ROWS)
    frequencies = _spread(sorted({record.frequency for record in sines if record.frequency is not None}), _COLUMNS)
    outputs = Counter(name for record in sines for name in dataset.columns(record, "output"))
    answer = outputs.most_common(1)[0][0]
    commands = list(dict.fromkeys(_shown_name(dataset, record.command) for record in sines))
    size = (1.3 + 1.7 * len(frequencies), 0.9 + 1.2 * len(tests))
    figure, left = panels(*size, len(tests), len(frequencies), sharey="row")
    by_place = {(_test(record), record.frequency): record for record in sines}
    unit = _shown(dataset, answer)[0]
    for i, test in enumerate(tests):
        right = left[i] if _shown(dataset, test.command)[0] == unit else _right_axes(left[i], unit)
        for k, frequency in enumerate(frequencies):
            record = by_place.get((test, frequency))
            left[i, k].set_xticks([0, 1, 2], [] if i < len(tests) - 1 else ["0", "1", "2"])
            left[i, k].set_xlim(0, _PERIODS)
            if record is not None:
                _draw_periods(left[i, k], dataset, record, record.command, _COMMAND)
                _draw_periods(right[k], dataset, record, answer, _ANSWER)
            if i == 0:
                left[i, k].set_title(f"{frequency:g} Hz", fontsize=TEXT)
        of = f"{test.command}\n" if len(commands) > 1 else ""
        left[i, 0].set_ylabel(f"{of}{_swing(dataset, test, unit=True)}", fontsize=SMALL)
    figure.supylabel("Offset / amplitude", fontsize=TEXT)
    figure.supxlabel("Last periods of the log", fontsize=TEXT)
    figure.align_ylabels()
    from matplotlib.lines import Line2D

    lines = [Line2D([], [], **look) for look in (_COMMAND, _ANSWER)]
    legend_above(figure, lines, [commands[0] if len(commands) == 1 else "command", _shown_name(dataset, answer)])
    return figure


def _right_axes(left: NDArray[np.object_], unit: str) -> NDArray[np.object_]:
    """An axis for the answer over every panel of a row, all of one scale, its numbers at the end of the row."""
    right = np.empty_like(left)
    for k, panel in enumerate(left):
        right[k] = panel.twinx()
        right[k].sharey(right[0])
        _quiet_right(right[k], unit if k == len(left) - 1 else None)
    return right


def _quiet_right(axes: Axes, unit: str | None) -> None:
    """The look of an axis on the right, and of one that shows neither numbers nor unit."""
    last, colour = unit is not None, _ANSWER["color"]
    axes.spines[["top", "left", "bottom"]].set_visible(False)
    axes.spines["right"].set(visible=last, color=colour)
    axes.tick_params(labelsize=SMALL, colors=colour, length=3 if last else 0, labelright=last)
    axes.yaxis.get_offset_text().set(fontsize=SMALL, visible=last)
    if last:
        axes.set_ylabel(f"({unit})", fontsize=SMALL, color=colour)


def time_logs_figure(dataset: Dataset) -> Figure:
    """A row per log that is no stepped sine: inputs in black, outputs in colour, each unit with its own panel.

    At most eight logs.

    Raises:
        BadInput: no such log.
    """
    logs = [record for record in dataset.logs() if record.frequency is None][:_ROWS]
    if not logs:
        raise BadInput(f"data set {dataset.name!r} has no logs but stepped sines")
    units = list(dict.fromkeys(_shown(dataset, name)[0] for record in logs for name in _names(record)))
    names = list(dict.fromkeys(name for record in logs for name in _names(record)))
    figure, axes = panels(1.0 + 5.5 * len(units), 0.9 + 1.5 * len(logs), len(logs), len(units))
    for i, record in enumerate(logs):
        for k, unit in enumerate(units):
            panel = axes[i, k]
            shown = [name for name in _names(record) if _shown(dataset, name)[0] == unit]
            if not shown:
                panel.set_axis_off()
                continue
            for name in shown:
                _draw(panel, dataset, record, name, names)
            panel.set_ylabel(f"({unit})")
            panel.set_title(f"{record.source}: {record.kind}, {USES[record.use]}", fontsize=SMALL, loc="left")
    for panel in axes[-1]:
        panel.set_xlabel("Time (s)")
    figure.align_ylabels()
    from matplotlib.lines import Line2D

    lines = [Line2D([], [], **_look(dataset, name, names)) for name in names]
    legend_above(figure, lines, names)
    return figure


def _names(record: MeasuredRecord) -> tuple[str, ...]:
    return record.data.names if isinstance(record.data, Record) else ()


def _shown(dataset: Dataset, name: str) -> tuple[str, float]:
    """The unit on an axis, and how many of it an SI unit is."""
    return shown_unit(dataset.signal(name).unit if name else "")


def _shown_name(dataset: Dataset, name: str) -> str:
    """A signal with the unit of its axis."""
    return f"{name} ({_shown(dataset, name)[0]})"


def _swing(dataset: Dataset, test: _Test, *, unit: bool) -> str:
    """Offset and amplitude as people read them, with the command's unit behind them on request."""
    own, factor = _shown(dataset, test.command)
    numbers = f"{factor * test.offset:g} / {factor * test.amplitude:g}"
    return f"{numbers} {own}" if unit and own not in ("", "-") else numbers


def _look(dataset: Dataset, name: str, names: Sequence[str]) -> dict[str, Any]:
    """Black for inputs, a colour of its own for each output; a dash of its own for each of either."""
    role = dataset.signal(name).role
    k = [other for other in names if dataset.signal(other).role == role].index(name)
    colour = MEASURED if role == "input" else COLOURS[k % len(COLOURS)]
    return {"color": colour, "linestyle": DASHES[k % len(DASHES)], "linewidth": 0.7}


def _draw(panel: Axes, dataset: Dataset, record: MeasuredRecord, name: str, names: Sequence[str]) -> None:
    assert isinstance(record.data, Record)
    values = _shown(dataset, name)[1] * record.data[name]
    panel.plot(record.data.time, values, **_look(dataset, name, names))


def _draw_periods(panel: Axes, dataset: Dataset, record: MeasuredRecord, name: str, look: dict[str, Any]) -> None:
    """One column of the last periods of a sine, where the log holds it; time in periods."""
    if not isinstance(record.data, Record) or name not in record.data.names:
        return
    log, frequency = record.data, float(record.frequency or 1.0)
    phase = (log.time - log.time[-1]) * frequency + _PERIODS
    late = phase >= -1e-9
    panel.plot(phase[late], _shown(dataset, name)[1] * log[name][late], **look)


def _spread(values: list[_T], most: int) -> list[_T]:
    """At most so many of the values, evenly spread, first and last among them."""
    if len(values) <= most:
        return values
    return [values[k] for k in np.unique(np.linspace(0, len(values) - 1, most).round().astype(int))]
