"""Answers survive a kill in the middle of a line; the latest counts; tidying loses nothing that counts."""

from dataclasses import replace
from pathlib import Path

from validation.blind.benchmark.answer import Answer
from validation.blind.benchmark.store import Store
from validation.blind.plant import Case

ONE, TWO, OTHER = Case("one", "none"), Case("two", "none"), Case("other", "named", (("oil.air", "large"),))


def answer(case: Case, verdict: str = "none") -> Answer:
    return Answer(case.name, "code", "2026-01-01", verdict)


def test_kinds_have_files_and_the_latest_counts(tmp_path: Path) -> None:
    store = Store(tmp_path / "answers")
    assert store.read() == {}
    for case, verdict in ((ONE, "unknown"), (OTHER, "oil.air"), (TWO, "none"), (ONE, "none")):
        store.add(case, answer(case, verdict))
    assert sorted(path.name for path in store.folder.iterdir()) == ["named.jsonl", "none.jsonl"]
    assert {name: a.verdict for name, a in store.read().items()} == {"one": "none", "two": "none", "other": "oil.air"}


def test_half_a_line_is_forgotten_and_does_not_spoil_the_next(tmp_path: Path) -> None:
    store = Store(tmp_path)
    store.add(ONE, answer(ONE))
    path = tmp_path / "none.jsonl"
    path.write_text(path.read_text() + answer(TWO).line()[:20])
    assert list(store.read()) == ["one"]
    store.add(TWO, answer(TWO, "unknown"))
    assert store.read()["two"].verdict == "unknown"
    assert store.read()["one"] == answer(ONE)


def test_tidy_keeps_the_latest_in_the_order_of_the_table(tmp_path: Path) -> None:
    store = Store(tmp_path)
    for case, verdict in ((TWO, "none"), (ONE, "unknown"), (ONE, "none"), (OTHER, "oil.air")):
        store.add(case, answer(case, verdict))
    before = store.read()
    store.tidy([ONE, TWO, OTHER])
    assert store.read() == before
    lines = (tmp_path / "none.jsonl").read_text().splitlines()
    assert [Answer.read(line).case for line in lines] == ["one", "two"]
    store.tidy([ONE])
    assert set(store.read()) == {"one", "other"}  # a kind that the table does not have is left alone


def test_a_line_of_a_case_is_small(tmp_path: Path) -> None:
    many = replace(answer(OTHER), added=("oil.air",) * 3, parts={"oil.air": 1.23456789e5}, missed=("tau",) * 5)
    Store(tmp_path).add(OTHER, many)
    assert (tmp_path / "named.jsonl").stat().st_size < 400
