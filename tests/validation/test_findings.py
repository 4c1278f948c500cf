"""Findings, and how a case's result is kept."""

import math
from dataclasses import replace
from importlib.util import find_spec
from pathlib import Path

import numpy as np
import pytest

import validation
from tests.validation import made_up
from tests.validation.made_up import BAD, GOOD, result
from validation.findings import Finding
from validation.registry import CASES, GROUPS, Case
from validation.results import from_line, keep_results, read_results, to_line, verdict_of
from validation.seeds import seeds_drawn
from validation.suite import run_cases
from validation.summary import full_summary


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
    bad = replace(result("bad", *BAD, error="ValueError: x"), commit="0123456789ab")
    of_no_commit = result("nan", *GOOD)
    keep_results(file, [old, gone])
    assert keep_results(file, [bad, new, of_no_commit]) == read_results(file) == (new, bad)


def test_a_regression_check_may_fail_and_is_no_claim() -> None:
    check = Finding("the same as before", 1.0, 0.0, "", regression=True)
    run = result("good", *GOOD, check)
    assert [run.count(verdict) for verdict in ("holds", "fails", "skipped")] == [1, 0, 1]
    assert (run.verdict, run.checks) == ("fails", (check,))
    assert from_line(to_line(run)) == run
    assert str(check).startswith("FAILS    regression check: ")


def test_a_summary_counts_one_commit_and_names_what_is_of_another(monkeypatch: pytest.MonkeyPatch) -> None:
    made_up.use(monkeypatch)
    now = replace(result("good", *GOOD, date="2026-02-01T00:00:00Z"), commit="new")
    old = replace(result("bad", *BAD), commit="old")
    written = full_summary([old, now])
    assert "| Methods on known answers | 1 of 4 | 1 | 0 | 1 |" in written
    assert "Counted: what commit new recorded. Of other commits, and counted nowhere: bad." in written
    assert "| other: old |" in written
    assert "No claim of these cases fails." in written


def test_one_case_that_is_recorded_anew_leaves_the_commit_of_all_others_counted(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    made_up.use(monkeypatch)
    whole = [replace(result(name, *GOOD), commit="whole") for name in ("good", "nan")]
    later = replace(result("bad", *BAD, date="2030-01-01T00:00:00Z"), commit="later")
    assert "Counted: what commit whole recorded." in full_summary([*whole, later])


def test_seeds_of_a_run_are_noted(monkeypatch: pytest.MonkeyPatch) -> None:
    made_up.use(monkeypatch)
    monkeypatch.setitem(made_up.CASES, "drawing", Case("validation.drawing.case", "draws", "methods"))
    (run,) = run_cases(["drawing"], lambda name, finding: None)
    assert run.seeds == "3 to 5, 7"
    with seeds_drawn() as seeds:
        np.random.default_rng()
        np.random.default_rng(np.random.default_rng(1))
        np.random.default_rng([8, 1477216740])
    assert seeds.text == "1, 8, none"


def test_every_case_has_its_module_a_page_and_a_group() -> None:
    folder = Path(str(validation.__file__)).parent
    for case in CASES.values():
        assert find_spec(case.module)
        assert (folder / case.readme).is_file()
        assert case.group in GROUPS
