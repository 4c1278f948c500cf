"""Channels of a LabVIEW TDMS file, by name."""

from __future__ import annotations

import struct
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pysim.io.limits import LIMITS, ReadLimits
from pysim.io.named_columns import Numbers, Table, as_numbers, optional_package, refuse_many, refuse_missing
from pysim.types import BadInput

Array = NDArray[np.float64]
_TIME = "time"
# What the package raises over a file that is no TDMS, or a damaged one.
DAMAGED = (OSError, ValueError, KeyError, EOFError, NotImplementedError, struct.error)


def told_apart(channels: list[Any]) -> tuple[str, ...]:
    """Their names, with the group where one stands twice."""
    names = [channel.name for channel in channels]
    return tuple(c.name if names.count(c.name) == 1 else f"{c.group_name}/{c.name}" for c in channels)


def read_tdms(
    path: Path,
    names: tuple[str, ...],
    wanted_by: str,
    limits: ReadLimits = LIMITS,
    missing: frozenset[str] = frozenset(),
) -> Table:
    """The named channels: by the channel's own name, or "group/channel" where two groups have it.

    Waveforms carry no channel of times but a start and an increment; the column "time" then follows from those.

    Args:
        wanted_by: what named the file, for messages.
        missing: channels whose samples may be not-a-number.
        limits: what the file may announce, before its samples are read.
    Raises:
        BadInput: the package is missing, no TDMS file, a channel that is not there or holds no numbers, more of them
            than the limits, channels of different lengths, or no time.
    """
    tdms = optional_package("nptdms", f"{wanted_by}: {path} is a TDMS file", "npTDMS")
    try:
        with tdms.TdmsFile.open(path) as file:
            return _read(path, file, names, wanted_by, missing, limits)
    except DAMAGED as error:
        if isinstance(error, BadInput):
            raise
        raise BadInput(f"{wanted_by}: cannot read {path} as TDMS ({error}); correct the name or the file") from error


def _read(
    path: Path, file: Any, names: tuple[str, ...], wanted_by: str, missing: frozenset[str], limits: ReadLimits
) -> Table:
    channels = [channel for group in file.groups() for channel in group.channels()]
    if not channels:
        raise BadInput(f"{wanted_by}: cannot read {path} as TDMS (it has no channels); correct the name or the file")
    present = [channel.name for channel in channels]
    full = [f"{channel.group_name}/{channel.name}" for channel in channels]
    clock = _TIME not in present and _TIME in names
    wanted = tuple(name for name in names if not (clock and name == _TIME))
    there = [*present, *(name for name in full if name in wanted)]
    refuse_missing(path, wanted, there, wanted_by, shown=told_apart(channels))
    chosen = {name: channels[full.index(name) if name in full else present.index(name)] for name in wanted}
    refuse_many(path, sum(map(len, chosen.values())), wanted_by, limits)
    columns = {
        name: as_numbers(path, name, np.asarray(channel[:]), missing=name in missing)
        for name, channel in chosen.items()
    }
    if clock:
        columns[_TIME] = Numbers(_common_clock(path, chosen), seconds=True)
    _refuse_different_lengths(path, columns)
    values = np.column_stack([columns[name].values for name in names])
    return Table(values, frozenset(name for name, column in columns.items() if column.seconds))


def _common_clock(path: Path, channels: dict[str, Any]) -> Array:
    """Times (n_r,) in s of waveforms that were sampled together."""
    clocks = {}
    for name, channel in channels.items():
        try:
            clocks[name] = np.asarray(channel.time_track(), dtype=np.float64)
        except KeyError as error:
            raise BadInput(
                f'{path}: it has neither a channel "time" nor the sampling interval of {name} (wf_increment); '
                "write waveforms, or a channel of times in s"
            ) from error
    first = next(iter(clocks))
    for name, clock in clocks.items():
        if clock.shape == clocks[first].shape and not np.array_equal(clock, clocks[first]):
            raise BadInput(f"{path}: {first} and {name} were sampled at different times; make each a record of its own")
    return clocks[first]


def _refuse_different_lengths(path: Path, columns: dict[str, Numbers]) -> None:
    sizes = {name: column.values.size for name, column in columns.items()}
    if len(set(sizes.values())) > 1:
        found = ", ".join(f"{name} {size}" for name, size in sizes.items())
        raise BadInput(f"{path}: channels of different lengths ({found} rows); give each rate a record of its own")
