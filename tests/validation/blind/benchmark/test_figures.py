"""Figures of answers whose shares are known by construction."""

from dataclasses import replace

import pytest
from scipy import stats

from validation.blind.benchmark.answer import Answer
from validation.blind.benchmark.figures import (
    Figure,
    again_figure,
    figures,
    place_figures,
    repaired,
    right_first,
    tie_figures,
    tied,
    time_figures,
    verdict_figures,
)
from validation.blind.benchmark.kept import Kept
from validation.blind.plant import Case

NAMED = Case("n", "named", (("oil.air", "small"),))
RIGHT = Answer("n", "c", "d", "oil.air", ("oil.air",), ("oil.air", "sensor.lag"), footprint=500.0)
WRONG = replace(RIGHT, verdict="sensor.lag", added=("sensor.lag",), ranking=("sensor.lag", "oil.air"))


def found(*rows: tuple[Case, Answer]) -> dict[str, Figure]:
    table = [replace(case, name=f"{case.name}{k}") for k, (case, _) in enumerate(rows)]
    answers = {case.name: replace(answer, case=case.name) for case, (_, answer) in zip(table, rows, strict=True)}
    return {figure.label: figure for figure in verdict_figures(table, answers)}


def count(rows: dict[str, Figure], start: str) -> tuple[int, int]:
    (figure,) = (f for label, f in rows.items() if label.startswith(start))
    return figure.hits, figure.of


def test_interval_is_that_of_clopper_and_pearson() -> None:
    figure = Figure("", 3, 40, (0, 10))
    low, high = (value / 100 for value in figure.interval)
    assert stats.binom.sf(2, 40, low) == pytest.approx(0.025)
    assert stats.binom.cdf(3, 40, high) == pytest.approx(0.025)
    assert figure.percent == 7.5
    assert figure.holds is True
    assert Figure("", 5, 40, (0, 10)).holds is False
    assert Figure("", 0, 0, (95, 100)).holds is None
    assert Figure("", 3, 40).holds is None
    words = [Figure("", 1, 1, target).words for target in ((95, 100), (0, 1), (93, 97), (0, 0))]
    assert words == ["at least 95 %", "at most 1 %", "93 to 97 %", "at most 0 %"]


def test_only_what_is_visible_must_be_named() -> None:
    faint = replace(WRONG, footprint=99.9)
    rows = found((NAMED, RIGHT), (NAMED, WRONG), (NAMED, faint), (NAMED, replace(RIGHT, footprint=100.0)))
    assert count(rows, "right effect named first, footprint 100") == (2, 3)
    assert count(rows, "right effect among the first two") == (3, 3)
    assert count(rows, "a wrong effect named, footprint below") == (1, 1)


def test_a_tie_is_wrong_but_told() -> None:
    tie = replace(WRONG, confusable=(("sensor.lag", "oil.air"),))
    assert not right_first((NAMED, tie))
    assert tied((NAMED, tie))
    assert not tied((NAMED, replace(RIGHT, confusable=tie.confusable)))
    assert not tied((NAMED, replace(tie, confusable=(("oil.air", "card.sampling"),))))
    rows = found((NAMED, tie), (NAMED, RIGHT))
    assert count(rows, "right effect named first, footprint 100") == (1, 2)
    assert count(rows, "another named first") == (1, 2)


def test_no_answer_is_wrong() -> None:
    silent = Answer("n", "c", "d", trouble="given up")
    rows = found((NAMED, silent), (NAMED, RIGHT))
    assert count(rows, "right effect named first, footprint 100") == (1, 2)
    assert count(rows, "cases without an answer") == (1, 2)


def test_nulls_by_what_disturbs_them() -> None:
    plain, coloured = Case("p", "none"), Case("c", "none", nuisances=("coloured",))
    none, unknown = Answer("", "c", "d", "none"), Answer("", "c", "d", "unknown")
    both = Case("b", "none", nuisances=("coloured", "gain"))
    rows = found((plain, none), (plain, none), (coloured, RIGHT), (coloured, unknown), (both, none))
    assert count(rows, "a physical effect named although none") == (1, 5)
    assert count(rows, "the same answered with unknown") == (1, 5)
    assert count(rows, "named although only white noise") == (0, 2)
    assert count(rows, "named although only the noise is coloured") == (1, 2)
    assert count(rows, "named although two nuisances") == (0, 1)


def test_outside_the_catalogue() -> None:
    beyond = Case("b", "beyond", (("shaft.force", "large"),))
    left_out = Case("l", "left-out", (("oil.air", "large"),), left_out=("oil.air",))
    unknown = Answer("", "c", "d", "unknown", footprint=1e3)
    silent = replace(unknown, verdict="none", footprint=3.0)
    rows = found((beyond, unknown), (left_out, WRONG), (left_out, unknown), (beyond, silent))
    assert count(rows, "an effect outside the catalogue answered") == (2, 4)
    assert count(rows, "a name given to an effect outside") == (1, 4)
    assert count(rows, "answered with unknown, footprint 100") == (2, 3)


