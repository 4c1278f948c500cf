"""Only what an earlier run has left, and nobody has changed or reads, goes."""

from collections.abc import Sequence
from pathlib import Path

import pytest

from pysim.cli._earlier import LIST, in_place_of_earlier, remember


def written(folder: Path, *names: str) -> list[Path]:
    """Files of a run."""
    folder.mkdir(exist_ok=True)
    for name in names:
        (folder / name).write_text(f"our {name}")
    return [folder / name for name in names]


def answer_anew(folder: Path, *names: str, read: Sequence[Path] = ()) -> None:
    """An answer of these files, in place of the one before."""
    with in_place_of_earlier(folder, read=read):
        for name in names:
            (folder / name).write_text(f"our next {name}")
        if names:
            remember(folder, [folder / name for name in names])


def left(folder: Path) -> set[str]:
    return {path.name for path in folder.iterdir()}


def test_what_was_listed_goes_and_what_is_not_ours_stays(tmp_path: Path) -> None:
    out = tmp_path / "out"
    remember(out, written(out, "report.html", "record_1.png"))
    remember(out, written(out, "PumpWithStop.mo"))
    (out / "mine.png").write_text("mine")
    (out / "journal.jsonl").write_text("to go on from")
    answer_anew(out)
    assert left(out) == {"mine.png", "journal.jsonl"}


def test_what_was_changed_since_stays(tmp_path: Path) -> None:
    remember(tmp_path, written(tmp_path, "parameters.toml", "ledger.png"))
    (tmp_path / "parameters.toml").write_text("mine now")
    (tmp_path / "ledger.png").unlink()
    answer_anew(tmp_path)
    assert left(tmp_path) == {"parameters.toml", LIST}


@pytest.mark.parametrize("answers", [["parameters.toml"], [None, "parameters.toml"]])
def test_what_was_changed_since_is_kept_under_another_name_where_an_answer_takes_its_own(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], answers: list[str | None]
) -> None:
    """The next answer, or one after it."""
    remember(tmp_path, written(tmp_path, "parameters.toml"))
    (tmp_path / "parameters.toml").write_text("mine now")
    (tmp_path / "parameters.toml.yours-1").write_text("mine before")
    for name in answers:
        answer_anew(tmp_path, *([name] if name else []))
    assert left(tmp_path) == {"parameters.toml", "parameters.toml.yours-1", "parameters.toml.yours-2", LIST}
    assert (tmp_path / "parameters.toml").read_text() == "our next parameters.toml"
    assert (tmp_path / "parameters.toml.yours-1").read_text() == "mine before"
    assert (tmp_path / "parameters.toml.yours-2").read_text() == "mine now"
    (said,) = capsys.readouterr().out.splitlines()
    assert said.startswith(f"Kept: your {tmp_path / 'parameters.toml'}, now parameters.toml.yours-2")
    answer_anew(tmp_path)
    assert left(tmp_path) == {"parameters.toml.yours-1", "parameters.toml.yours-2"}


@pytest.mark.parametrize("read", ["PumpWithStop.mo", "."])
def test_what_is_read_stays_also_the_next_time(tmp_path: Path, read: str) -> None:
    remember(tmp_path, written(tmp_path, "PumpWithStop.mo", "ledger.png"))
    answer_anew(tmp_path, "report.html", read=[tmp_path / read])
    answer_anew(tmp_path)
    assert left(tmp_path) == {"PumpWithStop.mo", LIST}
    answer_anew(tmp_path, "PumpWithStop.mo")
    assert (tmp_path / "PumpWithStop.mo.yours-1").read_text() == "our PumpWithStop.mo"


def test_what_is_read_and_written_anew_is_not_the_users(tmp_path: Path) -> None:
    """Where the folder of the results is that of the libraries too."""
    remember(tmp_path, written(tmp_path, "PumpWithStop.mo"))
    for _ in range(2):
        answer_anew(tmp_path, "PumpWithStop.mo", read=[tmp_path])
    assert left(tmp_path) == {"PumpWithStop.mo", LIST}
    answer_anew(tmp_path)
    assert left(tmp_path) == set()


def test_a_file_that_was_written_twice_is_known_as_it_was_last(tmp_path: Path) -> None:
    remember(tmp_path, written(tmp_path, "ledger.png"))
    (tmp_path / "ledger.png").write_text("drawn again")
    remember(tmp_path, [tmp_path / "ledger.png"])
    answer_anew(tmp_path)
    assert left(tmp_path) == set()


@pytest.mark.parametrize("name", ["../mine.txt", "{}/mine.txt", "..", ""])
def test_a_list_reaches_no_other_folder(tmp_path: Path, name: str) -> None:
    from hashlib import sha256

    (tmp_path / "mine.txt").write_text("mine")
    out = tmp_path / "out"
    out.mkdir()
    (out / LIST).write_text(f"{sha256(b'mine').hexdigest()}  {name.format(tmp_path)}\ncut")
    answer_anew(out)
    assert left(tmp_path) == {"mine.txt", "out"}
    assert left(out) == set()
