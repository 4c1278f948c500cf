"""The falling error: numbers are the ledger's."""

from pysim.present.diagnosis.figures.error import error_chart
from pysim.types import ErrorStep
from tests.pysim.present.looking import trace

STEPS = [
    ErrorStep("prior", 64.0, 46.0, None, {}, True, 1.0),
    ErrorStep("refit", 20.0, None, None, {}, True, 1.0),
    ErrorStep("a<b>", 1.0, 0.9, None, {}, True, 1.0),
]


def test_the_staircase_has_every_step() -> None:
    found = error_chart(STEPS)
    assert [v for v in trace(found, "fitted")["y"] if v is not None] == [64, 64, 20, 20, 1, 1]
    words = [note["text"] for note in found["layout"]["annotations"]]
    assert {"<b>64</b>", "<b>46</b>", "<b>20</b>", "<b>1.00</b>", "<b>0.90</b>", "noise alone"} == set(words)
    assert found["layout"]["xaxis"]["ticktext"] == ["as it is", "refitted", "+ a&lt;b&gt;"]
    low, high = found["layout"]["yaxis"]["range"]
    assert 10**low < 0.9 < 64 < 10**high


def test_models_side_by_side_are_not_joined() -> None:
    level = error_chart(STEPS, apart=True)["data"][0]
    assert [v is None for v in level["y"]] == [v is None for v in level["x"]] == [False, False, True] * 3


def test_logs_that_nobody_looked_at_have_a_line_of_their_own() -> None:
    found = error_chart(
        [ErrorStep("prior", 8.0, 7.0, 7.5, {}, True, 1.0), ErrorStep("refit", 4.0, 3.0, 3.5, {}, True, 1.0)]
    )
    assert [v for v in trace(found, "held out")["y"] if v is not None] == [7.5, 7.5, 3.5, 3.5]
    assert len({trace(found, name)["line"]["dash"] for name in ("fitted", "used to choose", "held out")}) == 3
    shifts = {note["text"]: (note.get("xshift", 0), note.get("yshift", 0)) for note in found["layout"]["annotations"]}
    assert shifts["<b>8.00</b>"][1] > 0 > shifts["<b>7.00</b>"][1]
    assert shifts["<b>7.50</b>"][0] > 0
