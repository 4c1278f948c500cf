"""What makes a difference to the cache, and what does not."""

import os
from pathlib import Path

import pytest

from fmu_build import cache
from fmu_build.cache import cache_folder, cached, content_key, store
from fmu_build.errors import BuildError


@pytest.fixture(autouse=True)
def own_cache(tmp_path, monkeypatch):
    monkeypatch.setenv("HTB_CACHE", str(tmp_path / "cache"))


@pytest.fixture
def library(tmp_path):
    folder = tmp_path / "Library"
    folder.mkdir()
    (folder / "package.mo").write_text("package Library end Library;")
    return folder


def key(library, name="Library.A", overrides=None, options=("FMI 2",)):
    return content_key(name, [library], overrides or {}, options)


def test_everything_that_shapes_the_fmu_changes_the_key(library):
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


def test_place_time_and_other_files_do_not_matter(library, tmp_path):
    before = key(library)
    os.utime(library / "package.mo", (0, 0))
    (library / "notes.md").write_text("x")
    moved = library.rename(tmp_path / "elsewhere")
    assert key(moved) == before


def test_an_fmu_comes_back(tmp_path):
    (tmp_path / "a.fmu").write_bytes(b"content")
    assert cached("k") is None
    assert store("k", tmp_path / "a.fmu") == cached("k")
    assert cached("k").read_bytes() == b"content"
    assert cached("k").parent == cache_folder()


def test_the_unused_go_first(tmp_path, monkeypatch):
    (tmp_path / "a.fmu").write_bytes(b"content")
    for k, name in enumerate("abc"):
        os.utime(store(name, tmp_path / "a.fmu"), (k, k))
    cached("a")  # used just now
    monkeypatch.setattr(cache, "KEPT_FMUS", 2)
    store("d", tmp_path / "a.fmu")
    assert [cached(name) is not None for name in "abcd"] == [True, False, False, True]


def test_what_was_used_within_a_day_stays(tmp_path, monkeypatch):
    monkeypatch.setattr(cache, "KEPT_FMUS", 1)
    (tmp_path / "a.fmu").touch()
    for name in "abc":
        store(name, tmp_path / "a.fmu")
    assert all(cached(name) is not None for name in "abc")


def _two_old_ones(folder, monkeypatch):
    """FMUs a and b in a cache that keeps none, unused for long; a.fmu in the folder is their file."""
    monkeypatch.setattr(cache, "KEPT_FMUS", 0)
    (folder / "a.fmu").write_bytes(b"content")
    old = [store(name, folder / "a.fmu") for name in "ab"]
    for path in old:
        os.utime(path, (0, 0))
    return old


def test_what_another_process_has_taken_away_meanwhile_does_not_matter(tmp_path, monkeypatch):
    old = _two_old_ones(tmp_path, monkeypatch)
    listed = Path.glob

    def glob(folder, pattern):
        found = list(listed(folder, pattern))
        old[0].unlink()  # between the listing and the look at it
        return found

    monkeypatch.setattr(Path, "glob", glob)
    assert store("c", tmp_path / "a.fmu").read_bytes() == b"content"
    assert cached("b") is None


def test_a_file_that_cannot_be_let_go_of_does_not_cost_the_new_one(tmp_path, monkeypatch):
    """Windows keeps a file that a run has open."""
    old = _two_old_ones(tmp_path, monkeypatch)
    let_go = Path.unlink

    def unlink(path, missing_ok=False):
        if path == old[0]:
            raise PermissionError(13, "in use")
        let_go(path, missing_ok)

    monkeypatch.setattr(Path, "unlink", unlink)
    assert store("c", tmp_path / "a.fmu").read_bytes() == b"content"
    assert [path.exists() for path in old] == [True, False]


def test_a_cache_that_cannot_be_written_names_the_cure(tmp_path, monkeypatch):
    (tmp_path / "file").touch()
    monkeypatch.setenv("HTB_CACHE", str(tmp_path / "file" / "cache"))
    with pytest.raises(BuildError, match="HTB_CACHE"):
        store("k", tmp_path / "file")


@pytest.mark.parametrize(
    ("system", "variable", "tail"),
    [
        ("linux", "XDG_CACHE_HOME", ("hydraulic-test-bench", "fmu")),
        ("win32", "LOCALAPPDATA", ("hydraulic-test-bench", "fmu")),
    ],
)
def test_the_systems_own_place(monkeypatch, tmp_path, system, variable, tail):
    monkeypatch.delenv("HTB_CACHE")
    monkeypatch.setattr(cache.sys, "platform", system)
    monkeypatch.setenv(variable, str(tmp_path))
    assert cache_folder() == tmp_path.joinpath(*tail)
