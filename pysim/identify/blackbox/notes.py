"""Notes on a fitted transfer function: reasons why it may be wrong or less than asked for."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from pysim.identify.blackbox.refine import Minimum
from pysim.identify.blackbox.result import TransferFunctionFit
from pysim.types import Note, NoteCode

_HALF_A_TURN = 0.5  # turns


def notes_on(fit: TransferFunctionFit, minimum: Minimum) -> list[Note]:
    """Notes on the search, the bounds, the stability and superfluous numbers; none for a good fit."""
    return [*_quality(fit, minimum), *_bounds(fit, minimum), *_excess(fit)]


def _quality(fit: TransferFunctionFit, minimum: Minimum) -> Iterator[Note]:
    if not minimum.converged:
        yield Note(NoteCode.SEARCH_GAVE_UP, {"evaluations": minimum.evaluations})
    if fit.noise_known and fit.scatter > 1:
        yield Note(NoteCode.BEYOND_NOISE, {"factor": float(np.sqrt(fit.scatter))})


def _bounds(fit: TransferFunctionFit, minimum: Minimum) -> Iterator[Note]:
    structure, dead_time = fit.structure, fit.function.dead_time
    if structure.dead_time_max is not None and minimum.at_bound[-1]:
        middle = (structure.dead_time + structure.dead_time_max) / 2
        end = "smallest" if dead_time < middle else "largest"
        yield Note(NoteCode.DEAD_TIME_AT_BOUND, {"end": end, "seconds": dead_time})
    gaps = np.diff(fit.data.frequency)
    if gaps.size and dead_time * float(np.min(gaps)) > _HALF_A_TURN:
        yield Note(NoteCode.DEAD_TIME_AMBIGUOUS, {"seconds": dead_time})
    if structure.stable and bool(np.any(minimum.at_bound[: structure.poles])):
        yield Note(NoteCode.EDGE_OF_STABILITY, {})
    for i in fit.at_origin:
        yield Note(NoteCode.INTEGRATOR, {"frequency": fit.poles[i].frequency_hz})
    unstable = sum(pole.value.real >= 0 for i, pole in enumerate(fit.poles) if i not in fit.at_origin)
    if unstable:
        yield Note(NoteCode.UNSTABLE, {"count": unstable, "poles": len(fit.poles)})


def _excess(fit: TransferFunctionFit) -> Iterator[Note]:
    if fit.undetermined:
        yield Note(NoteCode.NOT_DETERMINED, {"names": ", ".join(fit.undetermined)})
    for i, j in fit.cancelling:
        pole, zero = fit.poles[i], fit.zeros[j]
        yield Note(NoteCode.CANCELLING, {"pole": pole.frequency_hz, "zero": zero.frequency_hz})
