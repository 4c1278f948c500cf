"""Which columns of a log an analysis takes, and how noisy they are said to be."""

from __future__ import annotations

from pysim.types import BadInput, Dataset, MeasuredRecord


def the_column(dataset: Dataset, record: MeasuredRecord, role: str, name: str | None = None) -> str:
    """The column of a log over time that has the role "input" or "output".

    Args:
        name: the one wanted; else, of inputs, the one that the record's numbers speak of, and the only one.
    Raises:
        BadInput: no such column, or several to choose from.
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
    """Standard deviation of a signal's samples as the data set declares it, rounding included; None without.

    Raises:
        BadInput: it is said to be zero.
    """
    signal = dataset.signal(name)
    if signal.noise is None:
        return None
    if not signal.deviation > 0:
        raise BadInput(f"signal {name!r}: a noise of {signal.noise:g} gives no weight; leave it out or correct it")
    return signal.deviation
