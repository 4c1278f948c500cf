"""Which log of a data set each compared record is: its file alone does not tell, since it may hold several."""

from __future__ import annotations

import math
from collections.abc import Collection, Iterator, Mapping, Sequence
from typing import Any, NamedTuple, TypeAlias

from pysim.types import Dataset, MeasuredRecord, Record, RecordFit

_Key: TypeAlias = tuple[str, str, str, tuple[str, ...]]  # file, kind, use, signals that are compared

_CLOSE = 1e-9  # of a frequency, which a comparison has by way of rad/s


class ComparedLog(NamedTuple):
    """What a comparison of a model with a log tells of that log.

    Args:
        source, kind, use: of the log.
        names: signals that are compared.
        frequency: Hz, of a stepped sine that had settled; None for all else.
    """

    source: str
    kind: str
    use: str
    names: tuple[str, ...]
    frequency: float | None

    @classmethod
    def of(cls, fit: RecordFit) -> ComparedLog:
        """What a record of a fit or a diagnosis tells."""
        frequency = fit.harmonics[0].frequency if fit.harmonics else None
        return cls(fit.source, fit.kind, fit.use, fit.measured.names, frequency)


def log_numbers(records: Sequence[ComparedLog], dataset: Dataset) -> tuple[int | None, ...]:
    """Per record its number among the data set's logs; None where nothing tells it from another one.

    Args:
        records: all that were compared with one model, in that order.
        dataset: that they were made of.
    """
    compared = {name for record in records for name in record.names}
    logs = dataset.logs()
    waiting: dict[_Key, list[int]] = {}
    for number in _in_order([_test(log, number, compared) for number, log in enumerate(logs)]):
        log = logs[number]
        waiting.setdefault((log.source, log.kind, log.use, _names(log, compared)), []).append(number)
    groups: dict[_Key, list[int]] = {}
    for place, record in enumerate(records):
        groups.setdefault((record.source, record.kind, record.use, record.names), []).append(place)
    found: dict[int, int] = {}
    for key, places in groups.items():
        told = {place: records[place].frequency for place in places}
        found.update(_pairs(told, {k: logs[k].frequency for k in waiting.get(key, [])}))
    return tuple(found.get(place) for place in range(len(records)))


def _in_order(tests: Sequence[tuple[Any, ...]]) -> list[int]:
    """Numbers of the logs as a comparison orders those of one file: sines are where their test begins."""
    begun: dict[tuple[Any, ...], int] = {}
    for number, test in enumerate(tests):
        begun.setdefault(test, number)
    return sorted(range(len(tests)), key=lambda number: (begun[tests[number]], number))


def _test(log: MeasuredRecord, number: int, compared: Collection[str]) -> tuple[Any, ...]:
    """What the stepped sines of one test have in common; any other log is one by itself."""
    if log.frequency is None:
        return (number,)
    return log.use, log.offset, log.amplitude, *(_names(log, compared, inside) for inside in (False, True))


def _names(log: MeasuredRecord, compared: Collection[str], inside: bool = True) -> tuple[str, ...]:
    """Signals of a log that are compared, or those that are not."""
    names = log.data.names if isinstance(log.data, Record) else ()
    return tuple(name for name in names if (name in compared) is inside)


def _pairs(told: Mapping[int, float | None], logs: Mapping[int, float | None]) -> Iterator[tuple[int, int]]:
    """Records and logs that belong together, each with its frequency; only as many as leave no doubt.

    A stepped sine that had not settled is compared as any log, and its frequency is not told.
    """
    left = dict(logs)
    for frequency in dict.fromkeys(f for f in told.values() if f is not None):
        places = [place for place, f in told.items() if f == frequency]
        same = [k for k, f in left.items() if f is not None and math.isclose(f, frequency, rel_tol=_CLOSE)]
        if len(same) == len(places):
            yield from zip(places, same, strict=True)
            left = {k: f for k, f in left.items() if k not in same}
    others = [place for place, f in told.items() if f is None]
    if len(others) == len(left):
        yield from zip(others, left, strict=True)
