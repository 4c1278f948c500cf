"""What a step of the preparation is, and how steps are applied, one after the other."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import MISSING, fields, replace
from pathlib import PurePosixPath
from typing import Any, ClassVar, Protocol

import numpy as np
from numpy.typing import NDArray

from pysim.io.prepare.log_names import logs_called, part_of, whole_log
from pysim.types import BadInput, Dataset, MeasuredRecord, Record
from pysim.types.record_kind import KINDS, Command

Array = NDArray[np.float64]


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


def renamed_logs(step: Step, called: Mapping[str, str]) -> Step:
    """The step for logs whose files have other names.

    Args:
        called: file -> its other name; a part of a log takes the folder and the suffix of that.
    """
    changed: dict[str, Any] = {}
    for field in ("log", "logs"):
        given = getattr(step, field, None)
        if given:
            names = (given,) if isinstance(given, str) else given
            new = tuple(_renamed(name, called) for name in names)
            changed[field] = new[0] if isinstance(given, str) else new
    return replace(step, **changed) if changed else step  # type: ignore[type-var]


def _renamed(name: str, called: Mapping[str, str]) -> str:
    whole = whole_log(name)
    if name in called or whole not in called:
        return called.get(name, name)
    new = PurePosixPath(called[whole])
    return new.with_name(PurePosixPath(name).stem + new.suffix).as_posix()
