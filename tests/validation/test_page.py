"""The HTML page of a run."""

import pytest
from matplotlib.figure import Figure

from tests.validation import made_up
from tests.validation.made_up import BAD, GOOD, MACHINE, result
from validation.findings import Finding
from validation.page import cost_figure, suite_page
from validation.results import CaseResult


def test_page(monkeypatch: pytest.MonkeyPatch) -> None:
    made_up.use(monkeypatch)
    results = [result("good", *GOOD), result("bad", *BAD, error="ValueError: <no>")]
    text = suite_page(results, (), {"good": {"the caption": Figure()}})
    assert "2 claims hold, 1 fail, 1 could not be tried here. 1 cases stopped early." in text
    for words in (
        "no Wine here",
        "the caption",
        "a note",
        "pysim validate good",
        "About bad",
        "Stopped: ValueError: &lt;no&gt;",
        'class="fail">fails',
    ):
        assert words in text
    assert "Costs over time" not in text


def cost(day: int, seconds: float) -> CaseResult:
    findings = (Finding("a run takes", seconds, 10.0, "s"), Finding("difference", 1e-6, 1e-3, "%"))
    return CaseResult("speed", "", "speed", f"2026-01-0{day}T00:00:00Z", 1.0, 1.0, MACHINE, findings)


def test_costs_over_time() -> None:
    figure = cost_figure([cost(3, 2.0), cost(1, 4.0), result("good", *GOOD)])
    assert figure is not None
    (line,) = figure.axes[0].lines
    assert list(line.get_ydata()) == [4.0, 2.0]
    assert [label.get_text() for label in figure.axes[0].get_xticklabels()] == ["2026-01-01", "2026-01-03"]
    assert cost_figure([result("good", *GOOD)]) is None
