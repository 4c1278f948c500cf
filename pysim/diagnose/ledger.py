"""The ledger of errors: a model beside every record, counted as a reader counts."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from pysim.diagnose.subject import Extended, Subject
from pysim.diagnosis.error_history import worst
from pysim.identify.greybox import Problem, Simulation, Threads
from pysim.identify.greybox.comparison import Compared, compared
from pysim.identify.greybox.parameters import ParameterSpace
from pysim.simulate import Esdirk
from pysim.types import RecordFit
from pysim.types.diagnosis import LedgerStep

Array = NDArray[np.float64]


def beside(subject: Subject, what: Extended, x: Array, workers: int | None = None) -> Compared:
    """Every record beside the model at x (n,) of its space, those held out too.

    Args:
        workers: runs at a time; all cores where None.
    """
    simulation = Simulation(Esdirk(rtol=1e-6, atol=1e-6), Threads(workers))
    held = ParameterSpace.held(what.space.values(x))
    return compared(Problem(what.model, held, subject.targets, subject.floors), np.zeros(0), simulation)


def ledger_step(name: str, found: Compared, cost: float, skips: Mapping[str, float] | None = None) -> LedgerStep:
    """One step of the story from a model beside every record.

    Args:
        skips: of records by name, s at their start that do not count.
    """
    deviations = [d for record in found.records for own in record.deviations.values() for d in own]
    deviations += [d for response in found.responses for d in response.comparison.deviations]
    return LedgerStep(
        name,
        root_mean_square(found.records, "fit", skips or {}),
        root_mean_square(found.records, "validate", skips or {}),
        {d.criterion.symbol: d.value for d in worst(deviations)},
        not found.lost and all(d.passes for d in deviations),
        cost,
        found.lost,
    )


def after(record: RecordFit, skips: Mapping[str, float]) -> RecordFit:
    """A record without what does not count at its start."""
    since = record.measured.time - record.measured.time[0]
    keep = since >= skips.get(record.source, 0.0)
    if keep.all():
        return record
    measured, simulated = (
        replace(part, time=part.time[keep], values=part.values[keep]) for part in (record.measured, record.simulated)
    )
    return replace(record, measured=measured, simulated=simulated)


def root_mean_square(records: Sequence[RecordFit], use: str, skips: Mapping[str, float]) -> float | None:
    """Of all samples that count over their noise, of records of one use; None where there are none."""
    values = [after(record, skips).residual.values.ravel() for record in records if record.use == use]
    return float(np.sqrt(np.mean(np.concatenate(values) ** 2))) if values else None
