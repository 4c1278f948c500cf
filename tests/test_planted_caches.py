"""Another user plants files wherever the program keeps its own: nothing of them is loaded."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from fmu_build import build
from tests.conftest import STORE, new_cache

ROOT = Path(__file__).parents[1]
SOMEBODY = 12345
PURPOSES = ("fmu", "kernel", "modelica", "zig")  # FMUs, finished and unpacked; the kernel; what the compilers keep
COMPILERS = ("rumoca", "zig")  # where they would keep it by themselves, below the place for such files

pytestmark = pytest.mark.skipif(
    not hasattr(os, "geteuid") or os.geteuid() != 0, reason="only root can give a file to another user"
)


@pytest.fixture
def home(tmp_path: Path) -> Path:
    """A home of its own, whose cache holds what a run needs."""
    (tmp_path / "home" / ".cache").mkdir(parents=True)
    cache = new_cache(tmp_path / "home" / ".cache" / "hydraulic-test-bench")
    shutil.copytree(STORE / "kernel", cache / "kernel")
    for purpose in ("fmu", "modelica"):
        (cache / purpose).mkdir()
    for folder, _, _ in os.walk(tmp_path):
        Path(folder).chmod(0o700)
    return tmp_path / "home"


def cache_of(home: Path) -> Path:
    return home / ".cache" / "hydraulic-test-bench"


def run_in(home: Path, words: list[str], **further: str) -> "subprocess.CompletedProcess[str]":
    taken = ("HTB_CACHE", "XDG_CACHE_HOME", "ZIG_GLOBAL_CACHE_DIR", "ZIG_LOCAL_CACHE_DIR")
    kept = {name: value for name, value in os.environ.items() if name not in taken}
    surroundings = {**kept, "HOME": str(home), "TMPDIR": str(home.parent), **further}
    words = [sys.executable, "-m", *words]
    return subprocess.run(words, env=surroundings, cwd=ROOT, capture_output=True, text=True, check=False)


def simulated(home: Path, tmp_path: Path) -> "subprocess.CompletedProcess[str]":
    """A run of an FMU, which unpacks it and loads the kernel."""
    fmu = build("HydraulicTestBench.Controllers.Gain")
    return run_in(home, ["pysim", "simulate", str(fmu), "-o", str(tmp_path / "out.csv")])


def built(home: Path, tmp_path: Path, **further: str) -> "subprocess.CompletedProcess[str]":
    """A model compiled from Modelica by way of C."""
    return run_in(home, ["fmu_build", "HydraulicTestBench.Controllers.Gain", "-o", str(tmp_path / "g.fmu")], **further)


def test_a_cache_of_our_own_serves(home: Path, tmp_path: Path) -> None:
    done = simulated(home, tmp_path)
    assert done.returncode == 0, done.stderr
    assert {path.name for path in cache_of(home).iterdir()} <= {*PURPOSES}


@pytest.mark.parametrize(
    ("place", "how"),
    [(".", "owned"), ("fmu", "owned"), ("kernel", "owned"), (".", "writable"), ("kernel", "writable"), ("fmu", "link")],
)
def test_what_another_user_has_planted_is_refused(place: str, how: str, home: Path, tmp_path: Path) -> None:
    """Their folder, one that they may write into, and a link to one of theirs."""
    folder = cache_of(home) / place
    if how == "owned":
        os.chown(folder, SOMEBODY, SOMEBODY)
    elif how == "writable":
        folder.chmod(0o777)
    else:
        theirs = tmp_path / "theirs"
        shutil.move(folder.resolve(), theirs)
        os.chown(theirs, SOMEBODY, SOMEBODY)
        (cache_of(home) / place if place != "." else cache_of(home)).symlink_to(theirs)
    done = simulated(home, tmp_path)
    assert done.returncode == 2
    assert "another user" in done.stderr or "other users may write" in done.stderr
    assert "Traceback" not in done.stderr
    assert not (tmp_path / "out.csv").exists()


def test_a_planted_library_of_another_content_is_not_loaded(home: Path, tmp_path: Path) -> None:
    """Its name holds a digest: a file that another process of ours has damaged is made anew or refused."""
    for library in (cache_of(home) / "kernel").iterdir():
        library.write_bytes(b"\x7fELF of somebody")
    done = simulated(home, tmp_path)
    assert "Traceback" not in done.stderr
    assert done.returncode == 2 or (tmp_path / "out.csv").exists()


@pytest.mark.parametrize("purpose", ["modelica", "zig"])
def test_what_another_user_has_planted_for_a_compiler_is_refused(purpose: str, home: Path, tmp_path: Path) -> None:
    folder = cache_of(home) / purpose
    folder.unlink() if folder.is_symlink() else folder.rmdir()
    folder.mkdir(mode=0o700)
    os.chown(folder, SOMEBODY, SOMEBODY)
    done = built(home, tmp_path)
    assert done.returncode == 2, done.stderr
    assert f"{folder} belongs to another user" in done.stderr
    assert not (tmp_path / "g.fmu").exists()
    assert list(folder.iterdir()) == []


def test_the_compilers_use_no_folder_of_their_own(home: Path, tmp_path: Path) -> None:
    """Another user's folders, where each compiler would go by itself or is sent by the surroundings."""
    named = tmp_path / "named"
    theirs = [named / "global", named / "local", *(home / ".cache" / name for name in COMPILERS)]
    for folder in theirs:
        folder.mkdir(parents=True)
        folder.chmod(0o777)
        os.chown(folder, SOMEBODY, SOMEBODY)
    done = built(home, tmp_path, ZIG_GLOBAL_CACHE_DIR=str(theirs[0]), ZIG_LOCAL_CACHE_DIR=str(theirs[1]))
    assert done.returncode == 0, done.stderr
    assert [list(folder.iterdir()) for folder in theirs] == [[], [], [], []]
    assert list((cache_of(home) / "modelica").iterdir())


def test_the_kernel_is_not_compiled_with_what_another_user_has_planted(home: Path, tmp_path: Path) -> None:
    shutil.rmtree(cache_of(home) / "kernel")
    (cache_of(home) / "zig").unlink()
    (cache_of(home) / "zig").mkdir(mode=0o700)
    os.chown(cache_of(home) / "zig", SOMEBODY, SOMEBODY)
    done = simulated(home, tmp_path)
    assert done.returncode == 2, done.stderr
    assert f"{cache_of(home) / 'zig'} belongs to another user" in done.stderr
    assert not (tmp_path / "out.csv").exists()
