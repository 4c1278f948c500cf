"""What was found about an FMU, in words and on a page."""

from pathlib import Path

from pysim.fmu_check import CheckResult, FmuReport
from pysim.report.fmu_check import fmu_check_data, fmu_check_parts, fmu_check_text

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
    text = fmu_check_text(REPORT)
    assert text.startswith("A<b> (FMI 2.0, a tool): 1 claims hold, 1 fail, 1 are doubtful.")
    assert "order" not in text
    assert "parameters: all: g" in text


def test_page_and_data() -> None:
    html = "".join(fmu_check_parts(REPORT))
    assert "A&lt;b&gt;" in html
    assert 'class="fail">fails' in html
    assert [result["verdict"] for result in fmu_check_data(REPORT)["results"]] == ["fails", "holds", "doubtful"]
