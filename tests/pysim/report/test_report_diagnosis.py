"""A diagnosis in words, as numbers, and as a page that needs nothing else."""

import json
import re
from dataclasses import replace

import numpy as np

from fmu_build import build
from pysim.cli._subject import _out_of_sight
from pysim.io import read_model
from pysim.report.diagnosis import diagnosis_data, diagnosis_text, evidence_text
from pysim.report.diagnosis_page import diagnosis_page
from pysim.report.diagnosis_words import (
    added_sentence,
    comparison_sentence,
    limits_sentence,
    missing_sentence,
    ranking_sentence,
    sizes,
    verdict_sentence,
)
from pysim.types import AddedEffect, LedgerStep, Missing, NextTest, Shape
from tests.pysim.diagnose.toy import library
from tests.pysim.diagnosis_story import OFFSET, estimate, nothing, step, story

MISSING = Missing("force", 0.97, "v", Shape(*(np.arange(2.0) for _ in range(4)), "m/s", "N"), "-0.4 sign(v)")
TEST = NextTest(("toy.offset", "toy.twin"), 42.0, "Run a slow ramp and log x.", 'name = "ramp"')


def test_the_verdict_is_one_plain_sentence() -> None:
    assert verdict_sentence(story()) == (
        "The model lacks an effect: constant force (toy.offset). These data do not tell it from toy.twin. "
        "With it the error falls from 4.20 to 1.00 times the noise on what was fitted and from 3.20 to 1.01 times the "
        "noise on what was held out."
    )
    assert verdict_sentence(nothing()).startswith("Nothing is missing: the refitted model explains")
    assert "4.20 times the noise on what was fitted, 3.20 on what was held out" in verdict_sentence(nothing())
    unknown = replace(nothing(), verdict="unknown", reason="no effect takes a fair share")
    assert verdict_sentence(unknown) == (
        "The model fails, and no effect that was tried explains it: no effect takes a fair share."
    )
    assert verdict_sentence(story(verdict="unknown")).startswith(
        "More is missing than could be named: constant force (toy.offset) is asked for, and is not all."
    )
    alone = story(error=(step("prior", 3.0, None, 0.1), step("refit", 2.0, None, 0.1), step("x", 1.0, None, 0.1)))
    assert verdict_sentence(alone).endswith("falls from 2.00 to 1.00 times the noise on what was fitted.")


def test_sizes_of_effects_have_units_where_there_are_some() -> None:
    force = story(added=(AddedEffect(OFFSET, "force", (estimate("F_o", 0.5, 0.1),)),))
    assert "toy.offset: F_o = 0.5 N, 95 % from 0.4 to 0.6" in diagnosis_text(force)
    share = story(added=(AddedEffect(OFFSET, "force", (estimate("F_o", 0.5, 0.1, unit="1"),)),))
    assert "toy.offset: F_o = 0.5, 95 % from 0.4 to 0.6" in diagnosis_text(share)


def test_a_missing_term_is_told_by_place_shape_and_share() -> None:
    other = replace(MISSING, slot="supply", share=0.12)
    assert missing_sentence(story(missing=(MISSING, other))) == (
        "What is missing fits best at force, over v; -0.4 sign(v). It takes 97.0 % of the misfit. Next: supply 12.0 %."
    )
    assert "force" in evidence_text(story(missing=(MISSING,)))
    tied = replace(MISSING, alike=("supply",))
    assert "do not tell it from a term at supply." in missing_sentence(story(missing=(tied, other)))


def test_where_no_term_was_found_no_cause_is_told_that_is_not_known() -> None:
    assert missing_sentence(story()) == "No term could be estimated at any place of the model."
    assert missing_sentence(nothing()) == (
        "No term could be estimated at any place of the model. The model explains the measurements down to their noise "
        "without one."
    )
    model = read_model(build("Toy.Mass", libraries=[library()]))
    shut = story(notes=tuple(_out_of_sight(model)))
    assert missing_sentence(shut) == (
        "No term could be estimated at the model's inputs and outputs, and without its Modelica class nothing else can "
        "be looked at."
    )


def test_the_terminal_tells_the_next_test() -> None:
    text = " ".join(evidence_text(story(next_test=TEST)).split())
    assert (
        "Next test: Run a slow ramp and log x. It separates toy.offset from toy.twin: expected difference of their "
        "sums of squares over noise 42."
    ) in text
    assert "Next test" not in evidence_text(story())
    assert "over noise 42." in diagnosis_page(story(next_test=TEST), title="toy", pictures={}, redo="x")


def test_the_steps_alone_have_sentences_of_their_own() -> None:
    assert comparison_sentence(nothing()).startswith(
        "As it is, the model leaves 8.10 times the noise on what is fitted and 8.00 times the noise on what is held "
        "out. Thesis Table 1.3 is not met: at worst 0.9 dB on average (limit 0.5). Refitted, it leaves 4.20 times"
    )
    assert ranking_sentence(story()).startswith("3 of 4 candidates gain more than their price: toy.offset (99.0 % of")
    assert ranking_sentence(story(ranking=story().ranking[3:])) == "None of 1 candidates gains more than its price."
    assert added_sentence(story()) == (
        "Added as asked: constant force (toy.offset). With it the error falls from 4.20 to 1.00 times the noise on "
        "what was fitted and from 3.20 to 1.01 times the noise on what was held out. "
        "Thesis Table 1.3 is met: at worst 0.1 dB on average (limit 0.5)."
    )


