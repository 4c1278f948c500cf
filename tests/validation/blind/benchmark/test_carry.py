"""Older answers stand for a newer code only where a drawn sample comes out the same; what does not is said."""

import json
from collections.abc import Callable
from dataclasses import asdict, replace
from pathlib import Path
from types import ModuleType

import pytest

from pysim.types import BadInput
from validation.blind.benchmark.answer import Answer
from validation.blind.benchmark.carry import Carried, Draw, carry, differences, read_carried, standing
from validation.blind.benchmark.kept import read_kept
from validation.blind.benchmark.store import Store
from validation.blind.benchmark.workers import Task
from validation.blind.plant import Case, cases

TABLE = [case for case in cases(1) if case.kind == "named"][:12]

FAKE = """
from validation.blind.benchmark.answer import Answer

def same(case):
    return Answer(case.name, "new", "2026-02-02", case.expected[0], held=1.0 + 1e-9, wall=9.0, cpu=8.0)

def other(case):
    held = 1.01 if case.seed == LAST else 1.0
    return Answer(case.name, "new", "2026-02-02", case.expected[0], held=held, wall=9.0, cpu=8.0)
"""


@pytest.fixture
def fake(imported: Callable[[str], ModuleType]) -> ModuleType:
    return imported(FAKE.replace("LAST", str(TABLE[0].seed)))


def old(case: Case) -> Answer:
    return Answer(case.name, "old", "2026-01-01", case.expected[0], held=1.0, wall=2.0, cpu=2.0)


@pytest.fixture
def store(tmp_path: Path) -> Store:
    store = Store(tmp_path / "answers")
    for case in TABLE:
        store.add(case, old(case))
    return store


def test_where_the_sample_comes_out_the_same_all_stand(store: Store, fake: ModuleType) -> None:
    task: Task = fake.same
    said: list[str] = []
    assert not any(map(standing(store, "new").counts, store.read().values()))
    assert carry(TABLE, store, task, Draw("old", 4, 3), "new", workers=1, say=said.append)
    assert all(map(standing(store, "new").counts, store.read().values()))
    assert not standing(store, "old").counts(Answer("a", "new", ""))
    (step,) = read_carried(store)
    assert (step.older, step.newer, step.seed) == ("old", "new", 3)
    assert set(step.cases) == {name for name, answer in store.read().items() if answer.code == "new"}
    assert len(step.cases) == 4
    assert said[0] == "4 cases of code old again, by code new"
    assert all("the same; 9 s" in line for line in said[1:])


def test_where_one_differs_none_stands_and_nothing_is_kept(store: Store, fake: ModuleType) -> None:
    task: Task = fake.other
    said: list[str] = []
    assert not carry(TABLE, store, task, Draw("old", 12, 3), "new", workers=1, say=said.append)
    assert standing(store, "new").steps == ()
    assert {answer.code for answer in store.read().values()} == {"old"}
    assert f"{TABLE[0].name}: held 1.0 became 1.01; 9 s" in " ".join(said)
    assert said[-1] == "1 of 12 differ: the older answers do not stand for this code"


def test_on_another_computer_the_older_code_answers_again_too(store: Store, fake: ModuleType, tmp_path: Path) -> None:
    task: Task = fake.same
    for case in TABLE:
        store.add(case, replace(old(case), held=1.002))  # the last bits of the computer of then
    assert not carry(TABLE, store, task, Draw("old", 4, 3), "new", workers=1, say=str)
    here = Store(tmp_path / "here")
    for case in TABLE[:5]:
        here.add(case, old(case))
    assert carry(TABLE, store, task, Draw("old", 4, 3), "new", anew=here, workers=1, say=str)
    assert all(map(standing(store, "new").counts, store.read().values()))
    (step,) = read_carried(store)
    assert step.anew
    assert set(step.cases) <= {case.name for case in TABLE[:5]}


def test_a_code_that_answered_nothing_is_refused(store: Store, fake: ModuleType) -> None:
    task: Task = fake.same
    with pytest.raises(BadInput, match="--from older: the store holds no answers of that code; it holds those of old"):
        carry(TABLE, store, task, Draw("older", 4, 3), "new", say=print)


def test_what_may_change_is_neither_drawn_nor_counted(store: Store, fake: ModuleType) -> None:
    task: Task = fake.other
    assert carry(TABLE, store, task, Draw("old", 12, 3, (TABLE[0].name,)), "new", workers=1, say=lambda line: None)
    (step,) = read_carried(store)
    assert step.but == (TABLE[0].name,)
    assert TABLE[0].name not in step.cases
    counted = {name for name, answer in store.read().items() if standing(store, "new").counts(answer)}
    assert counted == {case.name for case in TABLE[1:]}


def test_it_goes_on_step_by_step(tmp_path: Path) -> None:
    store = Store(tmp_path)
    rows = [
        Carried("a", "b", "d", 1, ("one",), ("x*",)),
        Carried("b", "c", "d", 1, ("one",)),
        Carried("x", "y", "d", 1, ()),
    ]
    (tmp_path / "carried.json").write_text(json.dumps([asdict(row) for row in rows]))
    assert read_carried(store) == tuple(rows)
    counts = standing(store, "c").counts
    assert [counts(Answer("one", code, "d")) for code in "abcxy"] == [True, True, True, False, False]
    assert [counts(Answer("x1", code, "d")) for code in "abc"] == [False, True, True]


def test_only_what_stands_is_counted(store: Store) -> None:
    kept = read_kept(store)
    assert (len(kept.answers), kept.stale) == (0, 12)


def test_when_how_fast_and_by_which_code_is_no_difference() -> None:
    one = old(TABLE[0])
    assert differences(one, replace(one, code="c", day="d", wall=1e3, cpu=1e3)) == []
    assert differences(one, replace(one, missed=("tau",))) == ["missed () became ('tau',)"]
