"""A project is served once, whatever became of earlier servers."""

import errno
import json
import os
import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace

import pytest

from pysim.app import lock
from pysim.app.lock import held
from pysim.types import BadInput

ROOT = Path(__file__).parents[3]
HOLDER = """
import sys, time
from pathlib import Path
from pysim.app.lock import held
with held(Path(sys.argv[1])) as tell:
    tell('http://127.0.0.1:1234')
    print('held', flush=True)
    time.sleep(60)
"""


def test_the_second_is_told_where_the_first_is(tmp_path: Path) -> None:
    with held(tmp_path) as tell:
        with (
            pytest.raises(BadInput, match=r"another workbench is being started on it; try again in a moment$"),
            held(tmp_path),
        ):
            pass
        tell("http://[::1]:8080")
        told = rf"runs at http://\[::1\]:8080 \(process {os.getpid()}\); use that one, or end it first$"
        for _ in range(2):  # and being refused takes nothing from the first
            with pytest.raises(BadInput, match=told), held(tmp_path):
                pass
    with held(tmp_path):
        pass


def test_a_server_that_was_killed_leaves_no_lock(tmp_path: Path) -> None:
    words = [sys.executable, "-c", HOLDER, str(tmp_path)]
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    with subprocess.Popen(words, stdout=subprocess.PIPE, env=environment) as holder:
        assert holder.stdout is not None
        assert holder.stdout.readline().strip() == b"held"
        with pytest.raises(BadInput, match=rf"http://127.0.0.1:1234 \(process {holder.pid}\)"), held(tmp_path):
            pass
        holder.kill()
        holder.wait()
        with held(tmp_path):
            pass


def test_what_stands_in_the_file_counts_for_nothing_once_nobody_holds_it(tmp_path: Path) -> None:
    words = json.dumps({"pid": os.getpid(), "address": "http://127.0.0.1:1"})  # a number that was given out again
    for left in (words, "x" * 5000, ""):
        (tmp_path / "server.lock").write_text(left)
        with (
            held(tmp_path) as tell,
            pytest.raises(BadInput, match="another workbench is being started"),
            held(tmp_path),
        ):
            tell("")
        (tmp_path / "server.lock").unlink()


def test_a_disk_that_locks_no_files_is_said(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    fcntl = pytest.importorskip("fcntl")

    def none_left(*_: object) -> None:
        raise OSError(errno.ENOLCK, "No locks available")

    monkeypatch.setattr(fcntl, "flock", none_left)
    with (
        pytest.raises(BadInput, match=r"locks no files \(No locks available\); put the project on another"),
        held(tmp_path),
    ):
        pass


def test_on_windows_one_byte_behind_the_words_is_locked(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    seen: list[tuple[int, int, int]] = []

    def locking(file: int, mode: int, count: int) -> None:
        seen.append((os.lseek(file, 0, os.SEEK_CUR), mode, count))
        if len(seen) > 1:
            raise PermissionError(13, "Permission denied")

    monkeypatch.setattr(lock.sys, "platform", "win32")
    monkeypatch.setitem(sys.modules, "msvcrt", SimpleNamespace(LK_NBLCK=2, locking=locking))
    with held(tmp_path) as tell:
        tell("http://127.0.0.1:5")
        with pytest.raises(BadInput, match=r"runs at http://127.0.0.1:5"), held(tmp_path):
            pass
        assert (tmp_path / "server.lock").stat().st_size < seen[0][0]
    assert seen == [(2**20, 2, 1)] * 2
