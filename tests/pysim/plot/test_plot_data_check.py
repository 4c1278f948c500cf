"""Pictures of a data set: every log where it belongs, and units that engineers read."""

import numpy as np
import pytest

from pysim.plot.data_check import coverage_figure, sine_logs_figure, time_logs_figure
from pysim.types import BadInput, Dataset, MeasuredRecord, MeasuredSignal, Record

SIGNALS = (
    MeasuredSignal("p", "input", "Pa", "", "p"),
    MeasuredSignal("w", "output", "rad/s", "", "w"),
    MeasuredSignal("q", "output", "Pa", "", "q"),
)
TIME = np.linspace(0, 4, 401)


def record(frequency: float | None, offset: float = 2e5, use: str = "fit") -> MeasuredRecord:
    swing = np.sin(2 * np.pi * (frequency or 1.0) * TIME)
    log = Record(
        TIME, np.column_stack([offset + 1e5 * swing, swing, 3e5 + 2e5 * swing]), ("p", "w", "q"), ("Pa", "rad/s", "Pa")
    )
    kind = "other" if frequency is None else "frequency-response"
    amplitude = None if frequency is None else 1e5
    return MeasuredRecord(f"{frequency}_{offset:g}", kind, use, log, offset, amplitude, frequency, command="p")


def dataset(*records: MeasuredRecord) -> Dataset:
    return Dataset("d", "-", "-", SIGNALS, records)


def test_coverage_has_a_dot_per_sine() -> None:
    data = dataset(record(1.0), record(5.0, use="validate"), record(5.0, -4e5), record(None))
    (axes,) = coverage_figure(data).axes
    fit, held = axes.get_lines()
    np.testing.assert_array_equal(fit.get_xydata(), [[1.0, 0], [5.0, 1]])
    np.testing.assert_array_equal(held.get_xydata(), [[5.0, 0]])
    assert [label.get_text() for label in axes.get_yticklabels()] == ["2 / 1", "-4 / 1"]
    assert axes.get_ylabel() == "Offset / amplitude (bar)"


def test_sines_show_their_last_two_periods_in_bar() -> None:
    data = dataset(*(record(f, offset) for f in (1.0, 2.0) for offset in (2e5, -4e5)))
    axes = sine_logs_figure(data).axes
    assert len(axes) == 4
    (command,) = axes[2].get_lines()  # -4 bar at 1 Hz; the first output is a speed and has no place on this axis
    periods, values = command.get_xydata().T
    assert (periods[0], periods[-1]) == (pytest.approx(0), pytest.approx(2))
    np.testing.assert_allclose(values, -4 + np.sin(2 * np.pi * periods), atol=1e-9)


def test_many_tests_are_thinned_evenly() -> None:
    data = dataset(*(record(float(f), 1e5 * o) for f in range(1, 20) for o in range(12)))
    figure = sine_logs_figure(data)
    assert len(figure.axes) == 8 * 6
    titles = [axes.get_title() for axes in figure.axes[:6]]
    assert (titles[0], titles[-1]) == ("1 Hz", "19 Hz")


def test_logs_over_time_have_a_panel_per_unit() -> None:
    figure = time_logs_figure(dataset(record(None), record(1.0)))
    pressures, speed = figure.axes
    assert (pressures.get_ylabel(), speed.get_ylabel()) == ("(bar)", "(rpm)")
    assert len(pressures.get_lines()) == 2
    np.testing.assert_allclose(speed.get_lines()[0].get_ydata(), np.sin(2 * np.pi * TIME) * 30 / np.pi)


@pytest.mark.parametrize(
    ("draw", "other"), [(coverage_figure, None), (sine_logs_figure, None), (time_logs_figure, 1.0)]
)
def test_nothing_to_draw_is_said(draw: object, other: float | None) -> None:
    with pytest.raises(BadInput, match="data set 'd' has no"):
        draw(dataset(record(other)))  # type: ignore[operator]
