"""What makes a difference to the cache, what does not, and what is not given out of it."""

import os
import stat
import sys
from collections.abc import Mapping, Sequence
from pathlib import Path

import pytest

from fmu_build import cache
from fmu_build.cache import cache_folder, cached, content_key, store
from fmu_build.errors import BuildError

posix = pytest.mark.skipif(os.name == "nt", reason="Windows protects a user's profile by other rights")


@pytest.fixture(autouse=True)
def root(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A cache that the user names, and that does not exist yet."""
    monkeypatch.setenv("HTB_CACHE", str(tmp_path / "cache"))
    return tmp_path / "cache"


@pytest.fixture
def library(tmp_path: Path) -> Path:
    folder = tmp_path / "Library"
    folder.mkdir()
    (folder / "package.mo").write_text("package Library end Library;")
    return folder


@pytest.fixture
def fmu(tmp_path: Path) -> Path:
    """A new file to be kept."""
    path = tmp_path / "a.fmu"
    path.write_bytes(b"content")
    return path


def key(
    library: Path,
    name: str = "Library.A",
    overrides: Mapping[str, float | str] | None = None,
    options: Sequence[str] = ("FMI 2",),
) -> str:
    return content_key(name, [library], overrides or {}, options)


def aged(file: Path) -> int:
    """Make a file look as if it had been saved long ago; its time, ns."""
    os.utime(file, ns=(10**18, 10**18))
    return 10**18


def test_everything_that_shapes_the_fmu_changes_the_key(library: Path) -> None:
    keys = [
        key(library),
        key(library, name="Library.B"),
        key(library, overrides={"a": 1.0}),
        key(library, overrides={"a": 2.0}),
        key(library, options=["FMI 3"]),
    ]
    (library / "A.mo").write_text("model A end A;")
    keys.append(key(library))
    (library / "A.mo").rename(library / "B.mo")
    keys.append(key(library))
    assert len(set(keys)) == len(keys)


def test_place_time_and_other_files_do_not_matter(library: Path, tmp_path: Path) -> None:
    before = key(library)
    os.utime(library / "package.mo", (0, 0))
    (library / "notes.md").write_text("x")
    moved = library.rename(tmp_path / "elsewhere")
    assert key(moved) == before


@pytest.mark.parametrize("settled", [-1.0, 3600.0])  # s: the file counts as saved long ago, and as saved just now
def test_a_text_of_the_same_length_is_another_key(
    library: Path, monkeypatch: pytest.MonkeyPatch, settled: float
) -> None:
    """Also where its time is set back to what it was, as some tools do that copy files."""
    monkeypatch.setattr(cache, "_SETTLED", settled)
    file = library / "A.mo"
    keys = []
    for text in ("model A Real a; end A;", "model A Real b; end A;"):
        file.write_text(text)
        aged(file)
        keys.append(key(library))
    assert keys[0] != keys[1]


def test_a_settled_file_is_read_once(library: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(cache, "_SETTLED", -1.0)
    read: list[Path] = []
    plain = Path.read_bytes

    def read_bytes(path: Path) -> bytes:
        read.append(path)
        return plain(path)

    monkeypatch.setattr(Path, "read_bytes", read_bytes)
    assert key(library) == key(library)
    assert read.count(library / "package.mo") == 1


def test_an_fmu_comes_back(fmu: Path) -> None:
    assert cached("k") is None
    kept = store("k", fmu)
    assert cached("k") == kept
    assert kept.read_bytes() == b"content"
    assert kept.parent == cache_folder()


def test_an_fmu_that_was_changed_is_refused(fmu: Path) -> None:
    kept = store("k", fmu)
    kept.write_bytes(b"planted")
    with pytest.raises(BuildError, match=f"{kept.name} was changed after it was built; delete it"):
        cached("k")
    kept.unlink()
    assert cached("k") is None


@posix
def test_new_folders_are_for_this_user_alone(root: Path) -> None:
    before = os.umask(0)
    try:
        folder = cache_folder()
    finally:
        os.umask(before)
    assert [stat.S_IMODE(path.stat().st_mode) for path in (root, folder)] == [0o700, 0o700]


@posix
@pytest.mark.parametrize("mode", [0o777, 0o770, 0o702])
@pytest.mark.parametrize("place", ["cache", "cache/fmu"])
def test_a_folder_that_others_may_write_into_is_refused(root: Path, fmu: Path, place: str, mode: int) -> None:
    store("k", fmu)
    (root.parent / place).chmod(mode)
    with pytest.raises(BuildError, match=rf"other users may write into .*{place}, .*chmod -R go-w"):
        cached("k")


@posix
def test_a_folder_that_others_may_read_is_taken(root: Path, fmu: Path) -> None:
    root.mkdir()
    root.chmod(0o755)
    assert store("k", fmu) == cached("k")


@posix
def test_another_users_folder_is_refused(root: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    root.mkdir(mode=0o700)
    owner = root.stat().st_uid
    monkeypatch.setattr("os.geteuid", lambda: owner + 1)
    with pytest.raises(BuildError, match=r"cache belongs to another user, .*; name a folder .* HTB_CACHE"):
        cached("k")


@pytest.mark.skipif(sys.platform in ("win32", "darwin"), reason="the variable is that of Linux")
def test_without_a_name_it_is_the_systems_place(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("HTB_CACHE")
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "new"))
    assert cache_folder() == tmp_path / "new" / "hydraulic-test-bench" / "fmu"


def test_a_cache_that_cannot_be_written_names_the_cure(root: Path, fmu: Path) -> None:
    root.touch()
    with pytest.raises(BuildError, match=r"cannot write into .*HTB_CACHE"):
        store("k", fmu)


def test_the_unused_go_first(fmu: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for k, name in enumerate("abc"):
        os.utime(store(name, fmu), (k, k))
    assert (used := cached("a")) is not None  # just now
    assert used.stat().st_mtime == 0  # who has read it sees it unchanged
    monkeypatch.setattr(cache, "KEPT_FMUS", 2)
    store("d", fmu)
    assert [cached(name) is not None for name in "abcd"] == [True, False, False, True]


def test_what_was_used_within_a_day_stays(fmu: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(cache, "KEPT_FMUS", 1)
    for name in "abc":
        store(name, fmu)
    assert all(cached(name) is not None for name in "abc")


def test_what_another_process_has_taken_away_meanwhile_does_not_matter(
    fmu: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(cache, "KEPT_FMUS", 0)
    old = [store(name, fmu) for name in "ab"]
    for path in old:
        os.utime(path, (0, 0))
    listed = Path.glob

    def glob(folder: Path, pattern: str) -> list[Path]:
        found = list(listed(folder, pattern))
        old[0].unlink(missing_ok=True)  # between the listing and the look at it
        return found

    monkeypatch.setattr(Path, "glob", glob)
    assert cached("a") is None
    assert store("c", fmu).read_bytes() == b"content"
    assert cached("b") is None
