"""Axes that a reader can read off, legends that stay on the page."""

import pytest

from pysim.present.style import frequency_axis, legend_above, new_figure, phase_axis, size_axis
from tests.pysim.present.looking import is_whole, numbers


@pytest.mark.parametrize(
    ("low", "high", "labels"),
    [
        (0.3, 2.6, ["0.5", "1", "2"]),
        (0.7, 30.0, ["1", "2", "5", "10", "20"]),
        (0.01, 20.0, ["0.01", "0.03", "0.1", "0.3", "1", "3", "10"]),
        (1e-6, 1e6, ["1e-06", "0.0001", "0.01", "1", "100", "10000", "1e+06"]),
        (2.1, 4.9, ["2.5", "3", "3.5", "4", "4.5"]),
    ],
)
def test_sizes_have_plain_numbers(low: float, high: float, labels: list[str]) -> None:
    axes = new_figure(4, 3).subplots()
    axes.plot([0, 1], [low, high])
    size_axis(axes)
    axes.set_ylim(low, high)
    assert numbers(axes.yaxis) == labels
    assert not axes.yaxis.get_minorticklocs().size


@pytest.mark.parametrize(
    ("low", "high", "labels"),
    [
        (0.1, 30.0, ["0.1", "0.3", "1", "3", "10", "30"]),  # the thesis' own range
        (0.7, 10.0, ["1", "3", "10"]),
        (0.7, 9.0, ["1", "2", "5"]),
        (12.0, 26.0, ["12.5", "15", "17.5", "20", "22.5", "25"]),
        (1.6, 2.5, ["1.6", "1.8", "2", "2.2", "2.4"]),
        (0.01, 1000.0, ["0.01", "0.1", "1", "10", "100", "1000"]),
        (2.0, 2.0, ["1.8", "1.9", "2", "2.1", "2.2"]),
    ],
)
def test_frequencies_have_plain_numbers_however_narrow_they_are(low: float, high: float, labels: list[str]) -> None:
    axes = new_figure(4, 3).subplots()
    frequency_axis(axes, low, high)
    assert numbers(axes.xaxis) == labels
    assert axes.get_xscale() == "log"
    assert not axes.xaxis.get_minorticklocs().size


@pytest.mark.parametrize(
    ("low", "high", "labels"),
    [
        (-170.0, 3.0, ["-135", "-90", "-45", "0"]),
        (-290.0, 10.0, ["-270", "-180", "-90", "0"]),
        (-730.0, -80.0, ["-720", "-540", "-360", "-180"]),
        (-5000.0, 0.0, ["-4320", "-3600", "-2880", "-2160", "-1440", "-720", "0"]),
        (-158.0, -124.0, ["-150", "-140", "-130"]),
        (-1.1, -0.2, ["-1.0", "-0.8", "-0.6", "-0.4", "-0.2"]),
    ],
)
def test_phases_are_read_in_parts_of_a_turn_or_in_even_steps(low: float, high: float, labels: list[str]) -> None:
    axes = new_figure(4, 3).subplots()
    phase_axis(axes)
    axes.set_ylim(low, high)
    assert numbers(axes.yaxis) == labels


@pytest.mark.parametrize(("labels", "rows"), [(4 * ["A"], 1), (6 * ["+100 ± 10 bar"], 2), (["x" * 60, "y" * 60], 2)])
def test_a_legend_takes_as_few_rows_as_fit(labels: list[str], rows: int) -> None:
    figure = new_figure(7.2, 3.0)
    lines = figure.subplots().plot([[0.0] * len(labels), [1.0] * len(labels)])
    legend_above(figure, lines, labels)
    figure.draw_without_rendering()
    (legend,) = figure.legends
    assert [text.get_text() for text in legend.get_texts()] == labels
    assert len({round(text.get_window_extent().y0) for text in legend.get_texts()}) == rows
    assert is_whole(figure)
    assert (figure.get_figheight() > 3.0) == (rows > 1)  # the axes keep their height
