"""What a step of the preparation is, and how steps are applied, one after the other."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping
from dataclasses import MISSING, fields, replace
from typing import ClassVar, Protocol

import numpy as np
from numpy.typing import NDArray

from pysim.io.counted import counted
from pysim.io.prepare.log_names import logs_called, part_of, short_name
from pysim.types import BadInput, Dataset, MeasuredRecord, Record, sampling
from pysim.types.record_kind import KINDS, Command

Array = NDArray[np.float64]

_GAP = 1.5  # sampling intervals: a longer one lacks samples; as in `sampling`


class Step(Protocol):
    """One step, a frozen dataclass of numbers and names."""

    word: ClassVar[str]  # in dataset.toml, and of the method of Data
    star: ClassVar[str]  # the field whose names are given one by one; empty where there is none

    def apply(self, dataset: Dataset) -> Dataset:
        """The data set after it; what it was given stays as it is.

        Raises:
            BadInput: a log or signal that is not there, or one that this step cannot be done with.
        """
        ...


def prepared(dataset: Dataset, steps: Iterable[Step]) -> Dataset:
    """A data set after all steps, in order.

    Raises:
        BadInput: a step that cannot be done, and which one.
    """
    for number, step in enumerate(steps, 1):
        try:
            dataset = step.apply(dataset)
        except BadInput as error:
            raise BadInput(f"preparation, step {number}, {call(step)}: {error}") from error
    return dataset


def call(step: Step) -> str:
    """A step as it is typed in Python: `trim(start=0.5)`, `flip("x")`."""
    words: list[str] = []
    named = not (step.star and getattr(step, step.star))  # names one by one stand behind all that is ahead of them
    for field in fields(step):  # type: ignore[arg-type]
        value = getattr(step, field.name)
        if field.name == step.star:
            words += [_typed(name) for name in value]
            named = True
        elif field.default is MISSING or not named:
            words.append(_typed(value))
        elif value != field.default:
            words.append(f"{field.name}={_typed(value)}")
    return f"{step.word}({', '.join(words)})"


def _typed(value: object) -> str:
    if isinstance(value, str):
        return f'"{value}"'
    if isinstance(value, Mapping):
        return "{" + ", ".join(f"{_typed(key)}: {_typed(own)}" for key, own in value.items()) + "}"
    if isinstance(value, tuple):
        return f"[{', '.join(map(_typed, value))}]"
    return f"{value:.10g}" if isinstance(value, float) else repr(value)


def each_log(
    dataset: Dataset, change: Callable[[MeasuredRecord, Record], Iterable[MeasuredRecord]], names: Iterable[str] = ()
) -> Dataset:
    """A data set whose logs over time become others; tables of responses stay.

    Args:
        change: of a log and its samples, to none, one or several.
        names: of the logs to change; all where there are none.
    Raises:
        BadInput: none is left.
    """
    chosen = {id(record) for name in names for record in logs_called(dataset, name)}
    records: list[MeasuredRecord] = []
    for record in dataset.records:
        if isinstance(record.data, Record) and (not chosen or id(record) in chosen):
            records += change(record, record.data)
        else:
            records.append(record)
    if not records:
        raise BadInput("no log is left; leave out less")
    return replace(dataset, records=tuple(records))


def rows(record: MeasuredRecord, log: Record, first: int, stop: int, part: str = "") -> MeasuredRecord:
    """The rows of a log from `first` to ahead of `stop`, as a log of its own.

    Where it begins later, what was said of the plant's state at the old first row holds no longer.

    Args:
        part: what its name gets; it keeps the name where empty.
    """
    if stop - first < 2:
        raise BadInput(f"{record.source}: {max(stop - first, 0)} samples would be left; leave out less")
    if (first, stop) == (0, log.time.size) and not part:
        return record
    data = replace(log, time=log.time[first:stop], values=log.values[first:stop])
    begin = None if record.begin is None else record.begin + float(log.time[first] - log.time[0])
    initial = record.initial if first == 0 else None
    source = part_of(record.source, part) if part else record.source
    return replace(record, source=source, data=data, begin=begin, initial=initial)


def with_columns(record: MeasuredRecord, log: Record, columns: Mapping[str, Array]) -> MeasuredRecord:
    """A log with other numbers in some columns."""
    values = log.values.copy()
    for name, column in columns.items():
        values[:, log.names.index(name)] = column
    return replace(record, data=replace(log, values=values))


def signals_of(dataset: Dataset, names: tuple[str, ...], *, role: str = "") -> tuple[str, ...]:
    """The named signals; all of that role (or of any) where none is named.

    Raises:
        BadInput: one is not there.
    """
    for name in names:
        dataset.signal(name)
    return names or tuple(signal.name for signal in dataset.signals if role in ("", signal.role))


def stands(dataset: Dataset, record: MeasuredRecord, name: str) -> bool:
    """Whether a signal stands between its samples, as a switched command does."""
    signal = dataset.signal(name)
    how = KINDS[record.kind].command if signal.hold is None else signal.hold
    return signal.role == "input" and how is Command.STEPS


def refuse_tables(dataset: Dataset, word: str) -> None:
    """Steps on samples leave tables of responses alone, which would then no longer agree with the logs."""
    if dataset.responses():
        raise BadInput(f"{word} is for logs, and this data set holds tables of responses; correct those by hand")


def even_step(dataset: Dataset, record: MeasuredRecord, log: Record) -> float:
    """The sampling interval in s of a log that lacks no samples.

    Raises:
        BadInput: it has gaps.
    """
    refuse_missing_in(dataset, record, log)
    found = sampling(log.time)
    if found.gaps.size:
        length = float(np.diff(log.time)[found.gaps].max())
        at = float(log.time[found.gaps[0]])
        raise BadInput(
            f"{record.source} lacks samples after {at:.6g} s; fill or cut them first: "
            f"data.fill_gaps({_up(length):g}), or less to cut there"
        )
    return found.step


def refuse_missing_in(dataset: Dataset, record: MeasuredRecord, log: Record) -> None:
    """A log whose cells are all there.

    Raises:
        BadInput: one is empty, with its place and what fills it.
    """
    missing = ~np.isfinite(log.values)
    if missing.any():
        row, column = (int(index[0]) for index in np.nonzero(missing))
        count = int(missing[:, column].sum())
        longest = _up(_GAP * _longest(log.time, missing[:, column]))
        raise BadInput(
            f"{short_name(dataset, record)}: {log.names[column]} lacks {counted(count, 'sample')}, the first at "
            f"{log.time[row]:.6g} s; data = data.fill_gaps({longest:g}) fills them, a smaller number cuts there"
        )


def refuse_missing_samples(dataset: Dataset) -> None:
    """A data set without empty cells; nothing can be fitted to those.

    Raises:
        BadInput: a log has one, with its place and what fills it.
    """
    for record in dataset.logs():
        if isinstance(record.data, Record):
            refuse_missing_in(dataset, record, record.data)


def _longest(time: Array, missing: NDArray[np.bool_]) -> float:
    """s from the last sample ahead to the first one behind the longest run that is missing."""
    edges = np.flatnonzero(np.diff(np.concatenate([[False], missing, [False]]).astype(np.int8)))
    first, last = np.maximum(edges[::2] - 1, 0), np.minimum(edges[1::2], time.size - 1)
    return float((time[last] - time[first]).max())


def _up(value: float) -> float:
    """Rounded up to two digits."""
    digit = 10.0 ** (math.floor(math.log10(value)) - 1)
    return float(f"{math.ceil(value / digit - 1e-9) * digit:.6g}")
