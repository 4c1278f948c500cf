"""Errors of sensors as rivals of effects: where one does the same as an effect, the two are a tie."""

from __future__ import annotations

from collections.abc import Iterator

from pysim.diagnosis.candidate import Models
from pysim.diagnosis.refit import FinalFit, begin, begun, exact
from pysim.identify.greybox import Nuisance, NuisanceKind
from pysim.types import Record


def with_sensor_errors(present: FinalFit, models: Models) -> list[FinalFit]:
    """The present model with one sensor's error more, each where the present model stands.

    They share one simulation: a sensor's error changes no run.
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
