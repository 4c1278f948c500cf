"""Pictures of a data set: every log where it belongs, and units that engineers read."""

from dataclasses import replace

import numpy as np
import pytest

from pysim.present.data_check.figures import coverage_figure, sine_logs_figure, time_logs_figure
from pysim.types import BadInput, Dataset, MeasuredRecord, MeasuredSignal, Record
from tests.pysim.present.looking import numbers

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


def answered(one: MeasuredRecord, name: str) -> MeasuredRecord:
    """The same log with a single output."""
    assert isinstance(one.data, Record)
    k = [0, one.data.names.index(name)]
    names, units = (tuple(of[i] for i in k) for of in (one.data.names, one.data.units))
    return replace(one, data=Record(TIME, one.data.values[:, k], names, units))


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


def test_a_single_frequency_is_told() -> None:
    figure = coverage_figure(dataset(record(2.0)))
    assert numbers(figure.axes[0].xaxis) == ["1.6", "1.8", "2", "2.2", "2.4"]


def test_sines_show_the_last_two_periods_of_command_and_answer() -> None:
    figure = sine_logs_figure(dataset(*(record(f, offset) for f in (1.0, 2.0) for offset in (2e5, -4e5))))
    assert len(figure.axes) == 4 * 2
    (command,), (answer,) = figure.axes[2].get_lines(), figure.axes[6].get_lines()  # -4 bar at 1 Hz
    periods, values = command.get_xydata().T
    assert (periods[0], periods[-1]) == (pytest.approx(0), pytest.approx(2))
    np.testing.assert_allclose(values, -4 + np.sin(2 * np.pi * periods), atol=1e-9)
    periods, values = answer.get_xydata().T
    np.testing.assert_allclose(values, 30 / np.pi * np.sin(2 * np.pi * periods), atol=1e-9)
    assert [text.get_text() for text in figure.legends[0].get_texts()] == ["p (bar)", "w (rpm)"]
    assert figure.axes[2].get_ylabel() == "-4 / 1 bar"
    assert [axes.get_ylabel() for axes in figure.axes[4:]] == ["", "(rpm)"] * 2
    assert figure.axes[6].get_ylim() == figure.axes[7].get_ylim()


def test_an_answer_in_the_unit_of_the_command_shares_its_axis() -> None:
    figure = sine_logs_figure(dataset(answered(record(1.0), "q"), answered(record(2.0), "q")))
    assert len(figure.axes) == 2
    command, answer = figure.axes[0].get_lines()
    np.testing.assert_allclose(answer.get_ydata() - 3, 2 * (command.get_ydata() - 2), atol=1e-9)


def test_the_answer_is_the_one_that_most_logs_hold() -> None:
    figure = sine_logs_figure(dataset(answered(record(1.0), "q"), *(answered(record(f), "w") for f in (2.0, 3.0))))
    assert [len(axes.get_lines()) for axes in figure.axes[3:]] == [0, 1, 1]
    assert figure.legends[0].get_texts()[1].get_text() == "w (rpm)"


def test_many_tests_are_thinned_evenly() -> None:
    figure = sine_logs_figure(dataset(*(answered(record(float(f)), "q") for f in range(1, 20))))
    assert [axes.get_title() for axes in figure.axes] == ["1 Hz", "5 Hz", "8 Hz", "12 Hz", "15 Hz", "19 Hz"]


TWO = Dataset(
    "d", "-", "-", (*SIGNALS, replace(SIGNALS[0], name="p_2"), MeasuredSignal("u", "input", "%", "", "u")), ()
)


def driven(one: MeasuredRecord, name: str, scale: float = 1.0) -> MeasuredRecord:
    """The same test on another input, whose numbers are that many times as large."""
    assert isinstance(one.data, Record)
    values, units = one.data.values * [scale, 1, 1], (TWO.signal(name).unit, *one.data.units[1:])
    log = Record(TIME, values, (name, "w", "q"), units)
    return replace(one, data=log, command=name, offset=scale * (one.offset or 0), amplitude=scale * 1e5)


def test_inputs_of_the_same_numbers_have_rows_of_their_own() -> None:
    data = replace(TWO, records=(record(1.0), driven(record(1.0), "p_2"), driven(record(2.0), "p_2")))
    (axes,) = coverage_figure(data).axes
    np.testing.assert_array_equal(axes.get_lines()[0].get_xydata(), [[1.0, 0], [1.0, 1], [2.0, 1]])
    assert [label.get_text() for label in axes.get_yticklabels()] == ["p: 2 / 1 bar", "p_2: 2 / 1 bar"]
    figure = sine_logs_figure(data)
    assert [len(axes.get_lines()) for axes in figure.axes[:4]] == [1, 0, 1, 1]
    assert [figure.axes[k].get_ylabel() for k in (0, 2)] == ["p\n2 / 1 bar", "p_2\n2 / 1 bar"]
    assert [text.get_text() for text in figure.legends[0].get_texts()] == ["command", "w (rpm)"]


def test_inputs_of_different_units_are_each_told_in_their_own() -> None:
    data = replace(TWO, records=(driven(record(1.0), "u", 1e-4), record(1.0)))
    (axes,) = coverage_figure(data).axes
    assert [label.get_text() for label in axes.get_yticklabels()] == ["u: 20 / 10 %", "p: 2 / 1 bar"]
    assert axes.get_ylabel() == "Offset / amplitude"


def test_an_answer_shares_the_axis_of_those_rows_whose_command_has_its_unit() -> None:
    pressures = tuple(answered(one, "q") for one in (driven(record(1.0), "u", 1e-4), record(1.0)))
    figure = sine_logs_figure(replace(TWO, records=pressures))
    percent, bar, answer = figure.axes
    assert (percent.get_ylabel(), bar.get_ylabel(), answer.get_ylabel()) == ("u\n20 / 10 %", "p\n2 / 1 bar", "(bar)")
    assert [len(axes.get_lines()) for axes in figure.axes] == [1, 2, 1]
    np.testing.assert_allclose(np.ptp(percent.get_lines()[0].get_ydata()), 20)


def test_logs_over_time_have_a_panel_per_unit() -> None:
    figure = time_logs_figure(dataset(record(None), record(1.0)))
    pressures, speed = figure.axes
    assert (pressures.get_ylabel(), speed.get_ylabel()) == ("(bar)", "(rpm)")
    assert len(pressures.get_lines()) == 2
    np.testing.assert_allclose(speed.get_lines()[0].get_ydata(), np.sin(2 * np.pi * TIME) * 30 / np.pi)


def test_signals_of_one_role_differ_by_dash_too() -> None:
    second = replace(SIGNALS[2], role="input")
    both = Dataset("d", "", "", (*SIGNALS[:2], second), (record(None),))
    one, other = time_logs_figure(both).axes[0].get_lines()
    assert one.get_color() == other.get_color()
    assert one.get_linestyle() != other.get_linestyle()


@pytest.mark.parametrize(
    ("draw", "other"), [(coverage_figure, None), (sine_logs_figure, None), (time_logs_figure, 1.0)]
)
def test_nothing_to_draw_is_said(draw: object, other: float | None) -> None:
    with pytest.raises(BadInput, match="data set 'd' has no"):
        draw(dataset(record(other)))  # type: ignore[operator]
