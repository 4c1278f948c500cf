"""A project is served once, whatever became of earlier servers."""

import errno
import json
import os
from pathlib import Path

import pytest

from pysim.app.lock import held
from pysim.types import BadInput


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
