"""Finished parts are kept, and nobody else's are taken for them."""

from dataclasses import replace
from pathlib import Path

import pytest

from pysim.diagnose.journal import Journal, identity
from pysim.types import BadInput, Dataset, MeasuredRecord
from tests.pysim.diagnose.toy import measured, toy_subject


def test_a_part_is_found_once_and_comes_back_bit_for_bit(tmp_path: Path) -> None:
    path, calls = tmp_path / "deep" / "journal.jsonl", []

    def find() -> dict[str, list[float]]:
        calls.append(1)
        return {"x": [0.1 + 0.2, 1e-300, -1 / 3]}

    first = Journal(path, "mine").once("refit", find)
    again = Journal(path, "mine")
    assert again.once("refit", find) == first
    assert (len(calls), again.reused) == (1, 1)


def test_a_line_that_a_kill_has_cut_is_found_again(tmp_path: Path) -> None:
    path = tmp_path / "journal.jsonl"
    journal = Journal(path, "mine")
    journal.once("one", lambda: 1)
    journal.once("two", lambda: 2)
    path.write_text(path.read_text()[:-5])
    again = Journal(path, "mine")
    assert again.once("one", lambda: 10) == 1
    assert again.once("two", lambda: 20) == 20
    assert Journal(path, "mine").once("two", lambda: 30) == 20


def test_another_diagnosis_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "journal.jsonl"
    Journal(path, "mine").once("one", lambda: 1)
    with pytest.raises(
        BadInput,
        match="journal of another diagnosis: other model, data, libraries or options, or an older program; delete it",
    ):
        Journal(path, "yours")
    path.write_text("hello\n")
    with pytest.raises(BadInput, match="no journal of a diagnosis"):
        Journal(path, "mine")


def test_without_a_file_parts_are_kept_for_this_run_alone() -> None:
    journal = Journal(None, "mine")
    assert [journal.once("one", lambda: k) for k in (1, 2)] == [1, 1]  # noqa: B023


def other(dataset: Dataset, first: MeasuredRecord) -> Dataset:
    """With another first record."""
    return replace(dataset, records=(first, *dataset.records[1:]))


def test_identity_is_that_of_model_data_catalogue_and_settings() -> None:
    one = toy_subject(measured(1))
    assert identity(one, {"seed": 0}) == identity(toy_subject(measured(1)), {"seed": 0})
    record = one.dataset.records[0]
    later = replace(record, data=replace(record.data, time=record.data.time + 0.5))
    others = [
        *(
            identity(replace(one, dataset=other(one.dataset, changed)), {"seed": 0})
            for changed in (later, replace(record, kind="step"))
        ),
        identity(one, {"seed": 1}),
        identity(toy_subject(measured(2)), {"seed": 0}),
        identity(toy_subject(measured(1), ("toy.bias",)), {"seed": 0}),
        identity(replace(one, free=("m", "d")), {"seed": 0}),
        identity(replace(one, bounds={"m": (0.5, 2.0)}), {"seed": 0}),
    ]
    assert len({identity(one, {"seed": 0}), *others}) == 8
