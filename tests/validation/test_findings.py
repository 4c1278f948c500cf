"""Findings, and how a case's result is kept."""

import math
from dataclasses import replace
from importlib.util import find_spec
from pathlib import Path

import pytest

import validation
from tests.validation import made_up
from tests.validation.made_up import BAD, GOOD, result
from validation.findings import Finding
from validation.registry import CASES, GROUPS
from validation.results import from_line, keep_results, read_results, to_line, verdict_of


def test_verdicts() -> None:
    assert [verdict_of(finding) for finding in (*GOOD, *BAD)] == ["holds", "skipped", "holds", "fails"]
    assert result("good", *GOOD).verdict == "holds"
    assert result("bad", *BAD).verdict == "fails"
    assert result("only", GOOD[1]).verdict == "skipped"
    assert result("stopped", *GOOD, error="ValueError: x").verdict == "fails"


def test_a_value_that_is_no_number_fails_before_and_after_it_is_kept() -> None:
    run = result("nan", Finding("d", math.nan, 2.0, "deg"))
    assert run.verdict == from_line(to_line(run)).verdict == "fails"


def test_the_last_run_of_each_case_is_kept_with_its_commit(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    made_up.use(monkeypatch)
    file = tmp_path / "recorded.jsonl"
    old, new = (result("good", *GOOD, date=f"202{k}-01-01T00:00:00Z") for k in (5, 6))
    new = replace(new, commit="0123456789ab-dirty")
    gone = result("gone", *GOOD)
    bad = result("bad", *BAD, error="ValueError: x")
    keep_results(file, [old, gone])
    assert keep_results(file, [bad, new]) == read_results(file) == (new, bad)


def test_every_case_has_its_module_a_page_and_a_group() -> None:
    folder = Path(str(validation.__file__)).parent
    for case in CASES.values():
        assert find_spec(case.module)
        assert (folder / case.readme).is_file()
        assert case.group in GROUPS
