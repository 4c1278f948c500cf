"""Temporary folders: gone with the work, swept where a kill left them, and one sentence where there is no room."""

import errno
import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import pytest

from fmu_build import BuildError, build
from fmu_build import scratch as scratch_module
from fmu_build.cli import main
from fmu_build.scratch import FORGOTTEN, SETTLED, scratch, sweep

CLASS = "HydraulicTestBench.Controllers.Gain"


def left(folder: Path, number: int, age: float) -> Path:
    """What a process of that number has left so long ago, s."""
    made = folder / f"fmu_build-{number}-abc"
    made.mkdir()
    (made / "model.c").write_text("/* half */")
    os.utime(made, (time.time() - age,) * 2)
    return made


def ended_process() -> int:
    done = subprocess.Popen([sys.executable, "-c", ""])
    done.wait()
    return done.pid


@pytest.mark.skipif(os.name == "nt", reason="Windows cannot be asked whether a process is there without harm")
def test_what_a_killed_process_left_is_swept_and_nothing_else(tmp_path: Path) -> None:
    gone = left(tmp_path, ended_process(), SETTLED + 10)
    kept = [left(tmp_path, os.getpid(), SETTLED + 10), left(tmp_path, ended_process() + 100_000_000, 1.0)]
    other = tmp_path / "somebody-1-abc"
    other.mkdir()
    os.utime(other, (0, 0))
    link = tmp_path / "fmu_build-1-link"
    link.symlink_to(other)
    sweep(tmp_path)
    assert not gone.exists()
    assert all(one.exists() for one in (*kept, other, link))


def test_a_forgotten_one_goes_whoever_has_its_number_now(tmp_path: Path) -> None:
    old = left(tmp_path, os.getpid(), FORGOTTEN + 10)
    sweep(tmp_path)
    assert not old.exists()


@pytest.mark.skipif(not hasattr(os, "geteuid") or os.geteuid() != 0, reason="only root can give a file away")
def test_another_users_is_left_alone(tmp_path: Path) -> None:
    theirs = left(tmp_path, 1, FORGOTTEN + 10)
    os.chown(theirs, 12345, 12345)
    sweep(tmp_path)
    assert theirs.exists()


def test_a_kill_leaves_what_the_next_start_sweeps(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    text = (
        "import os\nfrom fmu_build.scratch import scratch\nwith scratch() as f: (f / 'a').write_text('b'); os._exit(9)"
    )
    subprocess.run([sys.executable, "-c", text], env={**os.environ, "TMPDIR": str(tmp_path)}, check=False)
    (killed,) = tmp_path.glob("fmu_build-*")
    os.utime(killed, (time.time() - SETTLED - 10,) * 2)
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    scratch_module._sweep_once.cache_clear()
    with scratch() as own:
        assert own.is_dir()
        if os.name != "nt":
            assert not killed.exists()
    assert not own.exists()


def test_no_room_is_one_sentence_with_the_cure(tmp_path: Path) -> None:
    with pytest.raises(BuildError, match=r"No space left.*TMPDIR") as caught, scratch():
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
    assert len(str(caught.value).splitlines()) == 1
    with pytest.raises(PermissionError), scratch():
        raise PermissionError(errno.EACCES, "another fault")


def test_no_temporary_folder_at_all(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path / "none"))
    with pytest.raises(BuildError, match="TMPDIR"):
        build(CLASS, tmp_path / "a.fmu", use_cache=False)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="no device here that is always full")
def test_an_output_that_takes_nothing_is_said_in_a_sentence(tmp_path: Path) -> None:
    for redirection in ("> /dev/full", ">&-"):
        words = f"{sys.executable} -m fmu_build {CLASS} -o {tmp_path / 'a.fmu'} {redirection}"
        done = subprocess.run(
            words, shell=True, capture_output=True, text=True, check=False, cwd=Path(__file__).parents[2]
        )
        assert done.returncode == 2
        assert len(done.stderr.strip().splitlines()) == 1
        assert "cannot be printed" in done.stderr
    assert (tmp_path / "a.fmu").is_file()


def test_the_path_is_printed(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main([CLASS, "-o", str(tmp_path / "a.fmu")]) == 0
    assert capsys.readouterr().out.strip() == str(tmp_path / "a.fmu")
