"""The falling error: numbers are the ledger's."""

from pysim.app.figures import error_figure
from tests.pysim.app.figures.ledger import STEPS
from tests.pysim.app.figures.traces import trace


def test_the_staircase_has_every_step_and_an_empty_one_for_what_is_being_found() -> None:
    found = error_figure(STEPS, doing="refitting")
    assert [v for v in trace(found, "fitted")["y"] if v is not None] == [64, 64, 20, 20, 1, 1]
    words = [note["text"] for note in found["layout"]["annotations"]]
    assert {"<b>64</b>", "<b>46</b>", "<b>20</b>", "<b>1.00</b>", "<b>0.90</b>", "noise alone"} == set(words)
    assert found["layout"]["xaxis"]["ticktext"] == ["as it is", "refitted", "+ a&lt;b&gt;", "<i>refitting …</i>"]
    low, high = found["layout"]["yaxis"]["range"]
    assert 10**low < 0.9 < 64 < 10**high


def test_a_staircase_begins_with_the_place_of_its_first_step() -> None:
    found = error_figure([], doing="starting")
    assert found["data"] == []
    assert found["layout"]["xaxis"]["ticktext"] == ["<i>starting …</i>"]
    box = found["layout"]["shapes"][1]
    assert box["x0"] < 0 < box["x1"]
