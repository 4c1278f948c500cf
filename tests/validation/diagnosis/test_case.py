"""Made-up answers: the right one holds, a wrong one, a surplus effect and a changed estimate fail."""

from dataclasses import replace
from pathlib import Path

import pytest

from pysim.effects import STANDARD_LIBRARY, read_catalogue
from pysim.types import AddedEffect, Diagnosis, Estimate, LedgerStep, Stage
from validation.diagnosis.answers import kept, read_answers, write_answers
from validation.diagnosis.case import AGAIN, against_stored, against_truth, of_stored, run
from validation.diagnosis.sets import Told

EFFECTS = {effect.name: effect for effect in read_catalogue(STANDARD_LIBRARY)}
TOLD = Told(("valve.deadband",), {"tau": 0.004}, {"u_0": 0.016})


def diagnosis(*names: str, value: float = 0.0161, verdict: str = "", held: float = 1.0) -> Diagnosis:
    added, estimates = [], [Estimate("tau", "s", 0.004, 0.004, 0.0, 0.05, 1e-5, (0.0039, 0.0041))]
    for name in names:
        effect = EFFECTS[name]
        own = Estimate(
            f"{effect.slot}.{effect.parameters[0].name}", "1", value, 0, -1, 1, 1e-4, (value - 2e-4, value + 2e-4)
        )
        added.append(AddedEffect(effect, effect.slot, (own,)))
        estimates.append(own)
    ledger = tuple(LedgerStep(step, fit, fit, {}, True, 1.0) for step, fit in (("refit", 2.0), ("last", held)))
    stages = (Stage("last", tuple(estimates)),)
    verdict = verdict or (names[0] if names else "none")
    return Diagnosis(verdict, "", tuple(added), (), (), ledger, (), (), {}, stages=stages)


def wrong(found: Diagnosis) -> list[str]:
    return [f.claim.split(":")[1].split()[0] for f in against_truth("x", found, TOLD) if not f.holds]


def test_against_the_truth() -> None:
    assert wrong(diagnosis("valve.deadband")) == []
    assert wrong(diagnosis("valve.offset")) == ["valve.offset"]
    assert wrong(diagnosis("valve.deadband", "oil.air")) == ["valve.deadband"]
    assert wrong(diagnosis("valve.deadband", verdict="unknown")) == ["unknown"]
    assert wrong(diagnosis("valve.deadband", held=1.06)) == ["held-out"]
    far = [f.claim for f in against_truth("x", diagnosis("valve.deadband", value=0.0165), TOLD) if not f.holds]
    assert far == ["x: valve.deadband spoolOpening.u_0 = 0.0165, truth 0.016; off by"]


@pytest.mark.parametrize(("truth", "verdict", "good"), [("none", "none", True), ("unknown", "none", False)])
def test_nothing_to_add(truth: str, verdict: str, good: bool) -> None:
    told = replace(TOLD, names=(truth,), spoken={})
    assert all(f.holds for f in against_truth("x", diagnosis(verdict=verdict), told)) is good


def test_against_what_is_stored(tmp_path: Path) -> None:
    path, now = tmp_path / "answers.json", kept(diagnosis("valve.deadband"))
    assert read_answers(path) == {}
    write_answers({"b": now, "a": kept(diagnosis())}, path)
    assert list(read_answers(path)) == ["a", "b"]
    before = read_answers(path)["b"]
    assert before == now
    assert (before.fit, before.values["valve.deadband: u_0"][0]) == ((2.0, 1.0), 0.0161)
    assert all(f.holds for f in against_stored("x", now, before))
    moved = kept(diagnosis("valve.deadband", value=0.01614))
    assert [f.holds for f in against_stored("x", moved, before)] == [True, False]
    assert not any(f.holds for f in against_stored("x", kept(diagnosis("oil.air")), before))
    assert not any(f.holds for f in against_stored("x", now, None))


def test_a_stored_verdict_is_held_against_the_truth() -> None:
    right, wrong, more = (kept(diagnosis(*n)) for n in (["valve.deadband"], ["oil.air"], ["valve.deadband", "oil.air"]))
    assert [f.holds for f in of_stored("x", right, TOLD)] == [True]
    assert [f.holds for f in of_stored("x", wrong, TOLD)] == [False]
    assert [f.holds for f in of_stored("x", more, TOLD)] == [False]
    assert [f.holds for f in of_stored("x", None, TOLD)] == [False]
    assert list(of_stored("x", right, None)) == []


def test_the_seed_draws_a_few_sets() -> None:
    asked: list[str] = []

    def answer(name: str) -> Diagnosis:
        asked.append(name)
        return diagnosis("valve.deadband")

    list(run(answer=answer, seed=3))
    first = list(asked)
    list(run(answer=answer, seed=3))
    assert len(first) == AGAIN
    assert asked[AGAIN:] == first