def test_limits_are_told_with_their_numbers() -> None:
    far = LedgerStep("prior", 10.43, None, {"E_t mean": 0.81, "E_t max": 3.4}, True, 1.0)
    assert comparison_sentence(story(error=(far,), where=())) == (
        "As it is, the model leaves 10.43 times the noise on what is fitted. Thesis Table 1.4 is met: at worst 0.81 % "
        "of full scale on average (limit 2) and 3.4 % of full scale at most (limit 10). These limits are wider than "
        "the noise: that they are met does not make the model complete."
    )
    assert "Table 1.4 met" in evidence_text(story(error=(far,)))
    near = replace(far, fit=1.02)
    assert limits_sentence(near).endswith("at most (limit 10).")


def test_each_table_has_its_own_verdict() -> None:
    mixed = LedgerStep("prior", None, None, {"E_M mean": 0.2, "E_P max": 35.001, "E_t max": 3.4}, False, 1.0)
    assert comparison_sentence(story(error=(mixed,), where=())) == (
        "As it is, the model is judged by responses alone. Thesis Table 1.3 is not met: at worst 0.2 dB on average "
        "(limit 0.5) and 35.001 degrees at most (limit 35). Thesis Table 1.4 is met: at worst 3.4 % of full scale at "
        "most (limit 10)."
    )
    assert "Table 1.3 not met, Table 1.4 met" in evidence_text(story(error=(mixed,)))


def test_where_nothing_has_a_limit_none_is_said_to_be_met() -> None:
    bare = LedgerStep("prior", 3.0, None, {}, True, 1.0)
    assert "is met" not in comparison_sentence(story(error=(bare,)))
    assert "no limits" in evidence_text(story(error=(bare,)))
    page = diagnosis_page(story(error=(bare,)), title="toy", pictures={}, redo="x")
    assert ">no limits<" in page
    assert ">met<" not in page


def test_limits_are_not_judged_where_a_record_could_not_be_simulated() -> None:
    short = LedgerStep("prior", 1.0, None, {"E_M mean": 0.2, "E_t max": 30.0}, False, 1.0, not_simulated=1)
    told = "Table 1.3 not judged, Table 1.4 not met, 1 record not simulated"
    assert told in evidence_text(story(error=(short,)))
    assert told in diagnosis_page(story(error=(short,)), title="toy", pictures={}, redo="x")
    assert limits_sentence(short) == (
        "Thesis Table 1.3 is not judged: at worst 0.2 dB on average (limit 0.5). Thesis Table 1.4 is not met: at worst "
        "30 % of full scale at most (limit 10). 1 record not simulated: how far the model is from what was measured "
        "there is not known."
    )
    none = LedgerStep("prior", None, None, {}, True, 0.0, not_simulated=2)
    assert "no limits, 2 records not simulated" in evidence_text(story(error=(none,)))


def test_a_size_that_people_turn_over_is_told_both_ways() -> None:
    (parameter,) = OFFSET.parameters
    turned = replace(OFFSET, parameters=(replace(parameter, inverse="G"),))
    (name, value, interval, unit), (other, one_over, turned_interval, per) = sizes(
        AddedEffect(turned, "force", (estimate("F_o", 0.5, 0.1),))
    )
    assert (name, value, interval, unit) == ("F_o", 0.5, (0.4, 0.6), "N")
    assert (other, one_over, per) == ("G", 2.0, "1/(N)")
    assert turned_interval == (1 / 0.6, 2.5)


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


def test_the_page_tells_the_story_from_verdict_to_command_line() -> None:
    found = story(missing=(MISSING,), next_test=TEST)
    pictures = {"ledger": {"the fall": b"<svg/>"}, "missing": {"the term": b"<svg/>"}}
    text = diagnosis_page(found, title="a < b", pictures=pictures, redo="pysim diagnose x", files={"fmu": "Toy.fmu"})
    heads = re.findall(r"<h2>(.*?)</h2>", text)
    assert heads == [
        "What was added: toy.offset",
        "Where the refitted model fails",
        "What is missing, and where",
        "Candidates",
        "Parameters before and after",
        "The next test",
        "The error, step by step",
        "What to bear in mind",
        "Conditions",
        "Do it again",
    ]
    assert text.index("The model lacks an effect") < text.index("the fall") < text.index("<h2>")
    assert "<pre>f = F_o;</pre>" in text
    assert "To hide what was missing, refitting had bent d." in text
    assert "Not told apart by these data: toy.offset, toy.twin." in text
    assert "-0.4 sign(v)" in text
    assert "Toy.fmu" in text
    assert "<pre>pysim diagnose x</pre>" in text
    assert "a &lt; b" in text
    assert not re.search(r'(?:src|href)="(?!data:)', text)


def test_the_page_of_nothing_has_no_empty_sections() -> None:
    text = diagnosis_page(replace(nothing(), notes=()), title="toy", pictures={}, redo="x")
    heads = re.findall(r"<h2>(.*?)</h2>", text)
    assert heads[:3] == ["Where the refitted model fails", "Candidates", "Parameters before and after"]
    assert "had bent" not in text
    assert "bear in mind" not in text


def test_the_terminal_gets_verdict_ledger_and_ranking() -> None:
    text = diagnosis_text(story())
    assert text.startswith("Verdict: toy.offset\n")
    assert "held out    1.010" in text
    assert "Not told apart by these data: toy.offset, toy.twin" in text
