"""Only what an earlier run has left, and nobody has changed or reads, goes."""

from pathlib import Path

import pytest

from pysim.cli._earlier import LIST, remember, remove_earlier


def written(folder: Path, *names: str) -> list[Path]:
    """Files of a run."""
    folder.mkdir(exist_ok=True)
    for name in names:
        (folder / name).write_text(f"our {name}")
    return [folder / name for name in names]


def left(folder: Path) -> set[str]:
    return {path.name for path in folder.iterdir()}


def test_what_was_listed_goes_and_what_is_not_ours_stays(tmp_path: Path) -> None:
    out = tmp_path / "out"
    remember(out, written(out, "report.html", "record_1.png"))
    remember(out, written(out, "PumpWithStop.mo"))
    (out / "mine.png").write_text("mine")
    (out / "journal.jsonl").write_text("to go on from")
    remove_earlier(out)
    assert left(out) == {"mine.png", "journal.jsonl"}


def test_what_was_changed_since_stays(tmp_path: Path) -> None:
    remember(tmp_path, written(tmp_path, "parameters.toml", "ledger.png"))
    (tmp_path / "parameters.toml").write_text("mine now")
    (tmp_path / "ledger.png").unlink()
    remove_earlier(tmp_path)
    assert left(tmp_path) == {"parameters.toml"}


@pytest.mark.parametrize("read", ["PumpWithStop.mo", "."])
def test_what_is_read_stays_also_the_next_time(tmp_path: Path, read: str) -> None:
    remember(tmp_path, written(tmp_path, "PumpWithStop.mo", "ledger.png"))
    remove_earlier(tmp_path, read=[tmp_path / read])
    remember(tmp_path, written(tmp_path, "report.html"))
    remove_earlier(tmp_path)
    assert left(tmp_path) == {"PumpWithStop.mo"}


def test_a_file_that_was_written_twice_is_known_as_it_was_last(tmp_path: Path) -> None:
    remember(tmp_path, written(tmp_path, "ledger.png"))
    (tmp_path / "ledger.png").write_text("drawn again")
    remember(tmp_path, [tmp_path / "ledger.png"])
    remove_earlier(tmp_path)
    assert left(tmp_path) == set()


@pytest.mark.parametrize("name", ["../mine.txt", "{}/mine.txt", "..", ""])
def test_a_list_reaches_no_other_folder(tmp_path: Path, name: str) -> None:
    from hashlib import sha256

    (tmp_path / "mine.txt").write_text("mine")
    out = tmp_path / "out"
    out.mkdir()
    (out / LIST).write_text(f"{sha256(b'mine').hexdigest()}  {name.format(tmp_path)}\ncut")
    remove_earlier(out)
    assert left(tmp_path) == {"mine.txt", "out"}
    assert left(out) == set()
