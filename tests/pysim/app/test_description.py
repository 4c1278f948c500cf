"""dataset.toml edited: what is written reads back, and what is refused leaves it as it was."""

from pathlib import Path
from typing import Any

import pytest

from pysim.app.description import (
    change_description,
    leave_out,
    put_role,
    put_unit,
    put_use,
    read_description,
    refuse_outside,
    uncounted,
)
from pysim.io import read_dataset, write_dataset
from pysim.types import BadInput
from pysim.types.record_kind import Command
from tests.toy import measured


@pytest.fixture
def path(tmp_path: Path) -> Path:
    return write_dataset(tmp_path / "toy", measured(1))


def test_what_is_edited_is_what_is_read(path: Path) -> None:
    content = read_description(path)
    content["records"][0]["use"] = "validate"
    content["signals"]["x"]["noise"] = 0.25
    change_description(path, content)
    found = read_dataset(path.parent)
    assert found.records[0].use == "validate"
    assert found.signal("x").noise == 0.25
    assert read_description(path) == content


@pytest.mark.parametrize("encoding", ["utf-16", "utf-16-le", "latin-1", "utf-8-sig"])
def test_it_is_read_in_every_encoding_that_the_command_line_takes(path: Path, encoding: str) -> None:
    text = path.read_text(encoding="utf-8").replace('name = "toy"', 'name = "Prüfstand"')
    assert "ü" in text
    mark = "\ufeff" if encoding == "utf-16-le" else ""
    path.write_bytes((mark + text).replace("\n", "\r\n").encode(encoding))
    assert read_description(path)["dataset"]["name"] == read_dataset(path.parent).name == "Prüfstand"
    refuse_outside(path)
    change_description(path, read_description(path))
    assert read_description(path)["dataset"]["name"] == read_dataset(path.parent).name == "Prüfstand"


def test_what_cannot_be_read_is_said_without_the_folder(path: Path) -> None:
    path.write_text("[dataset\n")
    with pytest.raises(BadInput, match=r"^dataset.toml: .*line 1.*; correct the TOML; drop the folder again$"):
        read_description(path)
    path.unlink()
    with pytest.raises(BadInput, match=r"^dataset.toml: cannot read dataset.toml"):
        read_description(path)


def test_what_is_refused_changes_nothing(path: Path) -> None:
    before, content = path.read_bytes(), read_description(path)
    content["signals"]["x"]["unit"] = "parsec"
    with pytest.raises(BadInput, match="parsec"):
        change_description(path, content)
    assert path.read_bytes() == before


FILES = ["./logs/a.csv", "logs//a.csv", "logs\\b.csv"]  # as a user may write them
READ = ["logs/a.csv", "logs/a.csv", "logs/b.csv"]  # as they are read


def content() -> dict[str, Any]:
    """Two records of one log, of other columns, and one of another."""
    return {"records": [{"file": file, "columns": ["time", f"x{k}"]} for k, file in enumerate(FILES)]}


@pytest.mark.parametrize("number", [0, 1, 2])
def test_a_record_is_used_otherwise_alone_however_its_file_is_written(number: int) -> None:
    found = content()
    put_use(found, READ, number, "validate")
    assert [record.get("use") for record in found["records"]] == ["validate" if k == number else None for k in range(3)]
    put_use(found, READ, number, "fit")
    assert found["records"][number]["use"] == "fit"


def test_a_log_of_which_a_record_was_refused_is_held_out_as_a_whole() -> None:
    found = content()
    put_use(found, READ[1:], 0, "test")
    assert [record.get("use") for record in found["records"]] == ["test", "test", None]


def test_refused_logs_are_left_out_however_their_files_are_written() -> None:
    found = content()
    leave_out(found, {"logs/a.csv"})
    assert [record["file"] for record in found["records"]] == ["logs\\b.csv"]
    with pytest.raises(BadInput, match="no record would be left"):
        leave_out(found, {"logs/b.csv"})


def test_sources_are_those_of_the_reader(path: Path) -> None:
    found = read_description(path)
    for record in found["records"]:
        record["file"] = f"./{record['file']}"
    change_description(path, found)
    read = [record.source for record in read_dataset(path.parent).records]
    put_use(found, read, 0, "test")
    assert found["records"][0]["use"] == "test"


def test_steps_of_the_preparation_stay_and_say_what_their_parts_are_for(path: Path) -> None:
    found = read_description(path)
    found["dataset"]["preparation"] = [{"step": "trim", "start": 0.1}, {"step": "split", "share": 0.5}]
    dataset = change_description(path, found)
    assert dataset is not None
    assert read_description(path) == found
    assert [record.use for record in dataset.records][:2] == ["fit", "test"]
    with pytest.raises(BadInput, match="a step of its preparation says what it is for"):
        put_use(found, [record.source for record in dataset.records], 1, "test")


def test_an_input_says_how_it_runs_between_samples_until_it_is_none(path: Path) -> None:
    content = read_description(path)
    content["signals"]["F"]["hold"] = "zero"
    found = change_description(path, content)
    assert found is not None
    assert found.signal("F").hold is Command.STEPS
    put_role(content, "F", "output")
    assert "hold" not in content["signals"]["F"]
    put_role(content, "F", "left out")
    assert list(content["signals"]) == ["x"]


def test_a_signal_in_volts_does_not_count_as_bar_without_a_factor(path: Path) -> None:
    content = read_description(path)
    own = content["signals"]["x"]
    own["unit"] = "V"
    assert uncounted("x", own) == ""
    put_unit("x", own, "bar", "V")
    assert "how many bar are 1 V" in uncounted("x", own)
    put_unit("x", own, "mbar", "bar")
    assert "how many mbar are 1 V" in uncounted("x", own)
    change_description(path, content)
    assert uncounted("x", read_description(path)["signals"]["x"])  # a reload knows it still
    assert uncounted("x", {**own, "factor": 40.0}) == uncounted("x", {**own, "unit": "V"}) == ""
    other = {"role": "output", "unit": "mm"}
    put_unit("y", other, "m", "mm")
    assert "quantity" not in other
