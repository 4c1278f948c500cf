"""Columns of a log that an analysis uses, and their specified noise."""

from __future__ import annotations

from pysim.types import BadInput, Dataset, MeasuredRecord


def the_column(dataset: Dataset, record: MeasuredRecord, role: str, name: str | None = None) -> str:
    """The column of a log over time that has the role "input" or "output".

    Args:
        name: name of the column; None takes the record's command for an input, or else the only column of that role.
    Raises:
        BadInput: no such column, or several without a name.
    """
    there = dataset.columns(record, role)
    wanted = name or (record.command if role == "input" else "")
    if wanted in there:
        return wanted
    if wanted or len(there) != 1:
        what = f"no {role} {wanted!r}" if wanted else f"{len(there)} signals of role {role}"
        raise BadInput(f"{record.source}: {what}; name one of {', '.join(there) or 'its signals'}")
    return there[0]


def declared_noise(dataset: Dataset, name: str) -> float | None:
    """Standard deviation of a signal's samples as the data set specifies it, with quantisation; None if it does not.

    Raises:
        BadInput: the specified noise is zero.
    """
    signal = dataset.signal(name)
    if signal.noise is None:
        return None
    if not signal.deviation > 0:
        raise BadInput(f"signal {name!r}: a noise of {signal.noise:g} gives no weight; leave it out or correct it")
    return signal.deviation
