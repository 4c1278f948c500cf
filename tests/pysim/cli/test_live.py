"""What a diagnosis shows on the terminal while it works."""

import io
import json
import re
import sys
from pathlib import Path

import pytest

from pysim.cli.live import EventFile, Live, block
from pysim.types import ProgressEvent
from tests.pysim.diagnosis_answer import found_offset, step


def test_without_a_terminal_there_is_a_line_for_each_event(capsys: pytest.CaptureFixture[str]) -> None:
    with Live("toy") as show:
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
    assert bars[0].endswith("held out    8.00")
    assert learned == "  - found"


def test_before_anything_is_known_there_is_the_stage_alone() -> None:
    assert block("toy", "comparing the model as it is", 30.0, [], []) == ["toy", "  0:30  comparing the model as it is"]


class Terminal(io.StringIO):
    def isatty(self) -> bool:
        return True


def test_on_a_terminal_the_block_is_drawn_over_and_stays(monkeypatch: pytest.MonkeyPatch) -> None:
    screen = Terminal()
    monkeypatch.setattr(sys, "stderr", screen)
    with Live("toy") as show:
        show(ProgressEvent("refitting"))
        show(ProgressEvent("refitting", "prior: 8.1", step("prior", 8.1, 8.0, 0.9)))
        show(ProgressEvent("screening", "three promise something"))
    drawn = screen.getvalue()
    assert "\x1b[2A" in drawn  # the first drawing had two lines
    last = re.split(r"\x1b\[\d+A", drawn)[-1].replace("\r\x1b[K", "").splitlines()
    assert [line.split()[0] for line in last] == ["toy", "0:00", "residual", "as", "-"]
    assert last[1].endswith("done")


def test_what_went_wrong_ends_it_as_stopped(monkeypatch: pytest.MonkeyPatch) -> None:
    screen = Terminal()
    monkeypatch.setattr(sys, "stderr", screen)
    with pytest.raises(ZeroDivisionError), Live("toy") as show:
        show(ProgressEvent(f"refitting {1 / 0}"))
    assert screen.getvalue().rstrip().endswith("stopped")


def test_events_in_a_file_can_be_followed_by_a_program(tmp_path: Path) -> None:
    tell = EventFile(tmp_path / "events.jsonl")
    tell(ProgressEvent("refitting the model"))
    tell(ProgressEvent("refitting the model", "prior: 8.1", step("prior", 8.1, None, 0.9)))
    first, second = (json.loads(line) for line in (tmp_path / "events.jsonl").read_text().splitlines())
    assert (first["stage"], first["text"], first["step"]) == ("refitting the model", "", None)
    assert second["step"]["step"] == "prior"
    assert (second["step"]["fit"], second["step"]["validate"]) == (8.1, None)
    assert second["seconds"] >= first["seconds"] >= 0
