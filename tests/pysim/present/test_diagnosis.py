"""A diagnosis in words, as numbers, and as a page that needs nothing else."""

import json
import math
import re
from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from pysim.present import Drawing, data, diagnosis, text
from pysim.present.diagnosis import Diagnosed, figures
from pysim.present.diagnosis.figures.records import steps_shown
from pysim.present.diagnosis.law_words import ABSORBED, formula_text, law_kind, law_sentence
from pysim.present.diagnosis.words import (
    LEFT_OUT,
    added_sentence,
    called,
    comparison_sentence,
    last_name,
    learned_sentence,
    limits_sentence,
    ranking_sentence,
    signal_rows,
    sizes,
    verdict_sentence,
    verdict_words,
)
from pysim.types import Diagnosis, Effect, ErrorStep, FoundEffect, Left, NextTest, PlannedTest, Rival
from pysim.types.answer import StandsOut
from pysim.types.factor import Factor, Form
from tests.pysim.diagnosis_answer import LAW, OFFSET, estimate, found_offset, found_two, nothing, step

PLANNED = PlannedTest(True, 0.25, 1.5, 3.0, "mm", 16.0)
TEST = NextTest(("toy.offset", "toy.twin"), 42.0, (PLANNED,), ("x", "u"), {"u": (0.02, "V")}, 'name = "ramp"')


def numbers(text: str) -> list[float]:
    """All that stand in a text by themselves, in their order; not those of a table's name."""
    bare = re.sub(r"Tables? [\d.]+\d(?: and [\d.]+\d)?", "", text)
    return [float(word) for word in re.findall(r"(?<![\w.])\d+(?:\.\d+)?(?![\w.]*\w)", bare)]


def test_the_verdict_names_effects_and_says_the_error_before_and_after() -> None:
    sentence = verdict_sentence(found_offset())
    assert {"(toy.offset)", "toy.twin"} <= set(re.findall(r"\(?toy\.\w+\)?", sentence))
    assert numbers(sentence) == [4.2, 1.0, 3.2, 1.01]
    steps = (step("prior", 3.0, None, 0.1), step("refit", 2.0, None, 0.1), step("x", 1.0, None, 0.1))
    assert numbers(verdict_sentence(found_offset(history=steps))) == [2.0, 1.0]


def test_one_effect_is_it_and_several_are_them_however_many_steps_there_were() -> None:
    """A step more is there where an effect joined on trial and was left out again."""
    steps = tuple(step(name, fit, None, 0.1) for name, fit in (("prior", 4.0), ("refit", 3.0), ("x", 2.0), ("y", 1.0)))
    one = found_offset(history=steps)
    assert "With it the residual falls from 3.00 to 1.00 on fitted logs" in verdict_sentence(one)
    assert "With them the residual" in verdict_sentence(replace(one, effects=one.effects * 2))


def test_a_model_is_named_by_all_that_it_has_though_its_step_is_named_by_what_joined_last() -> None:
    two = found_two()
    assert last_name(two) == "with toy.offset and toy.rub"
    assert last_name(found_offset()) == "with toy.offset"
    assert last_name(nothing()) == "refitted"
    assert verdict_words(two) == "toy.offset and toy.rub"
    assert verdict_words(nothing()) == "none"
    assert steps_shown(two)[-1][0] == last_name(two)
    kept = replace(two, history=(*two.history[:2], replace(two.history[-1], step="law")))  # the offset has no step
    assert last_name(kept) == "with all 3 additions"


def test_what_leaving_out_costs_and_what_adding_takes_have_names_of_their_own() -> None:
    said = text(found_two())
    assert [line for line in said.splitlines() if "of the misfit" in line and LEFT_OUT not in line] == []
    heads = re.findall("<th[^>]*>([^<]*)</th>", page(found_two()))
    shares = [head for head in heads if "misfit" in head]
    assert len(shares) == len(set(shares)) == 2


