"""Answered again: the same is found the same, another verdict or number is not, and a missed target fails."""

from dataclasses import replace

from validation.blind.benchmark.answer import Answer
from validation.blind.benchmark.case import SAMPLE, compared, run, targets
from validation.blind.benchmark.kept import Kept
from validation.blind.plant import Case, cases

TABLE = cases(1)


def right(case: Case) -> Answer:
    verdict = case.expected[0]
    added = case.expected if verdict not in ("none", "unknown") else ()
    return Answer(
        case.name, "c", "2026-01-01", verdict, added, added[:2], footprint=1e3 if case.effects else None, held=1.0,
        base=1.0, final=0.02, bound=0.02, determined=20, missed=("tau",), slot="", wall=20.0,
    )  # fmt: skip


def test_the_same_again_holds_and_the_sample_follows_the_seed() -> None:
    kept, seen = Kept({case.name: right(case) for case in TABLE}), []

    def task(case: Case) -> Answer:
        seen.append(case.name)
        return right(case)

    found = list(run(3, task, kept))
    assert len(seen) == SAMPLE
    failed = [f.claim for f in found if not f.holds]
    assert [claim.partition(":")[0] for claim in failed] == [  # none is stored
        "diagnosed within 60 s, two cores",
        "the same answer with two cores as with one",
        "the slot of the effect located first",
        "the band holds the true term over nine tenths of its range",
        "a tie settled by its next test, for the right effect",
    ]
    first = list(seen)
    list(run(3, task, kept))
    assert seen[SAMPLE:] == first
    list(run(4, task, kept))
    assert seen[2 * SAMPLE :] != first


def test_what_differs_fails() -> None:
    stored = right(next(case for case in TABLE if case.kind == "named"))
    assert all(f.holds for f in compared(stored, stored))
    assert [f.holds for f in compared(stored, replace(stored, held=1.02))] == [True, False, True, True, True]
    assert [f.holds for f in compared(stored, replace(stored, footprint=1100.0))][-1] is False
    assert next(f.holds for f in compared(stored, replace(stored, verdict="unknown"))) is False
    assert [f.holds for f in compared(stored, replace(stored, base=None))] == [True, True, False, True, True]
    small = replace(stored, footprint=1.0)
    assert all(f.holds for f in compared(small, replace(small, footprint=1.2)))


def test_an_empty_store_and_a_missed_target_fail() -> None:
    found = list(run(1, right, Kept()))
    assert not found[0].holds
    assert not any(f.holds for f in found if "of 0," in f.claim)
    answers = {case.name: right(case) for case in TABLE}
    nulls = [case for case in TABLE if case.kind == "none"]
    for case in nulls[:4]:
        answers[case.name] = replace(answers[case.name], verdict="oil.air", added=("oil.air",))
    (alarm,) = (f for f in targets(TABLE, Kept(answers)) if f.claim.startswith("a physical effect named"))
    assert not alarm.holds
    assert f"4 of {len(nulls)}, at most 1 %" in alarm.claim
    answers[nulls[0].name] = right(nulls[0])
    (alarm,) = (f for f in targets(TABLE, Kept(answers)) if f.claim.startswith("a physical effect named"))
    assert alarm.holds


def test_shares_of_too_few_cases_are_told() -> None:
    answers = {case.name: right(case) for case in TABLE if case.kind == "named"}
    nulls = [case.name for case in TABLE if case.kind == "none"]
    answers |= {case.name: right(case) for case in TABLE if case.name in nulls[:299]}
    counts = {f.claim: f for f in targets(TABLE, Kept(answers)) if "answered, short of" in f.claim}
    assert [f.holds for f in counts.values()] == [False, True]
    assert "cases 'none': 299 answered, short of 300 by" in counts
