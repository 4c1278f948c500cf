"""One log without a dataset.toml: what it is, the caller tells."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from pysim.io.columns import read_columns, refuse_standing_time
from pysim.io.measured_log import TIME, in_si
from pysim.io.units import Scale, signal_in_si, unit_cure
from pysim.types import UNITS, BadInput, Dataset, MeasuredRecord, MeasuredSignal


def read_single_log(path: Path | str, kind: str, columns: Sequence[str], units: Sequence[str]) -> Dataset:
    """A data set of a single log over time.

    Args:
        path: text, .parquet or .tdms.
        kind: of test, as in `MeasuredRecord`.
        columns: "time", then the command, then what responds; of a text file in its order.
        units: of command and responses, as the file has them.
    Returns:
        in SI units or %.
    Raises:
        BadInput: columns or units that do not fit together, and what is wrong in the file, with its line.
    """
    path, names = Path(path), tuple(columns)
    if len(names) < 3 or names[0] != TIME or len(set(names)) != len(names):
        raise BadInput(f"{path}: columns {', '.join(names)}: name time, the command and at least one response")
    if len(units) != len(names) - 1:
        raise BadInput(f"{path}: units {', '.join(units)}: give one for {', '.join(names[1:])} each")
    for unit in units:
        if unit not in UNITS:
            raise BadInput(f"{path}: the unit {unit!r} is not known; {unit_cure(unit)}")
    table = read_columns(path, names, str(path))
    refuse_standing_time(table)
    signals = {
        name: MeasuredSignal(name, "output" if i else "input", unit, name, name)
        for i, (name, unit) in enumerate(zip(names[1:], units, strict=True))
    }
    scales = {name: Scale.of(signal.unit) for name, signal in signals.items()}
    record = MeasuredRecord(path.name, kind, "fit", in_si(table, scales, f"measured, {path.name}"))
    return Dataset(path.name, "", "", tuple(signal_in_si(signal) for signal in signals.values()), (record,))
