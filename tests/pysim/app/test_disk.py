"""Moved and removed whole or not at all."""

import errno
from pathlib import Path

import pytest

from pysim.app.disk import disk_trouble, move_all, remove
from pysim.types import BadInput


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """Two logs, each in a folder of its own."""
    for name in ("a", "b"):
        (tmp_path / name).mkdir()
        (tmp_path / name / "log.csv").write_text(name)
    return tmp_path


def content(folder: Path) -> dict[str, str]:
    """Every file below it."""
    return {path.relative_to(folder).as_posix(): path.read_text() for path in folder.rglob("*") if path.is_file()}


def test_where_one_cannot_be_moved_all_stay(folder: Path) -> None:
    before = content(folder)
    with pytest.raises(BadInput, match=r"b: No such file or directory"):
        move_all([(folder / "a", folder / "c"), (folder / "b", folder / "none/d")])
    assert content(folder) == before


def test_what_is_removed_is_gone_and_what_cannot_be_stays(folder: Path) -> None:
    remove(folder / "a", folder / "aside")
    assert content(folder) == {"b/log.csv": "b"}
    with pytest.raises(BadInput, match="No such file"):
        remove(folder / "a", folder / "aside")
    assert content(folder) == {"b/log.csv": "b"}


@pytest.mark.parametrize(
    ("error", "words"),
    [
        (PermissionError(13, "Access is denied", "a.csv"), "a.csv: Access is denied; close the program that shows it"),
        (OSError(errno.ENOSPC, "No space left", "a.csv"), "a.csv: No space left; make room on the disk"),
        (PermissionError(13, "cannot be replaced; close it", "a.csv"), "a.csv: cannot be replaced; close it"),
        (OSError("odd"), "odd; close the program"),
    ],
)
def test_it_is_told_in_a_sentence(error: OSError, words: str) -> None:
    assert str(disk_trouble(error)).startswith(words)