def test_each_use_of_logs_has_one_word() -> None:
    """Fitted, used to choose between models, and held out from both."""
    steps = tuple(replace(step(*own), test=own[1]) for own in (("refit", 3.0, 2.5, 0.1), ("x", 1.0, 1.1, 0.1)))
    said = verdict_sentence(found_offset(history=steps))
    assert re.findall(r"on (?:[\w-]+ logs|logs [\w ]+?)(?=,| and)", said)[:3] == [
        "on fitted logs", "on logs used to choose", "on held-out logs",
    ]  # fmt: skip


def test_what_is_left_is_said_with_none_with_unknown_and_where_more_is_missing() -> None:
    assert numbers(verdict_sentence(nothing())) == [4.2, 3.2, 4.2]
    left = Left({}, 4.2, 3.2, 0.6, 9.0)
    assert numbers(verdict_sentence(nothing(complete=False, left=left))) == [4.2, 3.2, 60.0]
    assert numbers(verdict_sentence(found_offset(complete=False, left=left)))[-3:] == [4.2, 3.2, 60.0]
    odd = replace(left, stands_out=StandsOut("sweep.txt", "x", 2.5))
    said = verdict_sentence(nothing(complete=False, left=odd))
    assert numbers(said) == [4.2, 3.2, 60.0, 2.5]
    assert "sweep.txt" in said


def test_where_no_effect_was_tried_none_is_excluded() -> None:
    tried, bare = (verdict_sentence(nothing(complete=False, **more)) for more in ({}, {"rivals": ()}))
    assert "Nothing that was tried" in tried
    assert "No effect was tried" in bare


def test_an_error_that_rises_does_not_fall() -> None:
    steps = (step("prior", 3.0, 3.0, 0.1), step("refit", 2.0, 2.0, 0.1), step("x", 1.0, 2.5, 0.1))
    assert "falls" in verdict_sentence(found_offset())
    assert "falls" not in verdict_sentence(found_offset(history=steps))


@pytest.mark.parametrize(
    ("factor", "unit", "kind"),
    [
        (Factor(), "N", "force"),
        (Factor(), "m3/s", "flow"),
        (Factor(), "K", "term"),
        (Factor(Form.VARIABLE, "v"), "N.s/m", "damping"),
        (Factor(Form.VARIABLE, "x"), "N/m", "stiffness"),
        (Factor(Form.SIGN, "v"), "N", "friction"),
        (Factor(Form.BRISTLE, "v", 5e-4), "N", "friction"),
        (Factor(Form.HYSTERESIS, "s", 0.02), "m3/s", "flow"),
        (Factor(Form.TONE, number=0.4, rate=151.8), "N", "force"),
        (Factor(Form.VARIABLE, "a"), "N.s/m2", "coefficient of a"),
    ],
)
def test_a_law_is_called_by_what_its_unit_says(factor: Factor, unit: str, kind: str) -> None:
    law = replace(LAW, factor=factor, unit=unit, argument="x")
    assert law_kind(law) == kind
    assert kind in law_sentence(law)


def test_an_unknown_that_was_learned_is_first_said_in_words() -> None:
    law = replace(
        LAW, slot="damper", factor=Factor(Form.VARIABLE, "v"), argument="x", unit="N.s/m", held_out=(3.2, 1.6)
    )
    found = nothing(complete=False, learned=(law,))
    for said in (verdict_sentence(found), learned_sentence(found)):
        assert said.startswith("The damping at damper is not constant: it depends on x.")
        assert numbers(said)[:1] == [97.0]
        assert [n for n in numbers(said) if n in (3.2, 1.6)][:2] == [3.2, 1.6]  # held-out error before and after
    assert LAW.formula in verdict_sentence(found)
    assert "Nothing but noise is left" not in verdict_sentence(found)
    noise = Left({}, 1.02, 1.03)
    assert "Nothing but noise is left" in verdict_sentence(replace(found, complete=True, left=noise))
    steps = tuple(step(name, fit, None, 0.1) for name, fit in (("prior", 4.0), ("refit", 3.0), ("law", 1.0)))
    said = verdict_sentence(replace(found, history=steps, complete=True, left=noise))
    assert "With the learned law the residual falls from 3.00 to 1.00 on fitted logs" in said
    assert "Nothing that was tried" not in said


