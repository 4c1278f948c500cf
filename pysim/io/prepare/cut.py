"""Which rows of which logs count, and what they are for."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import ClassVar

import numpy as np

from pysim.io.prepare.log_names import logs_called
from pysim.io.prepare.step import each_log, rows
from pysim.types import BadInput, Dataset, MeasuredRecord, Record

_TEST = "test"


@dataclass(frozen=True)
class Trim:
    """Leave out what is ahead of a time and behind another one.

    Args:
        start, stop: s, on the clock of the log; all from its start, or to its end, where None.
        logs: names of those to trim; all where there are none.
    """

    word: ClassVar[str] = "trim"
    star: ClassVar[str] = ""
    start: float | None = None
    stop: float | None = None
    logs: tuple[str, ...] = ()

    def apply(self, dataset: Dataset) -> Dataset:
        def change(record: MeasuredRecord, log: Record) -> Iterator[MeasuredRecord]:
            first = 0 if self.start is None else int(np.searchsorted(log.time, self.start))
            stop = log.time.size if self.stop is None else int(np.searchsorted(log.time, self.stop, "right"))
            yield rows(record, log, first, stop)

        return each_log(dataset, change, self.logs)


@dataclass(frozen=True)
class Exclude:
    """Leave a stretch out of a log, which becomes two, or all of it.

    Args:
        log: its name.
        start, stop: s, on the clock of the log; from its start, or to its end, where None.
    """

    word: ClassVar[str] = "exclude"
    star: ClassVar[str] = ""
    log: str
    start: float | None = None
    stop: float | None = None

    def apply(self, dataset: Dataset) -> Dataset:
        def change(record: MeasuredRecord, log: Record) -> Iterator[MeasuredRecord]:
            first = 0 if self.start is None else int(np.searchsorted(log.time, self.start))
            behind = log.time.size if self.stop is None else int(np.searchsorted(log.time, self.stop, "right"))
            if first == behind:  # no row of this part
                yield record
                return
            kept = [(a, b) for a, b in ((0, first), (behind, log.time.size)) if b - a >= 2]
            yield from pieces(record, log, kept)

        return each_log(dataset, change, (self.log,))


def pieces(record: MeasuredRecord, log: Record, kept: list[tuple[int, int]]) -> Iterator[MeasuredRecord]:
    """Rows (first, stop) of a log as logs of their own, which keep its name where there is one alone.

    All but the first begin in the middle of something, so that their initial states are not known.
    """
    for number, (first, stop) in enumerate(kept, 1):
        piece = rows(record, log, first, stop, str(number) if len(kept) > 1 else "")
        yield replace(piece, initial="estimate") if first else piece


@dataclass(frozen=True)
class HoldOut:
    """Keep logs to report the error on: nothing is fitted to them, and nothing is chosen with them.

    Args:
        logs: their names.
    """

    word: ClassVar[str] = "hold_out"
    star: ClassVar[str] = "logs"
    logs: tuple[str, ...]

    def apply(self, dataset: Dataset) -> Dataset:
        chosen = {id(record) for name in self.logs for record in logs_called(dataset, name)}
        records = tuple(replace(r, use=_TEST) if id(r) in chosen else r for r in dataset.records)
        return replace(dataset, records=records)


@dataclass(frozen=True)
class Split:
    """Cut every log that is to be fitted in two, and hold out the second part.

    Args:
        share: of a log's rows that are fitted, between 0 and 1.
    """

    word: ClassVar[str] = "split"
    star: ClassVar[str] = ""
    share: float

    def apply(self, dataset: Dataset) -> Dataset:
        if not 0 < self.share < 1:
            raise BadInput(f"the share is {self.share:g}; give the part that is fitted, between 0 and 1")

        def change(record: MeasuredRecord, log: Record) -> Iterator[MeasuredRecord]:
            if record.held_out:
                yield record
                return
            edge = round(self.share * log.time.size)
            yield rows(record, log, 0, edge, "fit")
            yield replace(rows(record, log, edge, log.time.size, _TEST), use=_TEST, initial="estimate")

        return each_log(dataset, change)
