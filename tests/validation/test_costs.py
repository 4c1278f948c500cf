"""Costs over time."""

from dataclasses import replace

from tests.validation.made_up import GOOD, MACHINE, costly, result
from validation.costs import cost_figure, cost_rows, newest_costs, points


def test_points_come_oldest_first_and_the_last_of_each_side_counts() -> None:
    runs = [costly(3, 2.0, 6.0), costly(1, 4.0, 5.0), costly(2, 3.0), result("good", *GOOD)]
    assert [point.cost.ours for point in points(runs)] == [4.0, 3.0, 2.0]
    assert [(point.cost.peer, point.cost.ours) for point in newest_costs(runs)] == [("a plain loop", 2.0), ("", 3.0)]
    first, second = cost_rows(runs)
    assert first == ["a step", "2", "us", "a plain loop", "6", "3", "speed", "2026-01-03"]
    assert second[3:6] == ["", "", ""]


def test_a_line_per_side_and_machine() -> None:
    other = replace(MACHINE, cores=8)
    figure = cost_figure([costly(3, 2.0, 6.0), costly(1, 4.0, 5.0), costly(2, 9.0, 9.5, other)])
    assert figure is not None
    drawn = [list(line.get_ydata()) for line in figure.axes[0].lines if len(line.get_ydata())]
    assert sorted(drawn) == [[4.0, 2.0], [5.0, 6.0], [9.0], [9.5]]
    assert figure.axes[0].get_ylabel() == "us"
    assert cost_figure([result("good", *GOOD)]) is None
