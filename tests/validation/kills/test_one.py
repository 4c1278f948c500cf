"""Kills: work that had ended is not counted, a half-written answer is seen, and another result is no success."""

from collections.abc import Callable, Mapping
from pathlib import Path

import pytest

from validation.kills import one
from validation.kills.subjects import SUBJECTS, Subject


def work(code: str) -> Subject:
    """A few lines of Python in place of a command; its result is what it has written into a file."""
    return Subject(
        ("timeit", "-n", "1", "-r", "1", code),
        lambda folder: None,
        lambda folder: (folder / "answer.json").read_text(),
        SUBJECTS["fit"].spoiled,
    )


SLOW = "import time; time.sleep(60)"
GOES_ON = """
import time, pathlib
begun, answer = pathlib.Path('begun'), pathlib.Path('answer.json')
again = begun.exists()
begun.touch()
time.sleep(0.5)
answer.write_text('{"after a kill": true}' if again and %s else '{}')
"""


def test_work_that_runs_is_killed_and_work_that_has_ended_is_not(tmp_path: Path) -> None:
    assert one.killed(work(SLOW), tmp_path, 0.3, child=False)
    assert not one.killed(work("pass"), tmp_path, 30.0, child=False)


@pytest.mark.parametrize(("differs", "same"), [("False", True), ("True", False)])
def test_a_result_that_differs_after_a_kill_is_seen(differs: str, same: bool, monkeypatch: pytest.MonkeyPatch) -> None:
    made: Mapping[str, Subject] = {"made": work(GOES_ON % differs)}
    monkeypatch.setattr(one, "SUBJECTS", made)
    one.undisturbed.cache_clear()
    found = [one.answer(f"made-{seed}") for seed in (4, 5)]  # late moments: the first line has been run
    one.undisturbed.cache_clear()
    assert all(line["same"] for line in found) is same


@pytest.mark.parametrize(
    ("name", "file", "write"),
    [
        ("fit", "answer.json", lambda path: path.write_text('{"cost": 1')),
        ("build", "Mass.fmu", lambda path: path.write_bytes(b"PK\x03\x04")),
    ],
)
def test_what_is_half_written_is_seen(name: str, file: str, write: Callable[[Path], object], tmp_path: Path) -> None:
    assert SUBJECTS[name].spoiled(tmp_path) == ""
    write(tmp_path / file)
    assert "half written" in SUBJECTS[name].spoiled(tmp_path)
