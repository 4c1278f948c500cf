"""Axes that a reader can read off."""

import pytest

from pysim.plot.style import new_figure, size_axis


@pytest.mark.parametrize(
    ("low", "high", "labels"),
    [
        (0.3, 2.6, ["0.5", "1", "2"]),
        (0.7, 30.0, ["1", "2", "5", "10", "20"]),
        (0.01, 20.0, ["0.01", "0.03", "0.1", "0.3", "1", "3", "10"]),
        (1e-6, 1e6, ["1e-06", "0.0001", "0.01", "1", "100", "10000", "1e+06"]),
    ],
)
def test_sizes_have_plain_numbers(low: float, high: float, labels: list[str]) -> None:
    figure = new_figure(4, 3)
    axes = figure.subplots()
    axes.plot([0, 1], [low, high])
    size_axis(axes)
    axes.set_ylim(low, high)
    figure.draw_without_rendering()
    assert [
        text.get_text().replace("\N{MINUS SIGN}", "-") for text in axes.get_yticklabels() if text.get_text()
    ] == labels
    assert not axes.yaxis.get_minorticklocs().size
