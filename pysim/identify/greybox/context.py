"""One data set and one model: names, units, noise, and the model's settling time."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass, field, replace
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
    """The data set with its clock set to 0 at the first log if times are dates, which would round away small steps."""
    first = min((record.begin for record in dataset.records if record.begin is not None), default=0.0)
    if abs(first) < BeginningSettings().date:
        return dataset
    records = (one if one.begin is None else replace(one, begin=one.begin - first) for one in dataset.records)
    return replace(dataset, records=tuple(records))


@dataclass(frozen=True)
class Context:
    """What is needed to make the observations of one data set.

    Args:
        overrides: parameters that differ from the nominal ones in these tests.
        outputs: columns that are compared.
        noise: standard deviation of each of these columns, in its unit.
        started: records with initial states among the free parameters, None for all records; the model does not settle
            before these.
        at: values of parameters where the search begins, other than the model's own; the model settles, and its states
            range, as with these."""

    model: Model
    dataset: Dataset
    overrides: Mapping[str, float]
    outputs: tuple[str, ...]
    noise: Mapping[str, float]
    treatment: Treatment
    started: Collection[str | None]
    at: Mapping[str, float] = field(default_factory=dict)

    def columns(self, record: MeasuredRecord) -> tuple[tuple[str, ...], tuple[str, ...]]:
        """Commands and compared outputs of a log, of which some sample was measured."""
        assert isinstance(record.data, Record)
        names = record.data.names
        commands = tuple(n for n in names if self.dataset.signal(n).role == "input")
        outputs = tuple(n for n in names if n in self.outputs and np.isfinite(record.data[n]).any())
        if not commands:
            raise BadInput(f"{record.source}: no column is an input; name the command in the data set")
        return commands, outputs

    def variable(self, column: str) -> str:
        """Name of a column's variable in the model, whose unit must be that of the column."""
        return self.model.measured(self.dataset.signal(column), f"data set {self.dataset.name!r}").name

    def experiment(
        self, times: Array, outputs: tuple[str, ...], commands: Mapping[str, Signal], start: float, later: float = 0.0
    ) -> Experiment:
        """A run of the model, with the model's names.

        Args:
            later: s by which all times are moved, so that the model's `time` is the common clock of all records.
        """
        names = tuple(self.variable(column) for column in outputs)
        if later:  # otherwise a long log is not copied
            times, start = times + later, start + later
            commands = {name: signal.later(later) for name, signal in commands.items()}
        return Experiment(times, names, commands, self.overrides, start, rates=self.model.rate_inputs(commands))

    def first_value(self, name: str) -> float:
        """An input's start value in the model; 0 if it has none."""
        return float(self.model[name].start or 0.0)

    @cached_property
    def longest(self) -> float:
        """Longest duration in s of a log, and of a few periods at the lowest frequency of a response table."""
        lasts = [float(np.ptp(log.data.time)) for log in self.dataset.logs() if isinstance(log.data, Record)]
        lasts += [_SETTINGS.periods / float(response.frequency[0]) for response in self.dataset.responses()]
        return max(lasts, default=0.0)

    @cached_property
    def _nominal(self) -> Sensitivities | None:
        """The model left alone with its own parameter values."""
        return self._left_alone({})

    @cached_property
    def _begun(self) -> Sensitivities | None:
        """The model left alone with the parameter values where the search begins."""
        return self._left_alone(self.at) if self.at else self._nominal

    def _left_alone(self, values: Mapping[str, float]) -> Sensitivities | None:
        """Compared outputs of the model from its start values, inputs constant, and their derivatives by each state."""
        names = tuple(dict.fromkeys(self.variable(column) for column in self.outputs))
        count = len(self.model.abilities.states)
        if not (count and names and self.longest > 0):
            return None
        times = self.longest * np.geomspace(_SETTINGS.earliest, 1.0, _SETTINGS.looks)
        alone = Experiment(times, names, overrides={**values, **self.overrides}, offset=np.zeros(count))
        return sensitivities_many(
            self.model, [alone], (), offset=True, solver=Esdirk(1e-5, 1e-5, derivative_tol=1e-3), workers=1
        )[0]

    @property
    def still(self) -> bool:
        """Whether the compared outputs of the nominal model stay constant from its start values on, inputs constant.

        If so, the model settles before each log, as the plant did: a parameter or an effect may move its equilibrium
        away from the start values.
        """
        found = self._nominal
        if found is None or found.record.outcome is not Outcome.DONE:
            return False
        values = found.record.values
        return bool(np.all(np.ptp(values, axis=0) <= _SETTINGS.still * np.abs(values).max(axis=0)))

    @cached_property
    def _effects(self) -> Array | None:
        """(n_t, n_y, n_x) of a small change of each state, as a share of the largest; None if not simulated."""
        found = self._begun
        if found is None or found.record.outcome is not Outcome.DONE or not np.isfinite(found.by_offset).all():
            return None
        effect = found.by_offset * np.array([abs(self.model[n].nominal or 1.0) for n in self.model.abilities.states])
        largest = np.max(np.abs(effect), axis=(0, 2))[:, None]
        return effect / np.where(largest > 0, largest, 1.0)

    @cached_property
    def settling(self) -> float:
        """Settling time in s: when a small change of any state has faded from the compared outputs; at most `longest`.

        At the parameters' values where the search begins. A change that stays, as of the position behind an integrator,
        does not count. `longest` if the model cannot be simulated."""
        found, effect = self._begun, self._effects
        if found is None or effect is None:
            return 0.0 if found is None else self.longest
        times, away = found.record.time, np.abs(effect - effect[-1])
        moving = np.flatnonzero(np.any(away > _SETTINGS.settled, axis=(1, 2)))
        return float(times[min(moving[-1] + 1, times.size - 1)]) if moving.size else float(times[0])

    @cached_property
    def integrates(self) -> bool:
        """Whether more of a small change of some state stays in a compared output than fades, as of a position behind
        an integrator. Such a plant may stand anywhere, and moves on at inputs at which others come to rest."""
        if self._effects is None:
            return False
        effect, stays = np.abs(self._effects).max(axis=0), np.abs(self._effects[-1])
        return bool(np.any((stays > effect - stays) & (effect > _SETTINGS.settled)))
