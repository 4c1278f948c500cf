"""Results as lines of JSON."""

import math
from pathlib import Path

from tests.validation.made_up import BAD, GOOD, MACHINE, result
from validation.findings import Finding
from validation.results import append_results, from_line, newest, read_results, this_machine, to_line, verdict_of


def test_verdicts() -> None:
    assert result("good", *GOOD).verdict == "holds"
    assert result("bad", *BAD).verdict == "fails"
    assert result("only", GOOD[1]).verdict == "skipped"
    assert result("stopped", *GOOD, error="ValueError: x").verdict == "fails"
    assert result("good", *GOOD).count("skipped") == 1
    assert [verdict_of(f) for f in (*GOOD, *BAD)] == ["holds", "skipped", "holds", "fails"]


def test_lines_come_back(tmp_path: Path) -> None:
    file = tmp_path / "new" / "results.jsonl"
    assert read_results(file) == ()
    first, second = result("good", *GOOD), result("bad", *BAD, error="ValueError: x")
    append_results(file, [first])
    append_results(file, [second])
    assert read_results(file) == (first, second)


def test_what_is_no_number_fails_after_reading_too() -> None:
    line = to_line(result("nan", Finding("d", math.nan, 2.0, "deg")))
    assert "NaN" not in line
    (finding,) = from_line(line).findings
    assert math.isnan(finding.value)
    assert not finding.holds


def test_the_newest_run_of_each_case_counts() -> None:
    old, new = (result("good", *GOOD, date=f"202{k}-01-01T00:00:00Z") for k in (5, 6))
    assert newest([new, old]) == {"good": new}


def test_the_machine_has_a_name() -> None:
    machine = this_machine()
    assert machine.cores >= 1
    assert machine.processor
    assert str(MACHINE) == "a processor, 2 cores, Linux x86_64, Python 3.11.0"
