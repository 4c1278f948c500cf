"""What counts of the stored answers."""

from pathlib import Path

import pytest

from validation.blind.benchmark import kept
from validation.blind.benchmark.answer import Answer
from validation.blind.benchmark.fingerprint import fingerprint
from validation.blind.benchmark.store import Store
from validation.blind.plant import cases


def test_what_this_code_answers_again_counts(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    one, other, unknown = cases(1)[:3]
    code, answers, again = fingerprint(), Store(tmp_path / "answers"), Store(tmp_path / "again")
    monkeypatch.setattr(kept, "AGAIN", again.folder)
    monkeypatch.setattr(kept, "standing", lambda store, code: _Every())
    for case in (one, other):
        answers.add(case, Answer(case.name, "older", "2026-01-01", "none"))
    for case in (other, unknown):
        again.add(case, Answer(case.name, code, "2026-01-02", "unknown"))
    found = kept.read_kept(answers)
    assert {name: answer.verdict for name, answer in found.answers.items()} == {one.name: "none", other.name: "unknown"}
    assert {name: answer.code for name, answer in found.before.items()} == {other.name: "older"}


class _Every:
    steps = ()

    def counts(self, answer: Answer) -> bool:
        return True
