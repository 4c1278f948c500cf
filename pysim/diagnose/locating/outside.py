"""What is missing as far as it can be seen from outside: a term at an input or an output of a model that stays shut."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from pysim.diagnose.fitted import Fitted
from pysim.diagnose.locating.fit import Estimate, Table, knots, solve
from pysim.diagnose.locating.formula import formula
from pysim.diagnose.locating.found import Base, Found
from pysim.diagnose.locating.laws import KNOTS, Copy, Law
from pysim.diagnose.locating.runs import thinned
from pysim.diagnose.locating.shape import shape, told, units
from pysim.diagnose.residuals import Ruler
from pysim.diagnose.screen import across
from pysim.identify.greybox.observation import Simulated
from pysim.identify.greybox.residuals import Point
from pysim.simulate import simulate_many
from pysim.types import Experiment, Missing, Outcome, Record, Signal

Array = NDArray[np.float64]

# Change of an input, in shares of its size, from which the answer to a small term there is taken.
_STEP = 1e-2
# Points at which a run is looked at, at least and at most.
_POINTS = 400, 5000


@dataclass(frozen=True)
class _Place:
    """An input or an output, and a variable its term may depend on.

    Args:
        law: as for places inside.
        is_input: a term is added to what drives the model; else to what it answers.
    """

    law: Law
    is_input: bool

    @property
    def name(self) -> str:
        return self.law.copies[0].output

    @property
    def argument(self) -> str:
        return self.law.copies[0].argument


@dataclass(frozen=True)
class _Way:
    """One run of the fitted model: the experiment, its answer there, and all signals on a fine grid of times."""

    experiment: Experiment
    values: Array = field(repr=False)
    fine: Record = field(repr=False)

    def signal(self, name: str, of_rate: bool) -> Array:
        """(n,) of an input or output, or of its rate, on the fine grid."""
        driven = self.experiment.inputs.get(name)
        if driven is None:
            values = self.fine[name]
            return np.asarray(np.gradient(values, self.fine.time)) if of_rate else values
        return driven.derivative(self.fine.time) if of_rate else driven.value(self.fine.time)


def outside(ruler: Ruler, current: Fitted) -> tuple[Missing, ...]:
    """Estimate the term that would close the gap if it stood at an input or an output of the model.

    A term at an input is added to what drives the model, one at an output to what it answers. It is a table over one
    signal: the input or output itself, its rate, or one of the others. To first order around the fitted model, what
    refitting takes left out, in the tests that show most of the misfit for their time. Nothing else of an FMU without
    source can be probed.

    Args:
        ruler: of what is fitted.
        current: the model at its best point, with slopes by all that is free.
    Returns:
        per input and output the best term, the most likely place first; empty where the model cannot be simulated.
    """
    few = thinned(ruler, current.point)
    point = few.evaluation(current.what, current.point.x)
    if not point.good:
        return ()
    ruler, current = few, Fitted(current.what, point)
    ways = _ways(ruler, current)
    if not ways:
        return ()
    base = Base.of(current)
    best: dict[str, Found] = {}
    for place in _places(ways):
        samples = [way.signal(place.argument, place.law.of_rate) for way in ways]
        k = knots(np.concatenate(samples))
        columns = _at_input(ruler, current, ways, place, k) if place.is_input else _at_output(ruler, ways, place, k)
        found = None if columns is None else _found(base, place, k, columns)
        if found is not None and (place.name not in best or found.evidence > best[place.name].evidence):
            best[place.name] = found
    return tuple(_missing(found) for found in sorted(best.values(), key=lambda f: -f.evidence))


def _ways(ruler: Ruler, current: Fitted) -> list[_Way]:
    runs = ruler.experiments(current.what.space.values(current.point.x))
    outputs = tuple(dict.fromkeys(name for run in runs for name in run.record))  # a log may lack some of them
    fine = [_finely(run, outputs) for run in runs]
    records = simulate_many(current.what.model, [*runs, *fine], solver=ruler.solver, workers=ruler.workers)
    if any(record.outcome is not Outcome.DONE for record in records):
        return []
    return [_Way(e, r.values, f) for e, r, f in zip(runs, records[: len(runs)], records[len(runs) :], strict=True)]


def _finely(run: Experiment, outputs: tuple[str, ...]) -> Experiment:
    duration = float(run.times[-1]) - run.start
    between = float(np.median(np.diff(run.times))) if run.times.size > 1 else duration
    count = int(np.clip(2 * duration / between, *_POINTS))
    return replace(run, times=np.linspace(run.start, run.times[-1], count), record=outputs)


def _places(ways: Sequence[_Way]) -> Iterator[_Place]:
    inputs = tuple(dict.fromkeys(name for way in ways for name in way.experiment.inputs))
    outputs = tuple(dict.fromkeys(name for way in ways for name in way.experiment.record))
    for name in (*inputs, *outputs):
        is_input = name in inputs
        yield _Place(Law(name, name, (Copy(name, name),)), is_input)
        yield _Place(Law(name, f"der({name})", (Copy(name, name),), of_rate=True), is_input)
        for other in outputs if is_input else inputs:
            yield _Place(Law(name, other, (Copy(name, other),)), is_input)


def _hats(z: Array, k: Array) -> Array:
    """(n, KNOTS): how much of each knot's value the table has at z, straight in between."""
    return np.stack([np.interp(z, k, row) for row in np.eye(k.size)], axis=1)


