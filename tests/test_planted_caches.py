"""Another user plants files wherever the program keeps its own: nothing of them is loaded."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from fmu_build import build
from tests.conftest import STORE

ROOT = Path(__file__).parents[1]
SOMEBODY = 12345
PURPOSES = ("fmu", "kernel")  # finished and unpacked FMUs; the compiled kernel

pytestmark = pytest.mark.skipif(
    not hasattr(os, "geteuid") or os.geteuid() != 0, reason="only root can give a file to another user"
)


@pytest.fixture
def home(tmp_path: Path) -> Path:
    """A home of its own, whose cache holds what a run needs."""
    cache = tmp_path / "home" / ".cache" / "hydraulic-test-bench"
    for purpose in PURPOSES:
        shutil.copytree(STORE / purpose, cache / purpose) if purpose == "kernel" else (cache / purpose).mkdir(
            parents=True
        )
    for folder, _, _ in os.walk(tmp_path):
        Path(folder).chmod(0o700)
    return tmp_path / "home"


def cache_of(home: Path) -> Path:
    return home / ".cache" / "hydraulic-test-bench"


def simulated(home: Path, tmp_path: Path) -> "subprocess.CompletedProcess[str]":
    """A run of an FMU, which unpacks it and loads the kernel."""
    kept = {name: value for name, value in os.environ.items() if name not in ("HTB_CACHE", "XDG_CACHE_HOME")}
    surroundings = {**kept, "HOME": str(home), "TMPDIR": str(tmp_path)}
    fmu = build("HydraulicTestBench.Controllers.Gain")
    words = [sys.executable, "-m", "pysim", "simulate", str(fmu), "-o", str(tmp_path / "out.csv")]
    return subprocess.run(words, env=surroundings, cwd=ROOT, capture_output=True, text=True, check=False)


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
