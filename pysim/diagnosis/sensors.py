"""Errors of sensors as candidates beside effects: where one does the same as an effect, the two are a tie."""

from __future__ import annotations

from collections.abc import Iterator

from pysim.diagnosis.candidate import Candidate, Models
from pysim.diagnosis.refit import FinalFit
from pysim.identify.greybox import Nuisance, NuisanceKind
from pysim.types import Record


def sensor_candidates(present: FinalFit, models: Models) -> list[Candidate]:
    """The present model with one sensor's error more, each."""
    have = set(present.candidate.nuisances)
    free = [one for one in _nuisances(models) if one not in have]
    return [models.of(present.candidate.effects, (*present.candidate.nuisances, one)) for one in free]


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
