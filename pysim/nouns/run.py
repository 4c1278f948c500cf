"""A run that was simulated: its columns over time."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pysim.nouns.table import Shown, Table, pandas
from pysim.types import BadInput, Note, Outcome, Record
from pysim.types.kinds import path_of


@dataclass(frozen=True, repr=False)
class Run(Shown):
    """What a model, or a system of models and controllers, did.

    Args:
        record: its columns, in their units.
        name: of the model.
        notes: what may not be as it was meant.
        controllers: of a co-simulation, copies of the objects that were given, as the run left them.
    """

    record: Record
    name: str = ""
    notes: tuple[Note, ...] = ()
    controllers: Mapping[str, Any] = field(default_factory=dict)

    @property
    def warnings(self) -> tuple[str, ...]:
        """What may not be as it was meant, in sentences."""
        from pysim.present.notes import words

        return tuple(words(note) for note in self.notes)

    @property
    def _alarms(self) -> tuple[str, ...]:
        return self.warnings

    def __getitem__(self, name: str) -> NDArray[np.float64]:
        """A column, (n_t,) in its unit."""
        return self.record[name]

    @property
    def time(self) -> NDArray[np.float64]:
        """(n_t,) s."""
        return self.record.time

    @property
    def table(self) -> Table:
        """Lowest, highest and last value of each column."""
        one = self.record
        rows = [
            (name, unit, *(float(f(one[name])) if one.time.size else None for f in (np.min, np.max, lambda v: v[-1])))
            for name, unit in zip(one.names, one.units, strict=True)
        ]
        return Table.of(("signal", "unit", "lowest", "highest", "at the end"), rows, key="signal")

    def to_dataframe(self) -> Any:
        """Columns over time: a pandas DataFrame whose index is the time in s."""
        one = self.record
        index = pandas().Index(one.time, name="time [s]")
        named = zip(one.names, one.units, strict=True)
        heads = [name if unit == "1" else f"{name} [{unit}]" for name, unit in named]
        return pandas().DataFrame(one.values, index=index, columns=heads)

    def plot(self, *, interactive: bool = False) -> Any:
        """All columns over time, one panel a unit; a Plotly figure where `interactive`, one panel a column."""
        from pysim.present.charts import as_plotly
        from pysim.present.cosim import cosim_figure
        from pysim.present.overlay import lines_chart

        return as_plotly(lines_chart({self.name: self.record})) if interactive else cosim_figure(self.record)

    def save(self, file: Path | str) -> Path:
        """Write it as .csv or .npz, by the name of the file; a run that was saved there before is replaced.

        Raises:
            BadInput: the file is there and holds something else, or cannot be written.
        """
        from pysim.io import is_written_record, write_record

        place = path_of(file, "file")
        if place.exists() and not is_written_record(place):
            raise BadInput(f"{place} is there already and holds no run; name another file", argument="file")
        write_record(self.record, place)
        return place

    @property
    def _words(self) -> list[str]:
        one = self.record
        ended = "" if one.outcome is Outcome.DONE else f", stopped: {one.message or one.outcome.value}"
        counts = ", ".join(f"{count} {what}" for what, count in one.statistics.items() if count)
        reached = f"{one.time[0]:g} to {one.time[-1]:g} s, {one.time.size} rows" if one.time.size else "no rows"
        return [f"{self.name or 'run'}: {reached}{f', {counts}' if counts else ''}{ended}"]