def test_only_what_is_as_small_as_the_noise_is_called_noise() -> None:
    for size, is_noise in ((1.04, True), (1.41, False)):
        for found in (nothing(left=Left({}, size, None)), found_offset(left=Left({}, size, None))):
            said = verdict_sentence(found)
            assert ("Nothing but noise is left" in said) == is_noise
            assert ("is 1.41 times the noise" in said) != is_noise


def test_effects_that_were_asked_for_are_not_said_to_be_missing() -> None:
    asked = found_offset(rivals=(), ties=())
    idle = replace(asked, effects=tuple(replace(one, share=0.0) for one in asked.effects))
    for found, is_idle in ((asked, False), (idle, True)):
        for said in (str(data(Diagnosed(found))["reason"]), added_sentence(found)):
            assert "Added as asked: constant force (toy.offset)." in said
            assert "lacks" not in said
            assert ("toy.offset changes nothing" in said) == is_idle


def test_a_residual_that_an_effect_leaves_as_it_was_stays() -> None:
    steps = tuple(step(name, fit, None, 0.1) for name, fit in (("refit", 1.001), ("x", 0.999)))
    assert "With it the residual stays at 1.00 on fitted logs" in verdict_sentence(found_offset(history=steps))


def test_a_law_of_constant_size_is_not_said_to_depend_on_anything() -> None:
    flat = replace(LAW, factor=Factor(Form.SIGN, "v"), coefficients=0 * LAW.coefficients - 60.0)
    assert flat.is_flat
    assert not replace(flat, coefficients=LAW.coefficients, covariance=1e-9 * LAW.covariance).is_flat
    assert "depends" not in law_sentence(flat)


def test_learned_laws_are_listed_by_place_and_share_with_the_curves_of_those_that_were_added() -> None:
    other = replace(LAW, slot="supply", share=0.12)
    for found, curves in (
        (nothing(complete=False, learned=(LAW,), missing=(LAW, other)), 1),
        (nothing(complete=False, learned=(LAW, other)), 2),
    ):
        said, shown = learned_sentence(found), text(found)
        assert [value for value in numbers(said) if value in (97.0, 12.0)] == [97.0, 12.0]
        assert ("Other places" in said) is (curves == 1)
        assert shown.index("force: force over v") < shown.index("supply: force over v")
        rows = [line for line in shown.splitlines() if "v = 600 mm/s" in line]
        assert len(rows) == curves
        assert all("-0.4 N (-0.498 N to -0.302 N)" in row for row in rows)
    slope = replace(LAW, absorbed=LAW.knots[:, None])  # any amount of it may be added without a trace in the data
    assert ABSORBED in text(nothing(learned=(slope,)))
    assert ABSORBED not in shown


def test_sizes_of_effects_have_units_where_there_are_some() -> None:
    for unit, told in (("N", "F_o = 0.5 N,"), ("1", "F_o = 0.5,")):
        effect = FoundEffect(OFFSET, "force", (estimate("F_o", 0.5, 0.1, unit=unit),))
        (line,) = (line for line in text(found_offset(effects=(effect,))).splitlines() if "F_o" in line)
        assert told in line
        assert numbers(line)[-2:] == [0.4, 0.6]


def test_a_size_that_people_turn_over_is_given_both_ways() -> None:
    (parameter,) = OFFSET.parameters
    turned = replace(OFFSET, parameters=(replace(parameter, inverse="G"),))
    one = FoundEffect(turned, "force", (estimate("F_o", 0.5, 0.1),))
    assert sizes(one) == [("F_o", 0.5, (0.4, 0.6), "N"), ("G", 2.0, (1 / 0.6, 2.5), "1/(N)")]


