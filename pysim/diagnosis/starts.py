"""Which rivals are refitted beside a model, and from where."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from functools import partial

from pysim.diagnosis import rivals
from pysim.diagnosis.candidate import Candidate, Models, Values
from pysim.diagnosis.refit import FinalFit, Runner, begin, begun, cost_at, exact
from pysim.diagnosis.screen import Screened, best_of_each, own_values
from pysim.diagnosis.settings import Settings
from pysim.identify.greybox import Nuisance, NuisanceKind, Simulation
from pysim.types import Record


@dataclass(frozen=True)
class Starts:
    """Starts beside one model.

    Args:
        beside: the model, compared by orbits (False) or by transients (True).
        simulation: of the refits.
        near: whether it leaves so little over the floor that first-order gains tell what a refit could gain.
        settings: of the search.
    """

    beside: Callable[[bool], FinalFit]
    simulation: Simulation
    near: bool
    settings: Settings
    _here: dict[bool, FinalFit] = field(default_factory=dict, init=False, repr=False)

    def here(self, transient: bool) -> FinalFit:
        """The model as rivals are compared with it and simulated."""
        if transient not in self._here:
            fit = self.beside(transient)
            if fit.simulation != self.simulation:
                fit = begin(fit.candidate, fit.values, self.simulation, fit)
            self._here[transient] = fit
        return self._here[transient]

    def like(self, rival: FinalFit) -> FinalFit:
        """The model compared and simulated as a rival is, which may have ended by finer simulations."""
        fit = self.beside(rival.candidate.transient)
        return fit if fit.simulation == rival.simulation else self.here(rival.candidate.transient)

    def runners(self, sizes: Sequence[Screened], sensors: Sequence[FinalFit], tried: int) -> list[Runner]:
        """What is refitted, the most promising first; near the floor only what may pass the test of its gain.

        Args:
            sizes: effects at every size, the best first.
            sensors: the model with a sensor's error more, each.
            tried: all that is looked at, for what chance could do.
        """
        screened = best_of_each(sizes)
        found = [self._of_effect(one) for one in screened]
        found += [self._of_sensor(fit) for fit in sensors]
        if not self.near:  # the model's parameters may be those of a wrong optimum
            return found + self._nearest(sizes)
        lefts = [rivals.of(self.beside(one.candidate.transient)) for one in screened]
        worth = [
            (len(one.effect.parameters), rivals.effective(one.leaves(left), one.change))
            for one, left in zip(screened, lefts, strict=True)
        ]
        worth += [(1, 1.0)] * len(sensors)
        samples, size = rivals.samples(self.beside(False)), self.beside(False).candidate.size
        chances = [
            tried * rivals.p_value(one.most, df, samples, size + df, inflated)
            for one, (df, inflated) in zip(found, worth, strict=True)
        ]
        return [one for one, chance in zip(found, chances, strict=True) if chance < self.settings.false_alarm]

    def _nearest(self, sizes: Sequence[Screened]) -> list[Runner]:
        """Effects that do not begin off, at the size nearest the measurements at the model's own parameters."""
        best: dict[str, tuple[float, Candidate, Values]] = {}
        for one in sizes:
            name, candidate, values = one.effect.name, one.candidate, own_values(one)
            if one.start is not None or (name in best and best[name][2] == values):
                continue
            cost = cost_at(candidate, values, self.simulation, self.beside(candidate.transient))
            if math.isfinite(cost) and (name not in best or cost < best[name][0]):
                best[name] = cost, candidate, values
        return [self._runner(candidate, values, math.inf) for _, candidate, values in best.values()]

    def _most(self, gain: float) -> float:
        """Nats that a refit can gain at most."""
        return self.settings.first_order_error * gain if self.near else math.inf

    def _runner(self, candidate: Candidate, values: Values, most: float) -> Runner:
        start = partial(begin, candidate, values, self.simulation, self.beside(candidate.transient))
        return Runner(start, self.here(candidate.transient).point.cost, most)

    def _of_effect(self, one: Screened) -> Runner:
        """As good as off, beside the present model, whose slopes there tell how far to go; at the size that looked best
        where off has no slopes."""
        start, most = one.start, self._most(one.gain)
        if start is None:
            return self._runner(one.candidate, one.values, most)
        return Runner(lambda: start, one.before, most, beside=True)

    def _of_sensor(self, fit: FinalFit) -> Runner:
        """A sensor's error gains no more than it promises beyond what the model promises without it."""
        here = self.here(fit.candidate.transient)
        itself = begun(here.candidate, here.point, here.simulation, here.evaluate)
        return Runner(lambda: fit, here.point.cost, self._most(itself.expected - fit.expected), beside=True)


def with_sensor_errors(present: FinalFit, models: Models) -> list[FinalFit]:
    """The present model with one sensor's error more, each where the present model stands.

    An error that does the same as an effect is a tie with it. All share one simulation: they change no run.
    """
    own, point, simulation = present.candidate, present.point, present.simulation
    free = [one for one in _nuisances(models) if one not in own.nuisances]
    candidates = [models.of(own.effects, (*own.nuisances, one), transient=own.transient) for one in free]
    if own.has_events:  # slopes are those of secants
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
    """Gain, offset and delay of every signal that is compared over time or in stepped sines; drift with a clock."""
    session = models.session
    settings, dataset = session.treatment.noise, session.dataset
    logs = [record for record in dataset.logs() if record.use == "fit" and isinstance(record.data, Record)]
    for signal in dataset.signals:
        own = [r.data for r in logs if isinstance(r.data, Record) and signal.name in r.data.names]
        if signal.role != "output" or not own:
            continue
        scale = max(float(abs(record[signal.name]).max()) for record in own) or 1.0
        interval = max(float((record.time[-1] - record.time[0]) / max(record.time.size - 1, 1)) for record in own)
        yield Nuisance(NuisanceKind.GAIN, dataset.name, signal.name, settings.gain_sd)
        yield Nuisance(NuisanceKind.OFFSET, dataset.name, signal.name, settings.offset_sd * scale)
        yield Nuisance(NuisanceKind.DELAY, dataset.name, signal.name, settings.delay_sd * interval)
        begins = {record.begin for record in logs if record.begin is not None}
        if len(begins) > 1:
            span = max(begins) - min(begins)
            yield Nuisance(NuisanceKind.DRIFT, dataset.name, signal.name, settings.drift_sd * scale / span)
