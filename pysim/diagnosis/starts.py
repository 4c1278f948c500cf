"""Starts of refits: which effects and sensor errors are tried as the next step from a model, and from which values."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from functools import cache

import numpy as np

from pysim.diagnosis import rivals
from pysim.diagnosis.candidate import Candidate, Models, Values
from pysim.diagnosis.refit import FinalFit, Runner, begin, begun, converged, cost_at, exact
from pysim.diagnosis.screen import Screened, best_of_each, own_values
from pysim.diagnosis.settings import Settings
from pysim.identify.greybox import Nuisance, NuisanceKind, Simulation
from pysim.types import Record


@dataclass(frozen=True)
class Starts:
    """Starts of the refits that extend one model.

    Args:
        beside: returns the model's fit, its stepped sines as orbits (False) or simulated over time (True).
        simulation: solver settings of the refits.
        near: whether its residual is so close to the noise floor that first-order gains bound what a refit can gain.
        potential: gain in nats of a model that leaves only noise.
        settings: of the search.
    """

    beside: Callable[[bool], FinalFit]
    simulation: Simulation
    near: bool
    potential: float
    settings: Settings
    _here: dict[bool, FinalFit] = field(default_factory=dict, init=False, repr=False)

    def here(self, transient: bool) -> FinalFit:
        """The model's fit, simulated with the settings of the refits."""
        if transient not in self._here:
            fit = self.beside(transient)
            if fit.simulation != self.simulation:
                fit = begin(fit.candidate, fit.values, self.simulation, fit)
            self._here[transient] = fit
        return self._here[transient]

    def like(self, rival: FinalFit) -> FinalFit:
        """The model's fit to compare a rival with, simulated in the same way and no more roughly than the rival."""
        own = rival.candidate.transient
        return self.here(own) if rival.simulation == self.simulation else self.beside(own)

    def runners(self, sizes: Sequence[Screened], sensors: Sequence[FinalFit], tried: int) -> list[Runner]:
        """The rivals to refit, the most promising first; near the noise floor only those that could pass the F test.

        Args:
            sizes: effects as screened, at every size, the largest gain first.
            sensors: the model with one more sensor error each.
            tried: number of candidates, for the Bonferroni correction.
        """
        screened = best_of_each([one for one in sizes if not one.nonlinear])
        found = [self._of_effect(one) for one in screened]
        found += [self._of_sensor(fit) for fit in sensors]
        if not self.near:  # the model's parameters may be those of a local minimum
            return found + self._nearest(sizes)
        lefts = [rivals.of(self.beside(one.candidate.transient)) for one in screened]
        worth = [
            (len(one.effect.parameters), rivals.effective(one.leaves(left), one.change))
            for one, left in zip(screened, lefts, strict=True)
        ]
        worth += [(1, 1.0)] * len(sensors)
        for one in sizes:
            if one.nonlinear:  # refitted to its end at once: no step on the way there promises what the end gains
                found.append(self._runner(one.candidate, one.values, self.potential, ended=True))
                worth.append((len(one.effect.parameters), 1.0))
        return [one for one, own in zip(found, worth, strict=True) if self.could_pass(one.most, *own, tried)]

    def could_pass(self, gain: float, df: int = 1, inflated: float = 1.0, tried: int = 1) -> bool:
        """Whether the F test would accept this gain, nats, of df parameters, chosen among so many tried."""
        present = self.beside(False)
        chance = rivals.p_value(gain, df, rivals.samples(present), present.candidate.size + df, inflated)
        return tried * chance < self.settings.false_alarm

    def _nearest(self, sizes: Sequence[Screened]) -> list[Runner]:
        """Further starts at the nominal parameters, as fitted ones may hide what an effect could do: limits at the size
        with the lowest cost, and the effects that fit best there at their usual size, if better than none."""
        nominal = cache(lambda transient: self._cost(self.beside(transient).candidate, {}))
        best: dict[str, tuple[float, Screened]] = {}
        for one in sizes:
            name = one.effect.name
            if name in best and own_values(best[name][1]) == own_values(one):
                continue
            cost = self._cost(one.candidate, own_values(one))
            if math.isfinite(cost) and (name not in best or cost < best[name][0]):
                best[name] = cost, one
        found = [one for _, one in sorted(best.values(), key=lambda own: own[0])]
        limits = [one for one in found if one.start is None]
        others = [one for one in found if one.start and best[one.effect.name][0] < nominal(one.candidate.transient)]
        chosen = limits + others[: self.settings.finalists]
        return [self._runner(one.candidate, own_values(one), math.inf) for one in chosen]

    def _cost(self, candidate: Candidate, values: Values) -> float:
        return cost_at(candidate, values, self.simulation, self.beside(candidate.transient))

    def _most(self, gain: float) -> float:
        """Largest gain in nats that a refit can have, given its first-order gain; infinite far from the floor."""
        return self.settings.first_order_error * gain if self.near else math.inf

    def _runner(self, candidate: Candidate, values: Values, most: float, *, ended: bool = False) -> Runner:
        """Start at these values, refitted to the end at once if `ended`."""

        def start() -> FinalFit:
            fit = begin(candidate, values, self.simulation, self.beside(candidate.transient))
            return converged(fit) if ended else fit

        return Runner(start, self.here(candidate.transient).point.cost, most)

    def _of_effect(self, one: Screened) -> Runner:
        """Start with the effect practically off, where the Jacobian shows how far to go.
        If off has no derivative, start at the size that was best in the screening."""
        start, most = one.start, self._most(one.gain)
        if start is None:
            return self._runner(one.candidate, one.values, most)
        return Runner(lambda: start, one.before, most, beside=True)

    def _of_sensor(self, fit: FinalFit) -> Runner:
        """Start with a sensor error of 0; its first-order gain is what it promises beyond the model without it."""
        here = self.here(fit.candidate.transient)
        itself = begun(here.candidate, here.point, here.simulation, here.evaluate)
        return Runner(lambda: fit, here.point.cost, self._most(itself.expected - fit.expected), beside=True)