def test_each_signal_has_one_residual_one_fit_and_one_rms_in_its_unit() -> None:
    """Noise of 0.5 m on a wave of 20 m, and nothing else."""
    fitted, held = signal_rows(found_offset().history[-1].records)
    assert (fitted[:2], held[:2]) == (("x", "fitted"), ("x", "used to choose"))
    for _, _, residual, percent, rms, unit in (fitted, held):
        assert residual == pytest.approx(1.0, abs=0.01)
        assert rms == pytest.approx(0.5, abs=0.005)
        assert percent == pytest.approx(100 * (1 - 0.5 / (20 / math.sqrt(2))), abs=0.2)
        assert unit == "m"


def test_the_next_test_is_said_with_what_it_separates() -> None:
    for shown in (text(found_offset(next_test=TEST)), page(found_offset(next_test=TEST))):
        assert {0.25, 1.5, 3.0, 16.0, 0.02, 42.0} <= set(numbers(shown))


def test_the_steps_alone_say_their_numbers() -> None:
    assert numbers(comparison_sentence(nothing()))[:4] == [8.1, 8.0, 0.9, 0.5]
    assert numbers(ranking_sentence(found_offset()))[:3] == [3, 4, 99.0]
    assert numbers(ranking_sentence(found_offset(rivals=found_offset().rivals[3:]))) == [1]
    assert numbers(added_sentence(found_offset())) == [4.2, 1.0, 3.2, 1.01, 0.1, 0.5]


@pytest.mark.parametrize(
    ("given", "whole"),
    [
        (("-442", "sign(v)", "N"), "-442 N * sign(v)"),
        (("1.2e+04 + 3.1e+07*x^2", "v", "N.s/m"), "(1.2e+04 + 3.1e+07*x^2) N.s/m * v"),
        (("-2*x", "", "1"), "(-2*x)"),
        (("", "v", "N"), ""),
    ],
)
def test_a_formula_has_its_unit_and_its_factor(given: tuple[str, str, str], whole: str) -> None:
    assert formula_text(*given) == whole


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
    one = ErrorStep("prior", 1.02, None, None, criteria, met, 1.0, not_simulated=failed)
    assert numbers(limits_sentence(one)) == told
    for shown in (text(found_offset(history=(one,))), page(found_offset(history=(one,)))):
        assert verdicts in shown


def test_the_error_of_a_sensor_is_said_in_words_wherever_it_stands() -> None:
    """Effects keep their standard names."""
    gain = Effect("sensor.gain", "x", "", (replace(OFFSET.parameters[0], name="size"),))
    rows = (
        Rival(("sensor.gain logs.x",), 9.0, 0.1, 0.5, True),
        Rival(("toy.offset", "sensor.delay logs.p"), 9.0, 0.1, 0.1, True),
    )
    found = found_offset(
        effects=(FoundEffect(gain, "x", (estimate("size", 0.4, 0.1, unit="1"),), 0.9),),
        rivals=rows,
        ties=(("sensor.gain logs.x", "sensor.offset logs.x"),),
        history=(
            *found_offset().history[:2],
            replace(found_offset().history[2], step="toy.offset + sensor.gain logs.x"),
        ),
    )
    assert called("sensor.gain my data.x", "toy.offset") == "gain of the sensor of x + toy.offset"
    for shown in (verdict_sentence(found), ranking_sentence(found), page(found), text(found).partition("\n")[2]):
        assert "of the sensor of x" in shown
        assert "sensor." not in shown
    assert "toy.offset + delay of the sensor of p" in page(found)


