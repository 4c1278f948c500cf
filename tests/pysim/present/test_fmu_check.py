"""What was found about an FMU, in words and on a page."""

from pathlib import Path

from pysim.fmu_check import CheckResult, FmuReport
from pysim.present.fmu_check import Checked, data, page, text

REPORT = FmuReport(
    Path("a.fmu"),
    "A<b>",
    "a tool",
    "2.0",
    (
        CheckResult("runs", "close", "fails", "why", 0.25, 0.1, "m"),
        CheckResult("order", "two", "holds"),
        CheckResult("parameters", "all", "doubtful", "g"),
    ),
)


def test_text_names_what_does_not_hold() -> None:
    shown = text(Checked((REPORT,)))
    assert shown.startswith("A<b> (FMI 2.0, a tool): 1 claims hold, 1 fail, 1 are doubtful.")
    assert "order" not in shown
    assert "parameters: all: g" in shown


def test_page_and_data() -> None:
    html = page(Checked((REPORT,)), [], "pysim check-fmu a.fmu")
    assert "pysim check-fmu a.fmu" in html
    assert "A&lt;b&gt;" in html
    assert 'class="fail">fails' in html
    (one,) = data(Checked((REPORT,)))
    assert [result["verdict"] for result in one["results"]] == ["fails", "holds", "doubtful"]
