"""All channels of a LabVIEW TDMS file."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pysim.io.limits import LIMITS
from pysim.io.load.foreign_units import EXTRA
from pysim.io.load.table import RawTable
from pysim.io.named_columns import optional_package, refuse_many
from pysim.io.tdms_table import DAMAGED, told_apart
from pysim.types import BadInput

_UNITS = ("unit_string", "NI_UnitDescription", "unit")


def read_tdms_log(path: Path) -> tuple[RawTable, ...]:
    """Channels of the same length as one log, called "group/channel" where two groups have the same.

    Waveforms carry their clock, which becomes a column "time".

    Raises:
        BadInput: the package is missing, no TDMS file, or no channels of the same length.
    """
    tdms = optional_package("nptdms", f"{path} is a TDMS file", f'"{EXTRA}"')
    try:
        with tdms.TdmsFile.open(path) as file:
            channels = [channel for group in file.groups() for channel in group.channels() if len(channel) > 1]
            refuse_many(path, sum(map(len, channels)), "load", LIMITS)
            sizes = dict.fromkeys(map(len, channels))
            tables = tuple(_table(path, [c for c in channels if len(c) == size], len(sizes)) for size in sizes)
    except DAMAGED as error:
        if isinstance(error, BadInput):
            raise
        raise BadInput(f"cannot read {path} as TDMS ({error}); correct the name or export it again") from error
    if not tables:
        raise BadInput(f"cannot read {path} as TDMS (it has no channels); export it again")
    return tables


def _table(path: Path, channels: list[Any], count: int) -> RawTable:
    names, cells = list(told_apart(channels)), [_cells(channel) for channel in channels]
    units = {
        n: str(c.properties[key]) for n, c in zip(names, channels, strict=True) for key in _UNITS if key in c.properties
    }
    waves = [channel.properties for channel in channels if "wf_increment" in channel.properties]
    clocks = [wave.get("wf_start_offset", 0.0) + wave["wf_increment"] * np.arange(cells[0].size) for wave in waves]
    if clocks and "time" not in names:
        if not all(np.array_equal(clock, clocks[0]) for clock in clocks):
            raise BadInput(f"{path}: its waveforms were sampled at different times; export each rate into its own file")
        names, cells, units = ["time", *names], [np.asarray(clocks[0]), *cells], {**units, "time": "s"}
    group = channels[0].group_name
    place, name = (f"{path}, group {group}", f"{path.stem}-{group}.tdms") if count > 1 else (str(path), path.name)
    return RawTable(place, name, tuple(names), tuple(cells), units)


def _cells(channel: Any) -> NDArray[Any]:
    cells = np.asarray(channel[:])
    return cells if cells.dtype.kind in "fiubmM" else cells.astype(object)
