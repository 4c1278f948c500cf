"""Nothing that lasts stands silent, and nothing is said of what is quick."""

import io
import shutil
import sys
import threading
from pathlib import Path

import pytest

from pysim.cli import progress
from pysim.cli.progress import ProgressBar, Working, announce_compilation
from pysim.simulate import build_kernel, kernel_is_built
from pysim.simulate.kernel import build


class Stream(io.StringIO):
    """Standard error that says when so many lines have come."""

    def __init__(self, wanted: int, *, live: bool) -> None:
        super().__init__()
        self._wanted, self._live = wanted, live
        self.enough = threading.Event()

    def isatty(self) -> bool:
        return self._live

    def write(self, text: str) -> int:
        count = super().write(text)
        if self.getvalue().count("...") >= self._wanted:
            self.enough.set()
        return count


@pytest.mark.parametrize("live", [False, True])
def test_what_lasts_is_said_again_and_again(live: bool, monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("_MOMENT", "_TICK", "_PAUSE"):
        monkeypatch.setattr(progress, name, 0.0)
    monkeypatch.setattr(sys, "platform", "linux")
    stream = Stream(3, live=live)
    monkeypatch.setattr(sys, "stderr", stream)
    with Working("Building Toy"):
        assert stream.enough.wait(60)
    first, second = stream.getvalue().replace("\r\x1b[K", "\n").split("\n", 3)[live : live + 2]
    assert (first, second.startswith("Building Toy ... ")) == ("Building Toy ...", True)
    assert stream.getvalue().endswith("\r\x1b[K" if live else "\n")


def test_what_is_quick_is_not(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    monkeypatch.setattr(progress, "_MOMENT", 1e6)
    with Working("Building Toy"):
        pass
    assert capsys.readouterr().err == ""


def test_compilation_is_announced_where_there_is_no_library(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    library = build_kernel()
    monkeypatch.setattr(build, "cache_folder", lambda purpose: tmp_path)
    monkeypatch.setattr(build, "PREBUILT", tmp_path)
    announce_compilation()
    assert capsys.readouterr().err
    shutil.copy(library, tmp_path / library.name)
    assert kernel_is_built()
    announce_compilation()
    assert capsys.readouterr().err == ""


def test_bar_leaves_its_last_state_where_there_is_no_terminal(capsys: pytest.CaptureFixture[str]) -> None:
    with ProgressBar("runs") as progress:
        for done in range(4):
            progress(done, 3)
    error = capsys.readouterr().err
    assert error.startswith("runs             [##############################] 3/3")
    assert error.count("\n") == 1