def test_an_effect_without_a_description_leaves_no_dot_behind() -> None:
    bare = replace(OFFSET, description="")
    found = found_offset(effects=(FoundEffect(bare, "force", (estimate("F_o", 0.4, 0.05),), 0.9),))
    assert not re.search(r">\s*\.", page(found))


def test_a_model_without_limits_is_not_judged() -> None:
    found = found_offset()
    bare = replace(found, history=tuple(replace(one, criteria={}, passes=True) for one in found.history))
    for judge in (text, page, added_sentence, comparison_sentence, lambda one: next(figures(Diagnosed(one))).caption):
        assert re.search(r"Tables? 1\.", judge(found))
        assert not re.search(r"thesis|Tables? 1\.|limits?\b", judge(bare), re.IGNORECASE)


def test_json_has_each_sentence_beside_its_numbers() -> None:
    result = Diagnosed(found_offset(next_test=TEST), files={"report": "r.html"})
    written = json.loads(json.dumps(data(result)))
    assert written["reason"] == verdict_sentence(found_offset())
    assert written["notes"][0]["code"] == "noise_estimated"
    assert "500 mm" in written["notes"][0]["text"]
    assert written["next_test"]["separates"] == ["toy.offset", "toy.twin"]
    assert written["files"] == {"report": "r.html"}


def test_json_says_of_each_refitted_model_why_not_to_trust_it() -> None:
    """The base model is poor; nothing is wrong with the last one but a direction that the data leave open."""
    poor = data(found_offset())["warnings"]
    assert isinstance(poor, dict)
    assert set(poor) == {"refit", "toy.offset"}
    assert any("fit is poor" in line for line in poor["refit"])
    assert not any("fit is poor" in line for line in poor["toy.offset"])
    for lines in poor.values():
        assert sum("do not tell" in line for line in lines) == 1


def page(found: Diagnosis, drawings: Sequence[Drawing] = (), **more: Any) -> str:
    return diagnosis.page(Diagnosed(found, **{"title": "toy"} | more), drawings, "pysim diagnose x")


def test_the_page_needs_nothing_else_and_has_no_empty_sections() -> None:
    drawings = [Drawing("a", "the fall", b"<svg/>", "error"), Drawing("b", "the law", b"<svg/>", "learned")]
    found = found_offset(learned=(LAW,), next_test=TEST)
    whole = page(found, drawings, title="a < b", files={"fmu": "Toy.fmu"})
    for part in ("a &lt; b", "f = F_o;", LAW.formula, "Toy.fmu", "pysim diagnose x", "the fall", "the law"):
        assert part in whole
    assert whole.count("<figure") == 2
    assert not re.search(r'(?:src|href)="(?!data:)', whole)
    less = page(replace(nothing(), notes=()))
    assert less.count("<h2>") < whole.count("<h2>") - 3


def test_only_a_parameter_that_both_intervals_do_not_allow_was_pushed() -> None:
    """The damping's fall is beyond both intervals; the same fall within the earlier one proves nothing."""
    found = found_offset()
    prior, refit, last = found.history
    wide = tuple(estimate(e.name, e.value, 5.0 if e.name == "d" else 0.0) for e in refit.estimates)
    assert re.findall(r"wrong about (.+?)\.", page(found)) == ["d"]
    assert "wrong about" not in page(replace(found, history=(prior, replace(refit, estimates=wide), last)))


def test_the_terminal_gets_verdict_error_and_candidates() -> None:
    first, *lines = text(found_offset()).splitlines()
    assert first.endswith(" toy.offset")
    rows = {line.split()[0]: numbers(line) for line in lines if line.startswith("  ")}
    assert rows["refitted"] == [4.2, 3.2]
    assert rows["toy.offset"] == [99.0, 900.0]


def test_a_law_without_a_curve_has_a_line_all_the_same() -> None:
    empty = replace(LAW, knots=np.zeros(0), coefficients=np.zeros(0), covariance=np.zeros((0, 0)))
    assert "force: force over v" in text(nothing(learned=(empty,)))
