"""Warnings about a fit that should not be trusted, from its residuals, bounds, correlations and outcome."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from pysim.identify.greybox.observation import Observation, Run
from pysim.identify.greybox.parameters import ParameterSpace
from pysim.identify.greybox.residuals import Point, WeightedResiduals
from pysim.identify.greybox.settings import TrustSettings
from pysim.types import ErrorStep, Estimate, Fit, FitOutcome, Model, Note, NoteCode, RecordFit

_SETTINGS = TrustSettings()
_SAID = (NoteCode.NOT_AT_REST, NoteCode.NOT_SIMULATED)


def fit_warnings(fit: Fit) -> tuple[Note, ...]:
    """Reasons why the parameters or their intervals may be wrong; none for a fit that can be trusted.

    The residuals are far above the noise, a parameter is at a bound or has none, parameters are nearly interchangeable,
    a log did not begin at rest, a record could not be simulated, or the search ended before it had converged.
    """
    found = [*_poor(fit.records, fit.misfit), *(note for note in fit.notes if note.code in _SAID)]
    found += [*_open(fit), *_correlated(fit)]
    endless = [one.name for one in fit.estimates if math.isinf(one.lower) and math.isinf(one.upper)]
    found += [Note(NoteCode.UNBOUNDED, {"parameters": ", ".join(endless)})] if endless else []
    if fit.outcome in (FitOutcome.STALLED, FitOutcome.ITERATION_LIMIT):
        found.append(Note(NoteCode.SEARCH_GAVE_UP, {"evaluations": float(fit.iterations)}))
    return tuple(dict.fromkeys(found))


def step_warnings(step: ErrorStep) -> tuple[Note, ...]:
    """Reasons why a refit of a diagnosis may be wrong: large residuals, or parameters at bounds or interchangeable."""
    return (*_poor(step.records, 0.0), *_open(step))


def _open(found: Fit | ErrorStep) -> Iterator[Note]:
    """Notes on parameters at a bound, and on parameters that the data do not separate."""
    yield from (at_bound(one) for one in found.estimates if one.at)
    for one in found.undetermined:
        yield Note(
            NoteCode.INTERCHANGEABLE,
            {**one.exponents, "@spread": one.spread, "@low": one.reach[0], "@high": one.reach[1]},
        )


def at_bound(one: Estimate) -> Note:
    """The note that a parameter is at its bound."""
    bound = one.lower if one.at == "lower" else one.upper
    return Note(NoteCode.AT_BOUND, {"parameter": one.name, "bound": bound, "value": one.value, "unit": one.unit})


def _poor(records: Sequence[RecordFit], misfit: float) -> Iterator[Note]:
    """A note if the worst signal's residual in fitted logs is far above its noise; without logs, if `misfit` is."""
    squares: dict[str, list[float]] = {}
    for record in records:
        if record.use == "fit":
            for name, value in record.rms.items():
                squares.setdefault(name, []).append(value**2)
    sizes = {name: math.sqrt(float(np.mean(own))) for name, own in squares.items()}
    worst = max(sizes, key=lambda name: sizes[name], default="")
    if worst and sizes[worst] > _SETTINGS.poor:
        yield Note(NoteCode.POOR_FIT, {"signal": worst, "factor": sizes[worst]})
    elif not worst and misfit > _SETTINGS.poor:
        yield Note(NoteCode.POOR_FIT, {"signal": "the responses", "factor": misfit})


def _correlated(fit: Fit) -> Iterator[Note]:
    """Notes on correlated pairs of badly known parameters, unless an undetermined direction already has both."""
    said = [set(one.exponents) for one in fit.undetermined]
    names, matrix = [one.name for one in fit.estimates], fit.correlation
    vague = [one.std > _SETTINGS.vague * abs(one.value) for one in fit.estimates]
    for i, j in zip(*np.triu_indices(len(names), 1), strict=True):
        is_close = vague[i] and vague[j] and abs(matrix[i, j]) > _SETTINGS.correlated
        if is_close and not any({names[i], names[j]} <= one for one in said):
            pair: dict[str, float | str] = {"first": names[i], "second": names[j], "correlation": float(matrix[i, j])}
            yield Note(NoteCode.CORRELATED, pair)


def not_at_rest(residuals: WeightedResiduals, model: Model, space: ParameterSpace, point: Point) -> list[Note]:
    """Notes on logs that did not begin at rest, although the fit assumed it.

    If initial states are free around rest, their estimates show it. If a log was held at rest, either other initial
    states would explain a large part of its residual, or the residual is much larger at the log's beginning.

    Args:
        residuals: of the fitted logs.
        model, space, point: the fit.
    """
    if any(name in model.abilities.states for name in space.variables):
        return []  # initial states are fitted as parameters
    found, first = [], 0
    for one in residuals.observations:
        own = point.carried.states[first : first + len(one.runs)]
        first += len(one.runs)
        if one.domain == "time" and len(one.runs) == 1 and model.abilities.states:
            run, offset = one.runs[0], own[0] if own else None
            away = _is_away(run, offset) if run.free.size else _is_explained(residuals, one, model, space, point)
            found += [Note(NoteCode.NOT_AT_REST, {"record": run.record})] * away
    return found


def _is_away(run: Run, offset: NDArray[np.float64] | None) -> bool:
    """Whether an estimated initial state is away from rest by a share of its range; unknown states do not count."""
    if offset is None:
        return False
    ranges = math.sqrt(12) * run.initial[run.free]
    return bool(np.any(np.isfinite(ranges) & (np.abs(offset[: run.free.size]) > _SETTINGS.away * ranges)))


def _is_explained(
    residuals: WeightedResiduals, one: Observation, model: Model, space: ParameterSpace, point: Point
) -> bool:
    """Whether free initial states would lower a log's sum of squares much, or its first residuals are much larger."""
    run = replace(one.runs[0], initial=np.full(len(model.abilities.states), math.inf))
    alone = replace(residuals, observations=(one.with_runs([run]),))
    there = alone.evaluate(model, space, point.x, jacobian=False)
    if not there.good:
        return False
    squares = float(there.residual @ there.residual)
    return there.own_gain() > 0.5 * _SETTINGS.explained * squares or _begins_apart(there.residual[run.free.size :])


def _begins_apart(residual: NDArray[np.float64]) -> bool:
    """Whether the first residuals are much larger than the later ones."""
    count = max(math.ceil(_SETTINGS.beginning * residual.size), _SETTINGS.fewest)
    first, rest = (math.sqrt(float(np.mean(part**2))) for part in (residual[:count], residual[count:]))
    return residual.size > 4 * count and first > _SETTINGS.apart * rest
