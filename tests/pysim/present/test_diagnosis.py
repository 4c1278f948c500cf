"""A diagnosis in words, as numbers, and as a page that needs nothing else."""

import json
import re
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from pysim.present.diagnosis.answer import diagnosis_data, diagnosis_text, evidence_text
from pysim.present.diagnosis.page import diagnosis_page
from pysim.present.diagnosis.words import (
    added_sentence,
    comparison_sentence,
    limits_sentence,
    missing_sentence,
    ranking_sentence,
    sizes,
    verdict_sentence,
)
from pysim.types import AddedEffect, Diagnosis, LedgerStep, Missing, NextTest, Shape
from tests.pysim.diagnosis_story import OFFSET, estimate, nothing, step, story

MISSING = Missing("force", 0.97, "v", Shape(*(np.arange(2.0) for _ in range(4)), "m/s", "N"), "-0.4 sign(v)")
TEST = NextTest(("toy.offset", "toy.twin"), 42.0, "Run a slow ramp and log x.", 'name = "ramp"')


def numbers(text: str) -> list[float]:
    """All that stand in a text by themselves, in their order; not those of a table's name."""
    bare = re.sub(r"Tables? [\d.]+\d(?: and [\d.]+\d)?", "", text)
    return [float(word) for word in re.findall(r"(?<![\w.])\d+(?:\.\d+)?(?![\w.]*\w)", bare)]


def test_the_verdict_names_effects_and_tells_the_error_before_and_after() -> None:
    told = verdict_sentence(story())
    assert {"(toy.offset)", "toy.twin"} <= set(re.findall(r"\(?toy\.\w+\)?", told))
    assert numbers(told) == [4.2, 1.0, 3.2, 1.01]
    assert numbers(verdict_sentence(nothing()))[-2:] == [4.2, 3.2]
    assert "toy.offset" in verdict_sentence(story(verdict="unknown"))
    unknown = replace(nothing(), verdict="unknown", reason="no effect takes a fair share")
    assert unknown.reason in verdict_sentence(unknown)
    alone = story(error=(step("prior", 3.0, None, 0.1), step("refit", 2.0, None, 0.1), step("x", 1.0, None, 0.1)))
    assert numbers(verdict_sentence(alone)) == [2.0, 1.0]


def test_sizes_of_effects_have_units_where_there_are_some() -> None:
    for unit, told in (("N", "F_o = 0.5 N,"), ("1", "F_o = 0.5,")):
        one = story(added=(AddedEffect(OFFSET, "force", (estimate("F_o", 0.5, 0.1, unit=unit),)),))
        (line,) = (line for line in diagnosis_text(one).splitlines() if "F_o" in line)
        assert told in line
        assert numbers(line)[-2:] == [0.4, 0.6]


def test_a_missing_term_is_told_by_place_shape_and_share() -> None:
    other = replace(MISSING, slot="supply", share=0.12)
    told = missing_sentence(story(missing=(MISSING, other)))
    assert numbers(told)[-2:] == [97.0, 12.0]
    assert told.index("force") < told.index(MISSING.formula) < told.index("supply")
    assert "force" in evidence_text(story(missing=(MISSING,)))


def test_the_next_test_is_told_with_what_it_separates() -> None:
    for text in (evidence_text(story(next_test=TEST)), page(story(next_test=TEST))):
        assert TEST.about in " ".join(text.split())
        assert 42.0 in numbers(text)


def test_the_steps_alone_tell_their_numbers() -> None:
    assert numbers(comparison_sentence(nothing()))[:4] == [8.1, 8.0, 0.9, 0.5]
    assert numbers(ranking_sentence(story()))[:3] == [3, 4, 99.0]
    assert numbers(ranking_sentence(story(ranking=story().ranking[3:]))) == [1]
    assert numbers(added_sentence(story())) == [4.2, 1.0, 3.2, 1.01, 0.1, 0.5]


