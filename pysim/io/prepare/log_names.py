"""How the logs of a data set are called: by their file, by its name alone, and by that of a log they are part of."""

from __future__ import annotations

from collections.abc import Callable
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
    # The file itself, its name alone, the file that it is a part of, and that one's name.
    ways: tuple[Callable[[str], str], ...] = (str, _stem, whole_log, lambda source: _stem(whole_log(source)))
    for way in ways:
        found = tuple(record for record in dataset.records if way(record.source) == name)
        files = dict.fromkeys(whole_log(record.source) for record in found)
        if len(files) > 1:
            raise BadInput(f"two logs are called {name!r}; name one of {', '.join(files)}")
        if found:
            return found
    names = ", ".join(short_name(dataset, record) for record in dataset.records)
    raise BadInput(f"there is no log {name!r}; name one of {names}")


def part_of(source: str, part: str) -> str:
    """The name of a part of a log: run3.csv, 2 -> run3~2.csv."""
    path = PurePosixPath(source)
    return path.with_name(f"{_stem(source)}{PART}{part}{path.suffix}").as_posix()


def whole_log(source: str) -> str:
    """The log that a part is of: a/run3~2~fit.csv -> a/run3.csv."""
    path = PurePosixPath(source)
    return path.with_name(f"{path.stem.partition(PART)[0]}{path.suffix}").as_posix()


def _stem(source: str) -> str:
    return PurePosixPath(source).stem
