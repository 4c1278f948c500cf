"""Base models and models with effects, fitted by least squares from several starts."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from pysim.identify.greybox import Effort, Parameter, fit, problem
from pysim.types import Dataset, Fit, Record
from validation.held_out import FINE, held_out_rms
from validation.real.machines import Machine

_FIRST = 20  # samples of a log that say how it begins
# Random starts besides: an absolute value has several minima, of which one start may find the wrong one.
# None are drawn where the log itself shows the initial states, which have no bounds to draw between.
_STARTS = 4


@dataclass(frozen=True)
class Fitted:
    """A model with effects.

    Args:
        fit: how it was found.
        error: root mean square residual of the logs that were fitted and of those held out, in the signal's unit.
    """

    fit: Fit
    error: tuple[float, float]


def fitted(machine: Machine, root: Path, effects: Sequence[str], starts: Mapping[str, float]) -> Fitted:
    """The model with these effects, all its parameters and initial states free.

    Args:
        root: holds the folders of logs.
        effects: names; none for the base model.
        starts: where the search begins: "parameter", or "effect.parameter"; elsewhere at the model's own values, and at
            the nominal sizes of effects.
    """
    chosen = machine.effects(effects)
    model, places = machine.subject.variants.build(chosen)
    free = [Parameter(name, start=starts.get(name)) for name in machine.free]
    for effect in chosen:
        for one in effect.parameters:
            start = starts.get(f"{effect.name}.{one.name}", one.nominal)
            free.append(Parameter(f"{places[effect.name]}.{one.name}", start=start, log=False))
    dataset = machine.measurements(root)
    begun = [*free, *_initial_states(machine, dataset)]
    effort = Effort(nominal=False, starts=_STARTS if machine.shown is None else 0, seed=1)
    found = fit(problem(model, [dataset], begun), simulation=FINE, effort=effort)
    values = {parameter.name: found.values[parameter.name] for parameter in free}
    (held_out,) = held_out_rms(model, dataset, values).values()
    return Fitted(found, (_rms(found), held_out))


def _initial_states(machine: Machine, dataset: Dataset) -> list[Parameter]:
    """Of each fitted log, where its signal shows a state and its derivative: a parabola through the first samples."""
    found: list[Parameter] = []
    for record in dataset.logs():
        if machine.shown is None or record.use != "fit":
            continue
        assert isinstance(record.data, Record)
        (column,) = dataset.columns(record, "output")
        time = record.data.time[:_FIRST] - record.data.time[0]
        _, rate, value = np.polyfit(time, record.data[column][:_FIRST], 2).tolist()
        for state, start in zip(machine.shown, (value, rate), strict=True):
            found.append(Parameter(state, start=start, log=False, record=record.source))
    return found


def _rms(found: Fit) -> float:
    """Of all samples that were fitted."""
    rests = [(r.measured.values - r.simulated.values).ravel() for r in found.records if r.use == "fit"]
    return float(np.sqrt(np.mean(np.concatenate(rests) ** 2)))
