"""What counts of the stored answers."""

import json
from pathlib import Path

import pytest

from validation.blind.benchmark import kept
from validation.blind.benchmark.answer import Answer
from validation.blind.benchmark.fingerprint import fingerprint
from validation.blind.benchmark.store import Store
from validation.blind.plant import cases


def test_of_two_answers_that_stand_the_newer_counts(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    one, other, third, unknown, left = (case.name for case in cases(1)[:5])
    code, answers, again = fingerprint(), Store(tmp_path / "answers"), Store(tmp_path / "again")
    monkeypatch.setattr(kept, "AGAIN", again.folder)
    table = {case.name: case for case in cases(1)[:5]}
    for name, by in ((one, "old"), (other, "old"), (third, code), (left, "old")):
        answers.add(table[name], Answer(name, by, "2026-01-01", "none"))
    for name, by in ((other, "mid"), (third, "mid"), (unknown, code), (left, "mid")):
        again.add(table[name], Answer(name, by, "2026-01-02", "unknown"))
    step = {"day": "2026-01-03", "seed": 1, "cases": [one], "but": [], "anew": False}
    steps = [{**step, "older": "old", "newer": "mid"}, {**step, "older": "mid", "newer": code, "but": [left]}]
    (answers.folder / "carried.json").write_text(json.dumps(steps))
    found = kept.read_kept(answers)
    assert {name: answer.verdict for name, answer in found.answers.items()} == {
        one: "none", other: "unknown", third: "none",
    }  # fmt: skip
    assert {name: answer.code for name, answer in found.before.items()} == {other: "old"}
