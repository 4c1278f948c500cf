"""Laws for an FMU without Modelica source: what would have to be added to its inputs or outputs.

A law is added to an input, `u + h(z)`, or to an output, `y + h(z)`; z is an input, an output, or an output's rate. All
is to first order, with the parameters refitted. Nothing inside the model is changed, so that no Modelica class can be
written.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from pysim.diagnosis import rivals
from pysim.diagnosis.learn.basis import knots
from pysim.diagnosis.learn.described import SHOWN, covariance_of
from pysim.diagnosis.learn.products import Products
from pysim.diagnosis.learn.screening import first_order
from pysim.diagnosis.refit import FinalFit
from pysim.diagnosis.settings import LearnSettings
from pysim.effects.law_units import quotient
from pysim.effects.learned import curve_basis
from pysim.identify.greybox.residuals import Channel
from pysim.simulate import simulate_many
from pysim.types import BadInput, Experiment, Model, Outcome, Signal
from pysim.types.answer import LearnedLaw
from pysim.types.factor import Factor

Array = NDArray[np.float64]

_STEP = 0.01  # finite-difference step of an input, over its range


def outside_laws(present: FinalFit, floors: Mapping[Channel, float]) -> tuple[LearnedLaw, ...]:
    """The best law of each input and output, the best place first (by penalised gain).

    Args:
        present: the refitted model that lacks something.
        floors: standard deviation of the noise of each channel.
    Raises:
        BadInput: a stepped sine or a response table is among the measurements.
    """
    residuals = present.candidate.residuals(present.simulation)
    if any(run.orbit is not None for run in residuals.runs) or any(o.domain != "time" for o in residuals.observations):
        raise BadInput("a closed FMU is located in by logs over time alone; leave stepped sines and tables out")
    held, states = present.candidate.held(present.values).fixed, present.point.carried.states
    runs = [
        run.over_time(held, s) for run, s in zip(residuals.runs, states or (None,) * len(residuals.runs), strict=True)
    ]
    views = [_View(present.candidate.model, run, present) for run in runs]
    if not all(view.good for view in views):
        return ()
    answer = residuals.simulate(
        present.candidate.model, present.candidate.space, present.point.x, present.point.carried, jacobian=False
    )
    table, count = Products.at(present.point, residuals, floors), max(rivals.samples(present), 3.0)
    best: dict[str, tuple[float, LearnedLaw]] = {}
    for name, unit in _arguments(views):
        k = knots(np.concatenate([view.signals[name] for view in views]), LearnSettings().knots)
        bases = [curve_basis(view.signals[name], k) for view in views]
        for place, given, slopes in _slopes(views, bases):
            changed = [replace(one, slopes=own) for one, own in zip(answer.simulated, slopes, strict=True)]
            moved = replace(answer, simulated=tuple(changed))
            rows = residuals.weigh(present.point.x, moved, present.point.carried, k.size).jacobian
            if not (np.isfinite(rows).all() and np.linalg.norm(rows) > 0):
                continue
            own = table.with_(rows)
            curve, gain, share = first_order(own, k)
            known = covariance_of(curve.gram, curve.smoothness, curve.values, 1.0)
            law = LearnedLaw(
                place, Factor(), name, k, curve.values / own.size, known.covariance / own.size**2, share, unit, given,
                known.absorbed, curve.edf,
            )  # fmt: skip
            score = gain - 0.5 * curve.edf * math.log(count)
            if score > best.get(place, (0.0, law))[0]:
                best[place] = (score, law)
    return tuple(law for _, law in sorted(best.values(), key=lambda one: -one[0]) if law.share > SHOWN)


class _View:
    """One run of the fitted model: signals, and the response of its outputs to changes of an input."""

    def __init__(self, model: Model, experiment: Experiment, present: FinalFit) -> None:
        self.model, self._solver = model, present.simulation.solver
        self.experiment = experiment
        times, (values,) = experiment.times, self.answers([experiment])
        self.good, self.values = values is not None, np.zeros((times.size, 0)) if values is None else values
        self.signals = {name: signal.value(times) for name, signal in experiment.inputs.items()}
        for name, column in zip(experiment.record, self.values.T, strict=False):
            self.signals |= {name: column, f"der({name})": np.gradient(column, times)}

    def answers(self, experiments: Sequence[Experiment]) -> list[Array | None]:
        """Simulated outputs (n_t, n_y) of each experiment; None for one that failed."""
        records = simulate_many(self.model, experiments, solver=self._solver)
        return [record.values if record.outcome is Outcome.DONE else None for record in records]

    def by_input(self, name: str, basis: Array, step: float) -> Array:
        """Derivative (n_t, n_y, m) of the outputs by the coefficients of a basis (n_t, m) that is added to an input."""
        own, times = self.experiment, self.experiment.times
        moved = [
            replace(own, inputs={**own.inputs, name: own.inputs[name].plus(Signal.through(times, step * column))})
            for column in basis.T
        ]
        empty = np.full_like(self.values, np.nan)
        found = [empty if values is None else (values - self.values) / step for values in self.answers(moved)]
        return np.stack(found, axis=2)


def _arguments(views: Sequence[_View]) -> Iterator[tuple[str, str]]:
    """Arguments of laws, with their units: inputs, outputs and the outputs' rates, as far as they move."""
    model = views[0].model
    for name in views[0].signals:
        moves = any(np.ptp(view.signals[name]) > 0 for view in views)
        base = name.removeprefix("der(").removesuffix(")")
        unit = model[base].unit or "1"
        if moves and all(name in view.signals for view in views):
            yield name, quotient(unit, "s") if base != name else unit


def _slopes(views: Sequence[_View], bases: Sequence[Array]) -> Iterator[tuple[str, str, list[Array]]]:
    """Each output and input, its unit, and per run the derivative (n_t, n_y, m) of the outputs by a law there."""
    model, first = views[0].model, views[0].experiment
    for j, name in enumerate(first.record):
        slopes = [np.zeros((*view.values.shape, basis.shape[1])) for view, basis in zip(views, bases, strict=True)]
        for own, basis in zip(slopes, bases, strict=True):
            own[:, j, :] = basis
        yield name, model[name].unit or "1", slopes
    for name in first.inputs:
        step = _STEP * max(float(np.ptp(view.signals[name])) for view in views)
        if step > 0:
            yield name, model[name].unit or "1", [v.by_input(name, b, step) for v, b in zip(views, bases, strict=True)]
