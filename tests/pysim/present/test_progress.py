"""Nothing that lasts stands silent, and nothing is said of what is quick."""

import io
import json
import re
import shutil
import sys
import threading
from pathlib import Path

import pytest

from pysim.identify.greybox import Tried
from pysim.present import progress
from pysim.present.progress import (
    EventFile,
    ProgressBar,
    Searching,
    Unfolding,
    Working,
    announce_compilation,
    block,
    showing,
)
from pysim.simulate import build_kernel, kernel_is_built
from pysim.simulate.kernel import build
from pysim.types import ProgressEvent
from tests.pysim.diagnosis_answer import found_offset, step


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


def test_what_lasts_is_said_again_and_again(monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("_MOMENT", "_TICK", "_PAUSE"):
        monkeypatch.setattr(progress, name, 0.001)
    stream = Stream(3, live=False)
    monkeypatch.setattr(sys, "stderr", stream)
    with Working("Building Toy"):
        assert stream.enough.wait(60)
    first, second = stream.getvalue().split("\n", 3)[:2]
    assert (first, second) == ("Building Toy ... 0 s", "Building Toy ... 0 s")


def test_a_search_tells_the_point_it_has_come_to_where_nothing_can_be_drawn_over(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    for name in ("_MOMENT", "_PAUSE"):
        monkeypatch.setattr(progress, name, 0.001)
    stream = Stream(3, live=False)
    monkeypatch.setattr(sys, "stderr", stream)
    with Searching("Fitting") as shown:
        assert stream.enough.wait(60)  # before the first point, too
        shown(Tried("start 1", 12, 0.5, 0.7))
        stream.enough.clear()
        assert stream.enough.wait(60)
        stream.enough.clear()
        assert stream.enough.wait(60)
    assert "start 1: point 12, cost 0.5 ... " in stream.getvalue()


def test_on_a_terminal_it_is_drawn_over_and_taken_away(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(progress, "_MOMENT", 0.001)
    stream = Stream(3, live=True)
    monkeypatch.setattr(sys, "stderr", stream)
    monkeypatch.setenv("TERM", "xterm")
    with Working("Building Toy"):
        assert stream.enough.wait(60)
    assert re.search(r"Building Toy ... \d+ s", stream.getvalue())
    assert stream.getvalue().rpartition("Building")[2].count("\x1b[2K") >= 1  # its line is empty again


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


def test_without_a_terminal_there_is_a_line_for_each_event(capsys: pytest.CaptureFixture[str]) -> None:
    with Unfolding("toy") as show:
        show(ProgressEvent("refitting"))
        show(ProgressEvent("refitting", "prior: 8.1", step("prior", 8.1, 8.0, 0.9)))
    lines = capsys.readouterr().err.splitlines()
    assert [line.split(" s  ")[1] for line in lines] == ["refitting ...", "prior: 8.1"]


def test_the_block_shows_time_stage_and_the_error_falling() -> None:
    title, clock, head, *bars, learned = block(
        "toy: Mass", "screening 3 candidates", 40.0, found_offset().history, ["found"]
    )
    assert title == "toy: Mass"
    assert clock == "  0:40  screening 3 candidates"
    assert head.strip() == "residual over noise"
    assert [line.split()[0:2] for line in bars] == [["as", "it"], ["refitted", "4.20"], ["+", "toy.offset"]]
    lengths = [line.count("#") for line in bars]
    assert lengths[0] == 24 > lengths[1] > lengths[2] == 0  # nothing but noise has no bar
    assert bars[0].endswith("used to choose    8.00")
    assert learned == "  - found"


def test_before_anything_is_known_there_is_the_stage_alone() -> None:
    assert block("toy", "comparing the model as it is", 30.0, [], []) == ["toy", "  0:30  comparing the model as it is"]


class Terminal(io.StringIO):
    def isatty(self) -> bool:
        return True


def seen(drawn: str) -> list[str]:
    """Lines without what moves the cursor and gives colours."""
    return re.sub(r"\x1b\[[0-9;?]*[A-Za-z]|\r", "", drawn).rstrip().splitlines()


def test_on_a_terminal_the_block_is_drawn_over_and_stays(monkeypatch: pytest.MonkeyPatch) -> None:
    screen = Terminal()
    monkeypatch.setattr(sys, "stderr", screen)
    with Unfolding("toy") as show:
        show(ProgressEvent("refitting"))
        show(ProgressEvent("refitting", "prior: 8.1", step("prior", 8.1, 8.0, 0.9)))
        show(ProgressEvent("screening", "three promise something"))
    last = [line for line in seen(screen.getvalue()) if line][-5:]
    assert [line.split()[0] for line in last] == ["toy", "0:00", "residual", "as", "-"]
    assert last[1].endswith("done")


def test_what_went_wrong_ends_it_as_stopped(monkeypatch: pytest.MonkeyPatch) -> None:
    screen = Terminal()
    monkeypatch.setattr(sys, "stderr", screen)
    with pytest.raises(ZeroDivisionError), Unfolding("toy") as show:
        show(ProgressEvent(f"refitting {1 / 0}"))
    assert seen(screen.getvalue())[-1].endswith("stopped")


def test_a_verb_shows_its_search_where_it_is_asked_to(capsys: pytest.CaptureFixture[str]) -> None:
    with showing(True, "fitting") as say:
        say(ProgressEvent("refitting", "prior: 8.1"))
    assert capsys.readouterr().err.endswith("prior: 8.1\n")
    for progress_wanted in (None, False):  # nobody watches
        with showing(progress_wanted, "fitting") as say:
            say(ProgressEvent("refitting", "prior: 8.1"))
        assert capsys.readouterr().err == ""


def test_events_in_a_file_can_be_followed_by_a_program(tmp_path: Path) -> None:
    tell = EventFile(tmp_path / "events.jsonl")
    tell(ProgressEvent("refitting the model"))
    tell(ProgressEvent("refitting the model", "prior: 8.1", step("prior", 8.1, None, 0.9)))
    first, second = (json.loads(line) for line in (tmp_path / "events.jsonl").read_text().splitlines())
    assert (first["stage"], first["text"], first["step"]) == ("refitting the model", "", None)
    assert second["step"]["step"] == "prior"
    assert (second["step"]["fit"], second["step"]["validate"]) == (8.1, None)
    assert second["seconds"] >= first["seconds"] >= 0
