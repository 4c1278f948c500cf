"""The version and the commit that reports, records and FMUs carry, from a clone, a copy and an archive of sources."""

import subprocess
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from packaging.version import Version

from fmu_build import version as asked
from fmu_build.version import RELEASE, this_commit, version

Git = Callable[..., str]


@pytest.fixture(autouse=True)
def place(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """A folder that stands for that of the program."""
    monkeypatch.setattr(asked, "_ROOT", tmp_path.resolve())
    version.cache_clear()
    yield tmp_path
    version.cache_clear()


@pytest.fixture
def git(place: Path) -> Git:
    """Runs git there, where one file is committed."""

    def run(*words: str) -> str:
        own = ("-c", "user.name=a", "-c", "user.email=a@example.org", "-c", "commit.gpgsign=false")
        return subprocess.run(["git", *own, *words], cwd=place, check=True, capture_output=True, text=True).stdout

    run("init")
    (place / "pyproject.toml").write_text("")
    (place / "a.py").write_text("1\n")
    run("add", ".")
    run("commit", "-m", "a")
    return run


def again() -> Version:
    """What a new process would say, in the form that packages have to have."""
    version.cache_clear()
    assert str(Version(version())) == version()
    return Version(version())


def test_a_commit_is_dirty_where_code_differs_and_not_where_pages_do(place: Path, git: Git) -> None:
    clean = git("rev-parse", "HEAD")[:12]
    (place / "a.md").write_text("a page\n")
    assert this_commit() == clean
    (place / "a.py").write_text("2\n")
    assert this_commit() == f"{clean}-dirty"


def test_a_clone_has_its_tag_how_far_it_is_beyond_and_its_commit(place: Path, git: Git) -> None:
    untagged = again()
    assert str(untagged) == f"{RELEASE}.dev0+g{git('rev-parse', 'HEAD')[:12]}"
    git("tag", "some-other-tag")
    assert again() == untagged
    git("tag", "v0.2.0")
    tagged = again()
    assert str(tagged) == "0.2.0"
    (place / "a.py").write_text("2\n")
    changed = again()
    assert str(changed) == f"0.2.0.post0+g{git('rev-parse', 'HEAD')[:12]}.dirty"
    git("commit", "-a", "-m", "b")
    later = again()
    assert str(later) == f"0.2.0.post1+g{git('rev-parse', 'HEAD')[:12]}"
    assert untagged < tagged < changed < later


def test_a_folder_inside_the_clone_of_another_has_no_commit(
    place: Path, git: Git, monkeypatch: pytest.MonkeyPatch
) -> None:
    (place / "inside").mkdir()
    (place / "inside" / "pyproject.toml").write_text("")
    monkeypatch.setattr(asked, "_ROOT", place.resolve() / "inside")
    assert this_commit() == ""
    assert str(again()) == f"{RELEASE}.dev0"


@pytest.mark.usefixtures("git")
def test_a_clone_on_a_computer_without_git_runs(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setenv("PATH", str(tmp_path))
    assert str(again()) == f"{RELEASE}.dev0"


def test_an_archive_of_sources_says_what_it_was_made_from(place: Path) -> None:
    (place / "pyproject.toml").write_text("")
    assert str(again()) == f"{RELEASE}.dev0"
    (place / "PKG-INFO").write_text("Metadata-Version: 2.4\nName: a\nVersion: 0.3.0.post2+gabc\n\nVersion: 9\n")
    assert str(again()) == "0.3.0.post2+gabc"


def test_an_installed_one_has_that_of_its_metadata(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(asked.metadata, "version", lambda name: {"hydraulic-test-bench": "0.4.0"}[name])
    assert str(again()) == "0.4.0"
