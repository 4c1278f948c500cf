"""Models held against measurements, as they are."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from pysim.io.prepare import logs_called
from pysim.nouns.common import dataset_of
from pysim.nouns.model import Model
from pysim.nouns.table import Shown, Table
from pysim.nouns.where import Where
from pysim.present.progress import Progress, showing
from pysim.types import BadInput, Criterion, Dataset, Note, ProgressEvent, RecordFit
from pysim.types.kinds import mapping_of, number_of

if TYPE_CHECKING:
    from pysim.workflow import Initial

Limits = Mapping[str, float]
Criteria = str | Limits | None
_AT_LEAST = ("fit %",)  # columns of which more is better
_HEAD = ("model", "log", "signal", "use", "fit %", "rms", "unit", "x noise")


def compare(*given: Any, initial: Initial = None, criteria: Criteria = None, progress: Progress = None) -> Comparison:
    """Hold models against measurements: fit percent, rms in the signal's unit, and residual in noise, log by log.

    Args:
        given: one model or several, then the measurements: `compare(before, after, data)`.
        initial: of each log: "rest", "estimate", state -> value; None at states that were set, else as the fit had it
            that gave one of the models, else as the data say, else near rest. Initial states that are not given are
            estimated from the log itself.
        criteria: "thesis" judges logs by thesis Table 1.4; column of the table -> limit judges by your own.
        progress: see `pysim.present.progress.showing`.
    Raises:
        BadInput: no model, what does not fit together, or a model that cannot be simulated along any log.
    """
    *models, data = given or (None,)
    if not models or not all(isinstance(one, Model) for one in models):
        raise BadInput(
            "compare: give one model or several, as pysim.model makes them, then the measurements", argument="given"
        )
    dataset = dataset_of(data)
    names, fitted = _names(models), next((one.initial for one in models if one.initial is not None), None)
    records: dict[str, tuple[RecordFit, ...]] = {}
    notes: list[Note] = []
    with showing(progress, "comparing") as say:
        for name, one in zip(names, models, strict=True):
            say(ProgressEvent(f"simulating {name}"))
            known = one.first_sample(initial)
            records[name], more = one.beside(dataset, fitted if known is None else known)
            notes += more
    return Comparison(records, dataset, criteria, tuple(dict.fromkeys(notes)))


def _names(models: list[Model]) -> list[str]:
    """Of each model, so that no two are the same."""
    found: list[str] = []
    for one in models:
        name = one.shown
        found.append(name if name not in found else f"{name} ({len(found) + 1})")
    return found


@dataclass(frozen=True, repr=False)
class Comparison(Shown):
    """Models beside measurements.

    Args:
        records: model -> each log beside it.
        dataset: the measurements.
        criteria: what they are judged by; nothing where None.
        notes: what was assumed, and what could not be simulated.
    """

    records: Mapping[str, tuple[RecordFit, ...]]
    dataset: Dataset
    criteria: Criteria = None
    notes: tuple[Note, ...] = ()

    @property
    def table(self) -> Table:
        """A row per model, log and signal; "x noise" is the rms residual over the noise: 1 is noise alone."""
        rows = [row for model, records in self.records.items() for one in records for row in _rows(model, one)]
        limits = self._limits
        if not limits:
            return Table.of(_HEAD, [row for row, _ in rows])
        return Table.of(
            (*_HEAD, *(f"{name} limit" for name in limits), "passes"),
            [(*row, *limits.values(), _passes(row, one, limits)) for row, one in rows],
        )

    @property
    def passes(self) -> bool | None:
        """Whether every row meets the criteria; None where there are none."""
        return None if not self._limits else all(self.table["passes"])

    @property
    def _limits(self) -> Limits:
        if self.criteria is None:
            return {}
        if isinstance(self.criteria, str):
            if self.criteria != "thesis":
                raise BadInput(
                    f'criteria = {self.criteria!r} is not known; write "thesis", or column: limit', argument="criteria"
                )
            return {one.symbol: one.limit for one in _thesis(self.records)}
        known = [*_AT_LEAST, "rms", "x noise"]
        for name in mapping_of(self.criteria, "criteria"):
            if name not in known:
                raise BadInput(
                    f"criteria: there is no column {name!r}; limits are for {', '.join(known)}", argument="criteria"
                )
        return {name: number_of(limit, "criteria") for name, limit in self.criteria.items()}

    @property
    def warnings(self) -> tuple[str, ...]:
        """What could not be simulated or compared, in sentences."""
        from pysim.present.notes import words

        return tuple(words(note) for note in self.notes)

    def where(self) -> Where:
        """Where the last of the models fails, the worst region first."""
        from pysim.identify.failures import failures

        return Where(failures(list(self.records.values())[-1], self.dataset))

    def plot(self, log: str = "", *, interactive: bool = False) -> Any:
        """One log, measured and as each model has it, with what is left.

        Args:
            log: its name; by default one that is not fitted, where the first model fails most.
            interactive: a Plotly figure in place of Matplotlib's.
        """
        from pysim.present.charts import as_plotly
        from pysim.present.overlay import beside_chart, logs_figure

        sources = {record.source for record in logs_called(self.dataset, log)} if log else set()
        first = [one for one in next(iter(self.records.values())) if one.source in sources or not log]
        if not first:
            raise BadInput("nothing to draw: no such log over time was compared", argument="log")
        index = max(first, key=lambda one: (one.use != "fit", max(one.rms.values()))).index
        beside = {name: one for name, records in self.records.items() for one in records if one.index == index}
        return as_plotly(beside_chart(beside)) if interactive else logs_figure(beside)

    @property
    def _tables(self) -> tuple[Table, ...]:
        names = [name for name in self.table.columns if name != "model" or len(self.records) > 1]
        return (self.table.of_columns(*names),)

    @property
    def _more(self) -> list[str]:
        return [*self.warnings]

    @property
    def _words(self) -> list[str]:
        return [f"{', '.join(self.records)} against {self.dataset.name}"]


def _rows(model: str, one: RecordFit) -> list[tuple[tuple[Any, ...], RecordFit]]:
    from pysim.io import shown_unit
    from pysim.present.notes import USES

    away = np.sqrt(np.nanmean((one.measured.values - one.simulated.values) ** 2, axis=0))
    rows = []
    for j, name in enumerate(one.measured.names):
        unit, factor = shown_unit(one.measured.units[j])
        numbers = (one.fit_percent[name], float(factor * away[j]), unit, one.rms[name])
        rows.append(((model, one.source, name, USES[one.use], *numbers), one))
    return rows


def _passes(row: tuple[Any, ...], one: RecordFit, limits: Limits) -> bool:
    own = dict(zip(_HEAD, row, strict=True))
    judged = {d.criterion.symbol: d.passes for d in one.deviations.get(own["signal"], ())}
    return all(
        judged.get(name, True) if name not in own else own[name] >= limit if name in _AT_LEAST else own[name] <= limit
        for name, limit in limits.items()
    )


def _thesis(records: Mapping[str, tuple[RecordFit, ...]]) -> list[Criterion]:
    found = [d.criterion for own in records.values() for one in own for ds in one.deviations.values() for d in ds]
    return list(dict.fromkeys(found))
