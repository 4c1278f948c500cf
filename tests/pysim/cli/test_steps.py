"""What a diagnosis tells a program that follows it."""

import json
from pathlib import Path

from pysim.cli.steps import EventFile
from pysim.types import ProgressEvent
from tests.pysim.diagnosis_answer import step


def test_events_in_a_file_can_be_followed_by_a_program(tmp_path: Path) -> None:
    tell = EventFile(tmp_path / "events.jsonl")
    tell(ProgressEvent("refitting the model"))
    tell(ProgressEvent("refitting the model", "prior: 8.1", step("prior", 8.1, None, 0.9)))
    first, second = (json.loads(line) for line in (tmp_path / "events.jsonl").read_text().splitlines())
    assert (first["stage"], first["text"], first["step"]) == ("refitting the model", "", None)
    assert second["step"]["step"] == "prior"
    assert (second["step"]["fit"], second["step"]["validate"]) == (8.1, None)
    assert second["seconds"] >= first["seconds"] >= 0
