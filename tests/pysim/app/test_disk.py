"""Moved and removed whole or not at all."""

import errno
from pathlib import Path

import pytest

from pysim.app.disk import disk_trouble, move_all, remove
from pysim.types import BadInput
from tests.pysim.app.in_use import content, in_use


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """Two logs, each in a folder of its own."""
    for name in ("a", "b"):
        (tmp_path / name).mkdir()
        (tmp_path / name / "log.csv").write_text(name)
    return tmp_path


def test_where_one_cannot_be_moved_all_stay(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    before = content(folder)
    in_use(monkeypatch, folder / "b/log.csv")
    with pytest.raises(BadInput, match=r"b: Access is denied; close the program that shows it or a file in it"):
        move_all([(folder / "a", folder / "c"), (folder / "b", folder / "d")])
    assert content(folder) == before


def test_what_is_in_use_is_not_removed_by_half(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    remove(folder / "a", folder / "aside")
    assert content(folder) == {"b/log.csv": b"b"}
    in_use(monkeypatch, folder / "b/log.csv")
    with pytest.raises(BadInput, match="close the program that shows it"):
        remove(folder / "b", folder / "aside")
    assert content(folder) == {"b/log.csv": b"b"}


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
