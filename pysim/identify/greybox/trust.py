"""When a fit is not to be trusted: what it shows itself, from its residuals, bounds and correlations."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence

import numpy as np
from numpy.typing import NDArray

from pysim.identify.greybox.observation import Run
from pysim.identify.greybox.settings import TrustSettings
from pysim.types import Estimate, Fit, FitOutcome, Note, NoteCode, RecordFit

_SETTINGS = TrustSettings()
_SAID = (NoteCode.NOT_AT_REST, NoteCode.NOT_SIMULATED)


def fit_warnings(fit: Fit) -> tuple[Note, ...]:
    """Why the parameters or their intervals may be wrong; nothing of a fit that can be trusted.

    The residuals are far above the noise, a parameter stands at a bound, parameters are nearly interchangeable, a log
    did not begin at rest, a record could not be simulated, or the search ended before it had converged.
    """
    found = [*_poor(fit), *(note for note in fit.notes if note.code in _SAID)]
    found += [at_bound(one) for one in fit.estimates if one.at]
    for one in fit.undetermined:
        found.append(Note(NoteCode.INTERCHANGEABLE, {**one.exponents, "@spread": one.spread}))
    found += _correlated(fit)
    if fit.outcome in (FitOutcome.STALLED, FitOutcome.ITERATION_LIMIT):
        found.append(Note(NoteCode.SEARCH_GAVE_UP, {"evaluations": float(fit.iterations)}))
    return tuple(dict.fromkeys(found))


def at_bound(one: Estimate) -> Note:
    """That a parameter stopped at its bound."""
    bound = one.lower if one.at == "lower" else one.upper
    return Note(NoteCode.AT_BOUND, {"parameter": one.name, "bound": bound, "value": one.value, "unit": one.unit})


def _poor(fit: Fit) -> Iterator[Note]:
    """The worst signal, where its residual on the fitted logs is more than noise."""
    squares: dict[str, list[float]] = {}
    for record in fit.records:
        if record.use == "fit":
            for name, value in record.rms.items():
                squares.setdefault(name, []).append(value**2)
    sizes = {name: math.sqrt(float(np.mean(own))) for name, own in squares.items()}
    worst = max(sizes, key=lambda name: sizes[name], default="")
    if worst and sizes[worst] > _SETTINGS.poor:
        yield Note(NoteCode.POOR_FIT, {"signal": worst, "factor": sizes[worst]})
    elif not worst and fit.misfit > _SETTINGS.poor:
        yield Note(NoteCode.POOR_FIT, {"signal": "the responses", "factor": fit.misfit})


def _correlated(fit: Fit) -> Iterator[Note]:
    """Pairs of which neither is well known, beyond those in the directions that are said already."""
    said = [set(one.exponents) for one in fit.undetermined]
    names, matrix = [one.name for one in fit.estimates], fit.correlation
    vague = [one.std > _SETTINGS.vague * abs(one.value) for one in fit.estimates]
    for i, j in zip(*np.triu_indices(len(names), 1), strict=True):
        is_close = vague[i] and vague[j] and abs(matrix[i, j]) > _SETTINGS.correlated
        if is_close and not any({names[i], names[j]} <= one for one in said):
            pair: dict[str, float | str] = {"first": names[i], "second": names[j], "correlation": float(matrix[i, j])}
            yield Note(NoteCode.CORRELATED, pair)


def not_at_rest(
    runs: Sequence[Run], states: Iterable[NDArray[np.float64] | None], records: Sequence[RecordFit]
) -> list[Note]:
    """Logs that did not begin at rest although they were taken so.

    Args:
        runs: of the fitted logs.
        states: per run, (n_s,) how far its free states begin from rest; None where none is free.
        records: every log beside the fitted model.
    """
    found = {one.record for one, offset in zip(runs, states, strict=False) if _is_away(one, offset)}
    found |= {one.source for one in records if not one.harmonics and _begins_apart(one)}
    return [Note(NoteCode.NOT_AT_REST, {"record": name}) for name in sorted(found)]


def _is_away(run: Run, offset: NDArray[np.float64] | None) -> bool:
    """By a share of a state's range; where its state is free anyway nothing was taken to rest."""
    if offset is None or not run.free.size:
        return False
    ranges = math.sqrt(12) * run.initial[run.free]
    return bool(np.any(np.isfinite(ranges) & (np.abs(offset[: run.free.size]) > _SETTINGS.away * ranges)))


def _begins_apart(record: RecordFit) -> bool:
    """Whether the first samples are much further from the model than the others, and than noise."""
    values = record.residual.values
    count = max(math.ceil(_SETTINGS.beginning * len(values)), _SETTINGS.fewest)
    if len(values) < 4 * count:
        return False
    first, rest = (np.sqrt(np.mean(part**2, axis=0)) for part in (values[:count], values[count:]))
    return bool(np.any(first > _SETTINGS.apart * np.maximum(rest, 1.0)))