def test_pairs() -> None:
    pair = Case("p", "pair", (("oil.air", "large"), ("sensor.lag", "large")))
    both = replace(RIGHT, added=("sensor.lag", "oil.air"), parts={"oil.air": 200.0, "sensor.lag": 1e4})
    one = replace(both, added=("sensor.lag",), parts={"oil.air": 20.0, "sensor.lag": 1e4})
    rows = found((pair, both), (pair, one), (pair, replace(both, added=("oil.air", "valve.offset"))))
    assert count(rows, "two effects at once") == (1, 3)
    assert count(rows, "both named, each with a footprint") == (1, 2)
    assert count(rows, "one of the two named") == (2, 3)


@pytest.mark.parametrize(
    ("base", "final", "bound", "good"),
    [(1.0, 0.1, 0.01, True), (1.0, 0.11, 0.01, False), (0.1, 0.06, 0.03, True), (0.1, 0.061, 0.03, False)],
)
def test_repaired(base: float, final: float, bound: float, good: bool) -> None:
    answer = replace(RIGHT, base=base, final=final, bound=bound, held=1.06 if good else 1.04)
    assert repaired((NAMED, answer)) is good
    rows = found((NAMED, answer), (NAMED, replace(answer, verdict="unknown")))
    assert count(rows, "error against the truth after adding") == (int(good), 1)
    assert count(rows, "held-out residual after adding") == (0 if good else 2, 2)


def test_cover_pools_intervals_and_leaves_nuisances_out() -> None:
    plain, gain = Case("p", "none"), Case("g", "none", nuisances=("gain",))
    ten, nine = replace(RIGHT, determined=10, missed=("tau",)), replace(RIGHT, determined=9)
    rows = found((NAMED, ten), (NAMED, nine), (NAMED, RIGHT), (plain, nine), (gain, ten))
    assert count(rows, "95 percent intervals after the repair") == (18, 19)
    assert count(rows, "the same of the base model") == (9, 9)


def test_the_time() -> None:
    table = [replace(NAMED, name=name) for name in "abc"]
    walls = {"a": 59.0, "b": 61.0, "c": 0.0}
    answers = {name: replace(RIGHT, case=name, wall=wall) for name, wall in walls.items()}
    clocked = {
        "a": replace(WRONG, case="a", wall=31.0),
        "b": replace(RIGHT, case="b", wall=60.0),
        "c": replace(RIGHT, case="c", wall=99.0),
    }
    rows = {figure.label: figure for figure in time_figures(table, answers, clocked)}
    assert count(rows, "diagnosed within 60 s, one core") == (1, 2)
    assert count(rows, "diagnosed within 60 s, two cores") == (2, 3)
    assert count(rows, "the same answer with two cores") == (2, 3)


def test_what_older_code_has_answered_is_answered_again() -> None:
    table = [replace(NAMED, name=name) for name in "abcd"]
    before = {name: replace(RIGHT, case=name, code="old") for name in "ab"}
    answers = {name: replace(WRONG if name == "b" else RIGHT, case=name, held=1.01) for name in "abcd"}
    figure = again_figure(table, Kept(answers, before=before))
    assert (figure.hits, figure.of) == (1, 2)


def test_all_figures_are_there() -> None:
    kept = Kept({"n": RIGHT}, {"n": RIGHT}, {"n": RIGHT}, {"n": RIGHT})
    labels = [figure.label for figure in figures([NAMED], kept)]
    assert len(labels) == len(set(labels))
    for part in (verdict_figures([NAMED], {}), time_figures([NAMED], {}, {}), tie_figures([NAMED], {})):
        assert {figure.label for figure in part} <= set(labels)


def test_where_effects_were_located() -> None:
    table = [replace(NAMED, name=name) for name in "abcd"]
    places = {
        "a": Answer("a", "c", "d", slot="oil", rank=1, cover=0.95),
        "b": Answer("b", "c", "d", slot="supply", alike=("oil",), rank=2, cover=0.95),
        "c": Answer("c", "c", "d", slot="spool", rank=3, cover=0.85),
    }
    small = {"c": replace(RIGHT, case="c", footprint=3.0)}
    rows = {figure.label: (figure.hits, figure.of) for figure in place_figures(table, small, places)}
    assert rows["the slot of the effect located first"] == (1, 3)
    assert rows["the same, footprint 100 or more"] == (1, 2)
    assert rows["the same, or tied with that which is first"] == (2, 2)
    assert rows["the band holds the true term over nine tenths of its range"] == (2, 3)
    assert rows["the same, its slot located first"] == (1, 1)


def test_what_became_of_ties() -> None:
    table = [replace(NAMED, name=name) for name in "abcd"]
    right, wrong = NAMED.effects[0][0], "oil.air" if NAMED.effects[0][0] != "oil.air" else "valve.offset"
    followed = {
        "a": Answer("a", "c", "d", verdict=wrong, rivals=(wrong, right), after=right, settled=True),
        "b": Answer("b", "c", "d", verdict=right, rivals=(right, wrong), after=wrong, settled=False),
        "c": Answer("c", "c", "d", verdict=right),
        "d": Answer("d", "c", "d", verdict=wrong, rivals=(wrong, "supply.droop"), after=wrong, settled=False),
    }
    rows = {figure.label: (figure.hits, figure.of) for figure in tie_figures(table, followed)}
    assert rows["a tie settled by its next test, for the right effect"] == (1, 2)
    assert rows["ties with a next test that the right effect had no part in"] == (1, 3)
