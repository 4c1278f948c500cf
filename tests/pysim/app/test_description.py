"""dataset.toml edited: what is written reads back, and what is refused leaves it as it was."""

from pathlib import Path

import pytest

from pysim.app.description import change_description, described, read_description
from pysim.io import read_dataset, write_dataset
from pysim.types import BadInput
from tests.pysim.diagnose.toy import measured


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


def test_what_is_refused_changes_nothing(path: Path) -> None:
    before, content = path.read_bytes(), read_description(path)
    content["signals"]["x"]["unit"] = "parsec"
    with pytest.raises(BadInput, match="parsec"):
        change_description(path, content)
    assert path.read_bytes() == before


def test_bare_logs_get_a_description_that_reads(tmp_path: Path) -> None:
    (tmp_path / "a.txt").write_text("0 1 2 7\n1 2 3 7\n")
    columns = [
        {"name": "t", "role": "time", "unit": "s", "variable": "", "noise": None},
        {"name": 'odd "name"', "role": "input", "unit": "%", "variable": "cmd", "noise": None},
        {"name": "p", "role": "output", "unit": "bar", "variable": "p", "noise": 0.5},
        {"name": "rest", "role": "-", "unit": "1", "variable": "", "noise": None},
    ]
    content = described("logs", columns, [{"file": "a.txt", "kind": "other", "use": "fit"}])
    found = change_description(tmp_path / "dataset.toml", content)
    assert found is not None
    assert found.signal('odd "name"').variable == "cmd"
    assert found.logs()[0].data["p"].tolist() == [2e5, 3e5]  # type: ignore[index]
    assert found.signal("p").noise == 0.5e5
    with pytest.raises(BadInput, match="at least one input"):
        described("logs", columns[:1], [])
