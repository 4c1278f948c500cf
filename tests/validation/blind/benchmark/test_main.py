"""The command line: wrong use is told, a report is written beside its answers."""

from pathlib import Path

import pytest

from validation.blind.benchmark.__main__ import TABLE_SEED, main
from validation.blind.benchmark.answer import Answer
from validation.blind.benchmark.fingerprint import fingerprint
from validation.blind.benchmark.report import BEGIN, END
from validation.blind.benchmark.store import Store
from validation.blind.plant import cases


@pytest.mark.parametrize(
    "words",
    [
        [],
        ["run", "--shard", "5/4"],
        ["run", "--shard", "half"],
        ["run", "--kinds", "nulls"],
        ["carry"],
        ["carry", "--from", "no code", "--seed", "1"],
        ["fly"],
    ],
)
def test_wrong_use(words: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    assert main(words) == 2
    assert capsys.readouterr().err


def test_a_run_of_nothing(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["run", "--names", "no such case", "--store", str(tmp_path)]) == 0
    assert capsys.readouterr().out.startswith("0 of 0 cases to answer, code ")


def test_report(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "README.md").write_text(f"{BEGIN}\n{END}\n")
    store = Store(tmp_path / "answers")
    case = next(case for case in cases(TABLE_SEED) if case.kind == "named")
    for verdict in ("unknown", case.expected[0]):
        store.add(case, Answer(case.name, fingerprint(), "2026-01-01", verdict, footprint=500.0))
    assert main(["report", "--store", str(store.folder)]) == 0
    assert len((store.folder / "named.jsonl").read_text().splitlines()) == 1
    text = (tmp_path / "README.md").read_text()
    assert "| right effect named first, footprint 100 or more | 1 of 1 |" in text
    assert str(tmp_path / "naming.png") in capsys.readouterr().out
