"""What the server gives beside the page."""

from pathlib import Path
from types import SimpleNamespace
from typing import Any

from pysim.app.answers import Answer
from pysim.app.jobs import DONE, Job, Work
from pysim.app.server import overlay_of
from pysim.io import read_stages, write_stages
from pysim.report.diagnosis import diagnosis_data
from tests.pysim.diagnosis_story import dataset, story

_WAVE = 2  # number of the log wave.txt in the data set


def test_a_record_whose_result_was_removed_meanwhile_is_none(tmp_path: Path) -> None:
    write_stages(tmp_path / "a.npz", story().stages)
    job = Job(Work("diagnose", "Find", ("diagnose",)), DONE, 1.0, 2.0, "")
    answer = Answer(job, tmp_path, diagnosis_data(story()), read_stages(tmp_path / "a.npz"))
    check, answers = SimpleNamespace(dataset=dataset()), SimpleNamespace(all=(answer,))
    desk: Any = SimpleNamespace(loaded=SimpleNamespace(check=check), answers=answers)
    overlay = overlay_of(desk, "diagnose", _WAVE)
    assert overlay is not None
    assert overlay.names == ("x",)
    (tmp_path / "a.npz").unlink()
    assert overlay_of(desk, "diagnose", _WAVE) is None
