"""A batch goes on where it was, and a case that ends its process costs nothing but itself."""

from pathlib import Path

import pytest

from pysim.types import BadInput
from validation import batch
from validation.batch import Line, answered, read_lines
from validation.shares import Share, claims


def ask(names: list[str], file: Path) -> list[Line]:
    return answered("tests.validation.answering", names, file, workers=1, limit=60, together=3)


def test_every_case_has_a_line_and_only_troubled_ones_are_asked_again(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(batch, "this_commit", lambda: "0123456789ab")
    file = tmp_path / "lines.jsonl"
    names = ["double-1", "die-2", "double-3", "refuse-4"]
    found = ask(names, file)
    assert [line["case"] for line in found] == names
    assert [line.get("value") for line in found] == [2, None, 6, None]
    assert "3" in found[1]["trouble"]
    assert "no such number" in found[3]["trouble"]
    ask([*names, "double-5"], file)
    assert read_lines(file)["double-5"]["value"] == 10
    cases = [line.partition(",")[0] for line in file.read_text().splitlines()]
    assert sorted(cases.count(f'{{"case": "{name}"') for name in (*names, "double-5")) == [1, 1, 1, 2, 2]


def test_answers_of_a_checkout_that_differs_from_its_commit_are_not_gone_on_with(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(batch, "this_commit", lambda: "0123456789ab-dirty")
    file = tmp_path / "lines.jsonl"
    file.write_text('{"case": "double-1", "value": 7}\n')
    assert ask(["double-1"], file)[0]["value"] == 2


def test_without_a_commit_and_with_another_nothing_is_kept(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(batch, "this_commit", lambda: "")
    with pytest.raises(BadInput, match="no checkout"):
        ask(["double-1"], tmp_path / "a.jsonl")
    commits = iter(["0123456789ab", "ba9876543210"])
    monkeypatch.setattr(batch, "this_commit", lambda: next(commits))
    with pytest.raises(BadInput, match="no longer"):
        ask(["double-1"], tmp_path / "b.jsonl")
    assert not read_lines(tmp_path / "b.jsonl")


def test_a_share_has_the_interval_of_clopper_and_pearson() -> None:
    none, some = Share("none", 0, 300, (0, 1)), Share("some", 3, 40, (95, 100))
    assert none.interval == pytest.approx((0.0, 100 * (1 - 0.025 ** (1 / 300))))
    assert none.beyond == 0
    assert some.beyond == pytest.approx(95 - 7.5)
    assert [finding.holds for finding in claims([none, some])] == [True, False]


def test_a_share_of_too_few_cases_is_not_judged() -> None:
    (finding,) = claims([Share("few", 0, 19, (95, 100)), Share("without a target", 1, 2)])
    assert finding.skipped