def _at_input(ruler: Ruler, current: Fitted, ways: Sequence[_Way], place: _Place, k: Array) -> Array | None:
    """Change of the residuals by each value of a table (n_r, KNOTS), by one-sided differences."""
    size = max(float(np.ptp(way.signal(place.name, False))) for way in ways)
    if not size > 0:
        return None
    step = _STEP * size
    weights = [_hats(way.signal(place.argument, place.law.of_rate), k) for way in ways]
    columns = []
    for i in range(k.size):
        runs = [_pushed(way, place.name, step * w[:, i]) for way, w in zip(ways, weights, strict=True)]
        residual = ruler.count(current.what.model, runs)
        if residual is None:
            return None
        columns.append((residual - current.point.residual) / step)
    return np.stack(columns, axis=1)


def _pushed(way: _Way, name: str, values: Array) -> Experiment:
    driven = way.experiment.inputs[name].plus(Signal.through(way.fine.time, values))
    return replace(way.experiment, inputs={**way.experiment.inputs, name: driven})


def _at_output(ruler: Ruler, ways: Sequence[_Way], place: _Place, k: Array) -> Array:
    """The same of a table at an output, exactly: it is added to the answer."""
    answers = []
    for way in ways:
        slopes = np.zeros((*way.values.shape, k.size))
        z = np.interp(way.experiment.times, way.fine.time, way.signal(place.argument, place.law.of_rate))
        if place.name in way.experiment.record:
            slopes[:, way.experiment.record.index(place.name)] = _hats(z, k)
        answers.append(Simulated(way.values, slopes))
    return ruler.span.across(ruler.weighed(answers))[:, 1:]


def _found(base: Base, place: _Place, k: Array, columns: Array) -> Found | None:
    point = base.at.point
    own, left_over = across(base.span, columns), across(base.span, point.residual)
    size = float(np.linalg.norm(own)) / math.sqrt(KNOTS)
    if not size > 0:
        return None
    unit = float(np.linalg.norm(left_over)) / size
    solution = solve(left_over, own * unit, k)
    table = Table(place.law, base.at.what.model, k, unit)
    slopes = np.hstack([point.jacobian, columns * unit])
    whole = Point(np.append(point.x, solution.values), point.cost, point.residual, slopes)
    return base.found(Estimate(table, whole, solution))


def _missing(found: Found) -> Missing:
    law, model, of = found.estimate.table.law, found.estimate.table.model, told(found.estimate)
    unit_in, unit_out = units(law, model)[0], model[law.slot].unit  # added to the variable, never to its derivative
    said = formula(
        of.knots, of.values, of.doubt, of.absorbed, argument=law.argument, unit_in=unit_in, unit_out=unit_out
    )
    shown = replace(shape(of, law, model, said.along), unit=unit_out)
    return Missing(law.slot, found.share, law.argument, shown, said.text)