def with_sensor_errors(present: FinalFit, models: Models) -> list[FinalFit]:
    """The present model with one more sensor error each, at the present parameters.

    A sensor error that explains as much as an effect is tied with it. One simulation serves all: no run changes.
    """
    own, point, simulation = present.candidate, present.point, present.simulation
    free = [one for one in _nuisances(models) if one not in own.nuisances]
    candidates = [models.of(own.effects, (*own.nuisances, one), transient=own.transient) for one in free]
    if own.has_events:  # the Jacobian comes from secants
        return [begin(one, present.values, simulation, present) for one in candidates]
    found: list[FinalFit] = []
    answer = None
    for one in candidates:
        residuals, carried = one.residuals(simulation), one.carried(own, point)
        answer = answer or residuals.simulate(one.model, one.space, point.x, carried)
        there = residuals.with_priors(residuals.weigh(point.x, answer, carried, point.x.size), one.space)
        found.append(begun(one, there, simulation, exact(one, simulation)))
    return found


def _nuisances(models: Models) -> Iterator[Nuisance]:
    """Gain, offset and delay of every logged output; drift too, if the logs say when they began."""
    session = models.session
    settings, dataset = session.treatment.noise, session.dataset
    logs = [record for record in dataset.logs() if record.use == "fit" and isinstance(record.data, Record)]
    for signal in dataset.signals:
        own = [r.data for r in logs if isinstance(r.data, Record) and signal.name in r.data.names]
        own = [log for log in own if np.isfinite(log[signal.name]).any()]
        if signal.role != "output" or not own:
            continue
        scale = max(float(np.nanmax(abs(record[signal.name]))) for record in own) or 1.0
        interval = max(float((record.time[-1] - record.time[0]) / max(record.time.size - 1, 1)) for record in own)
        yield Nuisance(NuisanceKind.GAIN, dataset.name, signal.name, settings.gain_sd)
        yield Nuisance(NuisanceKind.OFFSET, dataset.name, signal.name, settings.offset_sd * scale)
        yield Nuisance(NuisanceKind.DELAY, dataset.name, signal.name, settings.delay_sd * interval)
        begins = {record.begin for record in logs if record.begin is not None}
        if len(begins) > 1:
            span = max(begins) - min(begins)
            yield Nuisance(NuisanceKind.DRIFT, dataset.name, signal.name, settings.drift_sd * scale / span)
