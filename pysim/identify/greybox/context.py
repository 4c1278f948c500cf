"""One data set beside one model: names, units, noise, and how long the model takes to settle."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from pysim.identify.greybox.settings import BeginningSettings, RestSettings
from pysim.identify.greybox.treatment import Treatment
from pysim.simulate import Esdirk, Sensitivities, sensitivities_many
from pysim.types import BadInput, Dataset, Experiment, MeasuredRecord, Model, Outcome, Record, Signal

Array = NDArray[np.float64]

_SETTINGS = RestSettings()


def on_one_clock(dataset: Dataset) -> Dataset:
    """A data set whose clock begins with its first log where it was a date: that rounds the steps of a run away."""
    first = min((record.begin for record in dataset.records if record.begin is not None), default=0.0)
    if abs(first) < BeginningSettings().date:
        return dataset
    records = (one if one.begin is None else replace(one, begin=one.begin - first) for one in dataset.records)
    return replace(dataset, records=tuple(records))


@dataclass(frozen=True)
class Context:
    """Everything that making the observations of one data set needs.

    Args:
        overrides: parameters that differ from the model's own in these tests.
        outputs: columns that are compared.
        noise: of each of them, standard deviation in its unit.
        started: records whose states are free parameters, None for all: their model does not come to rest first.
    """

    model: Model
    dataset: Dataset
    overrides: Mapping[str, float]
    outputs: tuple[str, ...]
    noise: Mapping[str, float]
    treatment: Treatment
    started: Collection[str | None]

    def columns(self, record: MeasuredRecord) -> tuple[tuple[str, ...], tuple[str, ...]]:
        """Commands and compared outputs of a log."""
        assert isinstance(record.data, Record)
        names = record.data.names
        commands = tuple(n for n in names if self.dataset.signal(n).role == "input")
        outputs = tuple(n for n in names if n in self.outputs)
        if not commands:
            raise BadInput(f"{record.source}: no column is an input; name the command in the data set")
        return commands, outputs

    def variable(self, column: str) -> str:
        """The model's name of a column, once both have the same unit."""
        return self.model.measured(self.dataset.signal(column), f"data set {self.dataset.name!r}").name

    def experiment(
        self, times: Array, outputs: tuple[str, ...], commands: Mapping[str, Signal], start: float, later: float = 0.0
    ) -> Experiment:
        """A run of the model, everything by the model's names.

        Args:
            later: s by which all of it is moved, so that the model's `time` is the clock of all records.
        """
        names = tuple(self.variable(column) for column in outputs)
        if later:  # a long log is not copied for nothing
            times, start = times + later, start + later
            commands = {name: signal.later(later) for name, signal in commands.items()}
        return Experiment(times, names, commands, self.overrides, start, rates=self.model.rate_inputs(commands))

    def first_value(self, name: str) -> float:
        """An input's start value, at which the model starts."""
        return float(self.model[name].start or 0.0)

    @cached_property
    def longest(self) -> float:
        """s, of the longest log, or of some periods of the slowest sine of a table."""
        lasts = [float(np.ptp(log.data.time)) for log in self.dataset.logs() if isinstance(log.data, Record)]
        lasts += [_SETTINGS.periods / float(response.frequency[0]) for response in self.dataset.responses()]
        return max(lasts, default=0.0)

    @cached_property
    def _left_alone(self) -> Sensitivities | None:
        """What is compared while the model is left alone from its start on, for as long as the longest log."""
        names = tuple(dict.fromkeys(self.variable(column) for column in self.outputs))
        count = len(self.model.abilities.states)
        if not (count and names and self.longest > 0):
            return None
        times = self.longest * np.geomspace(_SETTINGS.earliest, 1.0, _SETTINGS.looks)
        alone = Experiment(times, names, overrides=self.overrides, offset=np.zeros(count))
        return sensitivities_many(
            self.model, [alone], (), offset=True, solver=Esdirk(1e-5, 1e-5, derivative_tol=1e-3), workers=1
        )[0]

    @property
    def still(self) -> bool:
        """Whether the model stands still from its start on, its inputs at theirs.

        Then it stands still too where a parameter or an effect moves its equilibrium, as the plant did before the log
        began: it is given the time to come there.
        """
        found = self._left_alone
        if found is None or found.record.outcome is not Outcome.DONE:
            return False
        values = found.record.values
        return bool(np.all(np.ptp(values, axis=0) <= _SETTINGS.still * np.abs(values).max(axis=0)))

    @cached_property
    def settling(self) -> float:
        """s after which a small change of any state has died away from what is compared; at most the longest log.

        Counted at the model's own start and parameters. A change that stays, as of the position behind an integrator,
        does not count.
        """
        found = self._left_alone
        if found is None:
            return 0.0
        times = found.record.time
        if found.record.outcome is not Outcome.DONE or not np.isfinite(found.by_offset).all():
            return self.longest
        nominal = np.array([abs(self.model[name].nominal or 1.0) for name in self.model.abilities.states])
        effect = found.by_offset * nominal
        away = np.abs(effect - effect[-1])
        largest = np.max(np.abs(effect), axis=(0, 2))[:, None]  # of any state
        moving = np.flatnonzero(np.any(away > _SETTINGS.settled * largest, axis=(1, 2)))
        return float(times[min(moving[-1] + 1, times.size - 1)]) if moving.size else float(times[0])
