"""The table a terminal shows."""

from dataclasses import replace

from pysim.present.comparison import Comparisons, comparison_text, page
from tests.pysim.comparisons import comparison


def test_rows_marks_and_verdicts() -> None:
    lines = comparison_text(comparison("set A", error_db=1.0)).splitlines()
    assert lines[0] == "set A: Linear against bench (measured)"
    # 1 dB at three of four frequencies: mean 0.75 beyond its limit, max 1 within
    assert lines[2].split() == ["-50", "5", "0.75*", "1.00", "0.0", "0.0", "FAIL"]
    assert lines[6].split()[:5] == ["limit", "0.50", "2.00", "5.0", "35.0"]
    assert lines[7] == "0 of 1 independent tests pass (0 of 4 rows)."
    assert lines[-1] == "Take it <with> care."


def test_a_run_that_failed_says_why() -> None:
    text = comparison_text(comparison("set A", fails=1))
    assert "no response: at 5 Hz: stopped  FAIL" in text
    assert "0 of 1 independent tests pass (3 of 4 rows)" in text
    assert "limit" in comparison_text(comparison("set A", fails=1))


def test_a_data_set_without_a_description_adds_no_line() -> None:
    silent = replace(comparison("set A", error_db=1.0), note="-")
    assert comparison_text(silent).splitlines()[-1] == "0 of 1 independent tests pass (0 of 4 rows)."
    assert 'class="note"' not in page(Comparisons("t", (silent,)), [], "")
    assert 'class="note"' in page(Comparisons("t", (comparison("set A"),)), [], "")
