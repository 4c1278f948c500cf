"""Parameters on a scale between their bounds."""

from pysim.present.parameters import parameters_chart


def test_parameters_stand_between_their_bounds() -> None:
    row = {"name": "k", "lower": 10.0, "upper": 30.0, "before": (15.0, 5.0, 20.0), "after": None}
    (only,) = parameters_chart([row])["data"]
    assert only["x"] == [25]
    assert (only["error_x"]["array"], only["error_x"]["arrayminus"]) == ([25], [25])  # an interval ends at the bound
