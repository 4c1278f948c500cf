"""What the page Add says beside the numbers."""

from pysim.app.pages.add import _three


def test_a_value_at_its_bound_is_said_in_red_and_one_that_is_not_determined_has_no_interval() -> None:
    inside = {"value": 2.0, "lower": 1.0, "upper": 3.0, "low": 1.5, "high": 2.5, "determined": True}
    assert _three(inside) == ["2", "1.5", "2.5"]
    at = {**inside, "value": 3.0, "determined": False}
    assert _three(at) == [{"text": "3 AT BOUND", "value": 3.0, "mark": "high"}, "–", "–"]
    assert _three(None) == ["", "", ""]
