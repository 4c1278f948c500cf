"""`--output` takes a folder that is new, empty, or an earlier answer of ours; nothing else of it is ever touched."""

from collections.abc import Sequence
from pathlib import Path

import pytest

from pysim.cli.outputs import answer_folder, prepare_answer
from pysim.present.report import MARKER
from pysim.types import BadInput


def answer(folder: Path, *names: str, beside: Sequence[Path] = (), read: Sequence[Path] = ()) -> None:
    """An answer of these files."""
    prepare_answer(folder, data=[], read=read, beside=beside, goes_on=("checkpoint.jsonl", "log"))
    with answer_folder(folder, beside=beside) as new:
        for name in names:
            (new / name).write_text(f"our {name}")


def left(folder: Path) -> set[str]:
    return {path.relative_to(folder).as_posix() for path in folder.rglob("*")}


@pytest.mark.parametrize("there", [False, True])
def test_a_new_or_an_empty_folder_is_taken(tmp_path: Path, there: bool) -> None:
    out = tmp_path / "deep" / "out"
    if there:
        out.mkdir(parents=True)
    answer(out, "report.html", "missing_1.png")
    assert left(out) == {"report.html", "missing_1.png", MARKER}


def test_an_earlier_answer_is_replaced_as_a_whole(tmp_path: Path) -> None:
    answer(tmp_path, "report.html", "missing_1.png")
    (tmp_path / "report.html").write_text("edited")
    answer(tmp_path, "report.html", "MassWithStop.mo")
    assert left(tmp_path) == {"report.html", "MassWithStop.mo", MARKER}
    assert (tmp_path / "report.html").read_text() == "our report.html"


def test_what_the_system_leaves_in_a_folder_stays_and_is_nobodys(tmp_path: Path) -> None:
    answer(tmp_path, "report.html")
    (tmp_path / ".DS_Store").write_text("of the Finder")
    answer(tmp_path, "other.html")
    assert left(tmp_path) == {"other.html", ".DS_Store", MARKER}


@pytest.mark.parametrize("name", ["mine.png", "sub/mine.png", "log/mine.txt"])
@pytest.mark.parametrize("ours", [(), ("report.html",)])
def test_a_folder_with_a_file_of_somebody_elses_is_refused_and_left_alone(
    tmp_path: Path, name: str, ours: tuple[str, ...]
) -> None:
    if ours:
        answer(tmp_path, *ours)
    (tmp_path / name).parent.mkdir(exist_ok=True)
    (tmp_path / name).write_text("mine")
    before = left(tmp_path)
    with pytest.raises(BadInput, match=f"--output .*{name} is there, .* choose a new folder"):
        answer(tmp_path, "next.html")
    assert left(tmp_path) == before
    assert (tmp_path / name).read_text() == "mine"


def test_what_comes_in_while_it_is_written_stays(tmp_path: Path) -> None:
    answer(tmp_path, "report.html")
    with answer_folder(tmp_path) as new:
        (tmp_path / "mine.png").write_text("mine")
        (new / "parameters.toml").write_text("")
    assert left(tmp_path) == {"mine.png", "parameters.toml", MARKER}


def test_an_answer_that_is_not_finished_changes_nothing(tmp_path: Path) -> None:
    answer(tmp_path, "report.html")

    def fail() -> None:
        with answer_folder(tmp_path) as new:
            (new / "report.html").write_text("half")
            raise RuntimeError

    with pytest.raises(RuntimeError):
        fail()
    assert left(tmp_path) == {"report.html", MARKER}
    assert (tmp_path / "report.html").read_text() == "our report.html"


def test_what_a_killed_run_left_is_gone_on_with_or_replaced(tmp_path: Path) -> None:
    for name in ("checkpoint.jsonl", "log/given/state.npz", ".pysim-new/report.html"):
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text("half")
    answer(tmp_path, "report.html", beside=[tmp_path / "log"])
    unfinished = {"checkpoint.jsonl", "log", "log/given", "log/given/state.npz"}
    assert left(tmp_path) == {*unfinished, "report.html", MARKER}
    answer(tmp_path, "other.html")  # the log was part of the earlier answer
    assert left(tmp_path) == {"checkpoint.jsonl", "other.html", MARKER}


@pytest.mark.parametrize(
    ("begun", "goes_on"), [("checkpoint.jsonl", "log"), ("log/given/state.npz", "checkpoint.jsonl")]
)
def test_what_another_command_would_go_on_from_is_refused(tmp_path: Path, begun: str, goes_on: str) -> None:
    (tmp_path / begun).parent.mkdir(parents=True, exist_ok=True)
    (tmp_path / begun).write_text("half")
    for names in ((), (goes_on,)):
        with pytest.raises(BadInput, match="is of another command that was stopped; choose a new folder"):
            prepare_answer(tmp_path, data=[], read=[], beside=[], goes_on=names)
    prepare_answer(tmp_path, data=[], read=[], beside=[], goes_on=(begun.partition("/")[0],))


def test_other_results_of_the_run_may_lie_in_the_folder(tmp_path: Path) -> None:
    numbers = tmp_path / "a.json"
    numbers.write_text("of the last run")
    answer(tmp_path, "report.html", beside=[numbers, tmp_path.parent / "elsewhere.npz"])
    numbers.write_text("{}")
    answer(tmp_path, "other.html")
    assert left(tmp_path) == {"other.html", MARKER}


def test_what_is_read_is_not_replaced(tmp_path: Path) -> None:
    answer(tmp_path, "parameters.toml")
    with pytest.raises(BadInput, match=r"parameters.toml is read, .* choose another folder"):
        answer(tmp_path, "report.html", read=[Path("No.Such.File"), tmp_path / "parameters.toml"])
    assert left(tmp_path) == {"parameters.toml", MARKER}


@pytest.mark.parametrize("name", ["../mine.txt", "{}/mine.txt", "..", ""])
def test_a_marker_reaches_no_other_folder(tmp_path: Path, name: str) -> None:
    (tmp_path / "mine.txt").write_text("mine")
    out = tmp_path / "out"
    out.mkdir()
    (out / MARKER).write_text(name.format(tmp_path))
    answer(out, "report.html")
    assert left(tmp_path) == {"mine.txt", "out", f"out/{MARKER}", "out/report.html"}
