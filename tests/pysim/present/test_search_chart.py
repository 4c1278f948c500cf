"""A search while it runs: a line per model over the points, and what each leaves."""

from pysim.present.diagnosis.figures.search import left_over, search_chart
from tests.pysim.present.looking import trace

TRIALS = [
    {"names": names, "error": error}
    for names, error in (((), 8.0), ((), 4.0), (("a<b>",), 3.0), (("drag", "lag"), 6.0), (("a<b>",), 0.9))
]


def test_what_each_model_leaves_is_the_least_of_its_points() -> None:
    assert left_over(TRIALS) == [("a<b>", 0.9), ("base model", 4.0), ("drag + lag", 6.0)]


def test_the_best_line_and_the_base_models_are_told_from_the_others() -> None:
    found = search_chart(TRIALS)
    best, base = trace(found, "a&lt;b&gt;"), trace(found, "base model")
    assert (best["x"], best["y"]) == ([3, 5], [3.0, 0.9])
    assert (best["line"]["color"], base["line"]["color"]) == ("@final", "@base")
    assert [line["name"] for line in found["data"] if not line["showlegend"]] == ["drag + lag"]
    low, high = found["layout"]["yaxis"]["range"]
    assert 10**low < 0.9 < 8.0 < 10**high


def test_before_anything_is_added_the_base_model_is_the_best() -> None:
    (line,) = search_chart(TRIALS[:2])["data"]
    assert (line["name"], line["line"]["color"]) == ("base model", "@final")
    assert search_chart([])["data"] == []


def test_a_new_search_of_a_model_begins_a_new_line() -> None:
    (line,) = search_chart([{"names": (), "error": error} for error in (8.0, 4.0, 9.0, 3.0)])["data"]
    assert (line["x"], line["y"]) == ([1, 2, 3, 3, 4], [8.0, 4.0, None, 9.0, 3.0])
