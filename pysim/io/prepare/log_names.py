"""How the logs of a data set are called: by their file, by its name alone, and by that of a log they are part of."""

from __future__ import annotations

from pathlib import PurePosixPath

from pysim.types import BadInput, Dataset, MeasuredRecord

PART = "~"  # between the name of a log and that of a part of it


def short_name(dataset: Dataset, record: MeasuredRecord) -> str:
    """The name of its file without folder and suffix where no other log has that, else with them."""
    stem = _stem(record.source)
    return stem if sum(_stem(other.source) == stem for other in dataset.records) == 1 else record.source


def logs_called(dataset: Dataset, name: str) -> tuple[MeasuredRecord, ...]:
    """The log of that name, or all parts of one that a step has cut.

    Args:
        name: the file as the data set calls it, or its name without folder and suffix.
    Raises:
        BadInput: there is none, or several files of different folders have that name.
    """
    exact = [record for record in dataset.records if record.source == name]
    found = exact or [record for record in dataset.records if _stem(record.source) == name]
    if len(found) > 1 and len({record.source for record in found}) > 1:
        raise BadInput(f"two logs are called {name!r}; name one of {', '.join(r.source for r in found)}")
    parts = [r for r in dataset.records if _stem(r.source).startswith(f"{_stem(str(name))}{PART}")]
    if not (found or parts):
        names = ", ".join(short_name(dataset, record) for record in dataset.records)
        raise BadInput(f"there is no log {name!r}; name one of {names}")
    return tuple(found or parts)


def part_of(source: str, part: str) -> str:
    """The name of a part of a log: run3.csv, 2 -> run3~2.csv."""
    path = PurePosixPath(source)
    return path.with_name(f"{_stem(source)}{PART}{part}{path.suffix}").as_posix()


def _stem(source: str) -> str:
    return PurePosixPath(source).stem