@pytest.mark.parametrize(
    ("criteria", "met", "failed", "verdicts", "told"),
    [
        ({"E_t mean": 0.81, "E_t max": 3.4}, True, 0, "Table 1.4 met", [0.81, 2, 3.4, 10]),
        (
            {"E_M mean": 0.2, "E_P max": 35.001, "E_t max": 3.4},
            False,
            0,
            "Table 1.3 not met, Table 1.4 met",
            [0.2, 0.5, 35.001, 35, 3.4, 10],
        ),
        ({}, True, 0, "no limits", []),
        (
            {"E_M mean": 0.2, "E_t max": 30.0},
            False,
            1,
            "Table 1.3 not judged, Table 1.4 not met, 1 record not simulated",
            [0.2, 0.5, 30, 10, 1],
        ),
    ],
)
def test_each_table_has_its_own_verdict_with_numbers_and_limits(
    criteria: dict[str, float], met: bool, failed: int, verdicts: str, told: list[float]
) -> None:
    one = LedgerStep("prior", 1.02, None, criteria, met, 1.0, not_simulated=failed)
    assert numbers(limits_sentence(one)) == told
    for text in (evidence_text(story(error=(one,))), page(story(error=(one,)))):
        assert verdicts.replace("Table 1.4 met", "") in text  # a page has a shorter word where all are met
    assert verdicts in evidence_text(story(error=(one,)))


def test_a_size_that_people_turn_over_is_told_both_ways() -> None:
    (parameter,) = OFFSET.parameters
    turned = AddedEffect(
        replace(OFFSET, parameters=(replace(parameter, inverse="G"),)), "force", (estimate("F_o", 0.5, 0.1),)
    )
    assert sizes(turned) == [("F_o", 0.5, (0.4, 0.6), "N"), ("G", 2.0, (1 / 0.6, 2.5), "1/(N)")]
    (added,) = diagnosis_data(story(added=(turned,)))["added"]
    assert added["parameters"] == {"F_o": 0.5, "G": 2.0}
    assert added["intervals"] == {"F_o": [0.4, 0.6], "G": [1 / 0.6, 2.5]}
    assert added["unit"] == {"F_o": "N", "G": "1/(N)"}


def test_the_numbers_hold_the_missing_term_and_the_next_test() -> None:
    data = json.loads(json.dumps(diagnosis_data(story(missing=(MISSING,), next_test=TEST), {"report": "r.html"})))
    (missing,) = data["missing"]
    assert missing["shape"] == {"argument": [0, 1], "value": [0, 1], "low": [0, 1], "high": [0, 1]} | {
        "argument_unit": "m/s",
        "unit": "N",
    }
    assert (missing["slot"], missing["share"], missing["depends_on"]) == ("force", 0.97, "v")
    assert data["next_test"]["separates"] == ["toy.offset", "toy.twin"]
    assert data["files"] == {"report": "r.html"}
    assert data["conditions"] == {"seed": "7"}
    assert diagnosis_data(nothing())["next_test"] is None


def page(found: Diagnosis, **more: Any) -> str:
    return diagnosis_page(found, **{"title": "toy", "pictures": {}, "redo": "pysim diagnose x"} | more)


def test_the_page_needs_nothing_else_and_has_no_empty_sections() -> None:
    pictures = {"ledger": {"the fall": b"<svg/>"}, "missing": {"the term": b"<svg/>"}}
    found = story(missing=(MISSING,), next_test=TEST)
    text = page(found, title="a < b", pictures=pictures, files={"fmu": "Toy.fmu"})
    for part in ("a &lt; b", "f = F_o;", MISSING.formula, "Toy.fmu", "pysim diagnose x", "the fall", "the term"):
        assert part in text
    assert text.count("<figure") == 2
    assert not re.search(r'(?:src|href)="(?!data:)', text)
    less = page(replace(nothing(), notes=()))
    assert less.count("<h2>") < text.count("<h2>") - 3


def test_the_terminal_gets_verdict_ledger_and_ranking() -> None:
    first, *lines = diagnosis_text(story()).splitlines()
    assert first.endswith(" toy.offset")
    rows = {line.split()[0]: numbers(line) for line in lines if line.startswith("  ")}
    assert rows["refit"] == [4.2, 3.2]
    assert rows["toy.offset"][0] == 900
