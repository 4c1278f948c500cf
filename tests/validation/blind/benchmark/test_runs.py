"""Choosing and running cases with a fake diagnosis: shards are parts, kills cost one case, a hang costs its own."""

from collections.abc import Callable
from pathlib import Path
from types import ModuleType

import pytest

from pysim.types import BadInput
from validation.blind.benchmark.answer import Answer
from validation.blind.benchmark.runs import Choice, run
from validation.blind.benchmark.store import Store
from validation.blind.benchmark.workers import Task
from validation.blind.plant import Case, cases

TABLE = cases(1)
SOME = [case for case in TABLE if case.kind == "named"][:6]

FAKE = """
import os, time
from pathlib import Path
from validation.blind.benchmark.answer import Answer

def right(case):
    time.sleep(0.01)
    return Answer(case.name, os.environ.get("BLIND_CODE", "new"), "2026-01-01", case.expected[0], wall=2.0)

def troubled(case):
    if case.name.endswith("n0.1-u"):
        raise RuntimeError("no pump today")
    if case.name.endswith("n0.1-angle"):
        os._exit(7)
    if case.name.endswith("n0.5-u"):
        time.sleep(60)
    return right(case)
"""


@pytest.fixture
def fake(imported: Callable[[str], ModuleType]) -> ModuleType:
    return imported(FAKE)


def test_shards_are_disjoint_and_together_everything() -> None:
    parts = [Choice(shard=(k, 4)).of(TABLE) for k in (1, 2, 3, 4)]
    names = [case.name for part in parts for case in part]
    assert len(names) == len(set(names)) == len(TABLE) == 1090
    assert max(map(len, parts)) - min(map(len, parts)) <= 1
    kinds = {case.kind for case in parts[0][:60]}
    assert kinds == {"none", "named", "beyond", "left-out", "pair"}


def test_kinds_names_and_samples() -> None:
    assert {c.kind for c in Choice(("none", "pair")).of(TABLE)} == {"none", "pair"}
    assert len(Choice(names="*oil.air-small*").of(TABLE)) > 6
    sample = Choice(("none",), sample=5, seed=3).of(TABLE)
    assert sample == Choice(("none",), sample=5, seed=3).of(TABLE)
    assert sample != Choice(("none",), sample=5, seed=4).of(TABLE)
    halves = [Choice(("none",), sample=5, seed=3, shard=(k, 2)).of(TABLE) for k in (1, 2)]
    assert {c.name for half in halves for c in half} == {c.name for c in sample}
    with pytest.raises(BadInput, match="there is no kind 'nulls'"):
        Choice(("nulls",))
    with pytest.raises(BadInput, match="5/4"):
        Choice(shard=(5, 4))


def test_answers_are_kept_and_not_asked_for_again(tmp_path: Path, fake: ModuleType) -> None:
    store, said = Store(tmp_path / "answers"), []
    task: Task = fake.right
    assert run(SOME[:4], store, task, "new", workers=2, say=said.append) == 4
    assert {name: a.verdict for name, a in store.read().items()} == {c.name: c.expected[0] for c in SOME[:4]}
    assert said[0].startswith("4 of 4 cases")
    assert said[-1].startswith("4/4 ")
    assert run(SOME, store, task, "new", workers=1, say=said.append) == 2
    assert run(SOME, store, task, "new", say=said.append) == 0
    assert (
        run(SOME[:1], store, task, "newer", counts=lambda answer: answer.code == "new", workers=1, say=said.append) == 0
    )
    assert run(SOME[:1], store, task, "newer", workers=1, say=said.append) == 1


def test_a_case_that_fails_crashes_or_hangs_costs_itself_alone(tmp_path: Path, fake: ModuleType) -> None:
    store = Store(tmp_path / "answers")
    task: Task = fake.troubled
    assert run(SOME, store, task, "new", workers=2, limit=3.0, say=lambda line: None) == 6
    found = {case.name.rpartition("-n")[2]: store.read()[case.name] for case in SOME}
    assert found["0.1-u"].trouble == "RuntimeError: no pump today"
    assert found["0.1-angle"].trouble == "the process ended with 7"
    assert found["0.5-u"].trouble == "given up after 3 s"
    assert [found[k].verdict for k in ("0.02-u", "0.02-angle", "0.5-angle")] == [SOME[0].expected[0]] * 3
    assert {a.code for a in found.values()} == {"new"}
    assert not any(found[k].verdict for k in ("0.1-u", "0.1-angle", "0.5-u"))


def test_stopped_in_the_middle_it_has_kept_what_was_answered(tmp_path: Path, fake: ModuleType) -> None:
    store = Store(tmp_path / "answers")
    task: Task = fake.right

    def stop(line: str) -> None:
        if line.startswith("2/"):
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        run(SOME, store, task, "new", workers=1, say=stop)
    assert len(store.read()) == 2
    assert run(SOME, store, task, "new", workers=1, say=lambda line: None) == 4


def test_cases_and_answers_can_be_sent() -> None:
    import pickle

    for thing in (SOME[0], Answer("a", "b", "c", parts={"x": 1.0}), Case("a", "none")):
        assert pickle.loads(pickle.dumps(thing)) == thing
