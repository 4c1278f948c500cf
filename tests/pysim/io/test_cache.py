"""Nothing is kept where another user could have put files."""

import os
import stat
import sys
from pathlib import Path

import pytest

from pysim.io import cache_folder
from pysim.types import BadInput

posix = pytest.mark.skipif(os.name == "nt", reason="Windows protects a user's profile by other rights")


@pytest.fixture
def root(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder that the user names, and that does not exist yet."""
    monkeypatch.setenv("HTB_CACHE", str(tmp_path / "named"))
    return tmp_path / "named"


def test_the_named_folder_holds_one_for_each_purpose(root: Path) -> None:
    folder = cache_folder("purpose")
    assert folder == root / "purpose"
    assert list(folder.iterdir()) == []
    assert cache_folder("purpose") == folder


@pytest.mark.skipif(sys.platform in ("win32", "darwin"), reason="the variable is that of Linux")
def test_without_a_name_it_is_the_systems_place(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("HTB_CACHE", raising=False)
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "new" / "cache"))
    assert cache_folder("purpose") == tmp_path / "new" / "cache" / "hydraulic-test-bench" / "purpose"


@posix
def test_new_folders_are_for_this_user_alone(root: Path) -> None:
    before = os.umask(0)
    try:
        folder = cache_folder("purpose")
    finally:
        os.umask(before)
    assert [stat.S_IMODE(path.stat().st_mode) for path in (root, folder)] == [0o700, 0o700]


@posix
@pytest.mark.parametrize("mode", [0o777, 0o770, 0o702])
@pytest.mark.parametrize("place", ["named", "named/purpose"])
def test_a_folder_that_others_may_write_into_is_refused(root: Path, place: str, mode: int) -> None:
    cache_folder("purpose")
    (root.parent / place).chmod(mode)
    with pytest.raises(BadInput, match=rf"other users may write into .*{place}, .*chmod -R go-w"):
        cache_folder("purpose")


@posix
def test_a_folder_that_others_may_read_is_taken(root: Path) -> None:
    root.mkdir()
    root.chmod(0o755)
    assert cache_folder("purpose").is_dir()


@posix
def test_another_users_folder_is_refused(root: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    root.mkdir(mode=0o700)
    owner = root.stat().st_uid
    monkeypatch.setattr("os.geteuid", lambda: owner + 1)
    with pytest.raises(BadInput, match=r"named belongs to another user, .*; name a folder .* HTB_CACHE"):
        cache_folder("purpose")


def test_a_place_that_cannot_be_written_is_refused_with_the_cure(root: Path) -> None:
    root.touch()
    with pytest.raises(BadInput, match=r"cannot write into .*purpose: .*HTB_CACHE"):
        cache_folder("purpose")
