"""The error history: residuals of each model on every log, over the noise floors that all models share."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from pysim.diagnosis.refit import FinalFit
from pysim.diagnosis.session import TEST, Session
from pysim.identify.failures import failures
from pysim.identify.greybox import Simulation
from pysim.identify.greybox.comparison import Compared, compared, with_noise
from pysim.identify.greybox.residuals import Channel
from pysim.identify.greybox.uncertainty import uncertainty
from pysim.types import Deviation, Direction, Estimate, Note, RecordFit
from pysim.types.answer import ErrorStep, NoiseFloor, SensorError

Array = NDArray[np.float64]


def error_step(
    name: str,
    fit: FinalFit,
    session: Session,
    floors: Mapping[Channel, NoiseFloor],
    simulation: Simulation,
    *,
    fitted: bool = True,
) -> tuple[ErrorStep, tuple[Note, ...]]:
    """Errors and estimates of one model on every log, the held-out ones too; with notes on logs that did not run.

    Args:
        floors: noise floor of each channel (data set and signal), the unit of all errors.
        simulation: solver settings of the runs; those of the fit itself may be finer.
        fitted: whether the model was fitted; the nominal model has no intervals.
    """
    parts = [beside(fit, simulation)]
    if session.unseen is not None:
        parts.append(_unseen(fit, session, simulation))
    noise = {channel: floor.sd for channel, floor in floors.items()}
    pairs = [(record, own) for part, own in zip(parts, session.numbers, strict=False) for record in part.records]
    records = [with_noise(replace(record, index=own[record.index]), noise) for record, own in pairs]
    responses = tuple(response for part in parts for response in part.responses)
    deviations = [d for record in records for own in record.deviations.values() for d in own]
    deviations += [d for response in responses for d in response.comparison.deviations]
    lost = sum(part.lost for part in parts)
    estimates, open_ = held_still(fit) if fitted else ((), ())
    step = ErrorStep(
        step=name,
        fit=root_mean_square(records, "fit"),
        validate=root_mean_square(records, "validate"),
        test=root_mean_square(records, TEST),
        criteria={d.criterion.symbol: d.value for d in worst(deviations)},
        passes=not lost and all(d.passes for d in deviations),
        cost=fit.point.cost,
        not_simulated=lost,
        estimates=estimates,
        undetermined=open_,
        sensors=tuple(SensorError(one.kind.value, one.dataset, one.signal, size) for one, size in fit.sensor_errors),
        records=tuple(records),
        responses=responses,
        failures=failures(records, session.dataset),
    )
    return step, tuple(note for part in parts for note in part.notes)


def held_still(fit: FinalFit) -> tuple[tuple[Estimate, ...], tuple[Direction, ...]]:
    """Estimates with one parameter held of each direction that the data leave exactly undetermined; and the directions.

    For example, if all forces can be scaled together, none has a finite interval until one of them is held.
    """
    space, point, held = fit.candidate.space, fit.point, []
    found, slopes = uncertainty(space, point), point.jacobian.copy()
    own = {name for name, key in zip(space.keys, fit.candidate.keys, strict=True) if isinstance(key, str)}
    for direction in found.known.directions:
        name = next((name for name in direction.exponents if name in own), "")
        if np.isinf(direction.spread) and name:
            slopes[:, space.keys.index(name)] = 0.0
            order = dict(sorted(direction.exponents.items(), key=lambda item: item[0] != name))
            held.append(replace(direction, exponents=order))
    if not held:
        return found.estimates, ()
    return uncertainty(space, replace(point, jacobian=slopes)).estimates, tuple(held)


def root_mean_square(records: Sequence[RecordFit], use: str) -> float | None:
    """Root mean square of all residuals over their floors, of the records of one use; None if there are none."""
    values = [record.residual.values.ravel() for record in records if record.use == use]
    return float(np.sqrt(np.nanmean(np.concatenate(values) ** 2))) if values else None


def beside(fit: FinalFit, simulation: Simulation) -> Compared:
    """The model compared with every log that is fitted or used to choose (validation data)."""
    residuals = fit.candidate.residuals(simulation)
    carried = dict(zip(map(id, residuals.runs), fit.point.carried.states, strict=False))
    return compared(fit.candidate.problem, fit.point.x, simulation, carried, errors=fit.sensor_errors)


def _unseen(fit: FinalFit, session: Session, simulation: Simulation) -> Compared:
    problem = session.unseen_beside(fit.candidate.model, fit.candidate.space)
    found = compared(problem, fit.point.x, simulation, errors=fit.sensor_errors)
    return replace(found, records=tuple(replace(record, use=TEST) for record in found.records), responses=())


def worst(deviations: Sequence[Deviation]) -> Iterator[Deviation]:
    """The largest deviation of each criterion."""
    for symbol in dict.fromkeys(d.criterion.symbol for d in deviations):
        yield max((d for d in deviations if d.criterion.symbol == symbol), key=lambda d: d.value)
