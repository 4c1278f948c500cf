"""What to know before using a fitted transfer function, in words."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from pysim.identify.blackbox.refine import Minimum
from pysim.identify.blackbox.result import TransferFunctionFit

_HALF_A_TURN = 0.5  # turns


def notes_on(fit: TransferFunctionFit, minimum: Minimum) -> list[str]:
    """Sentences; none for a fit that is what was asked for."""
    return [*_quality(fit, minimum), *_bounds(fit, minimum), *_excess(fit, fit.cancelling)]


def _quality(fit: TransferFunctionFit, minimum: Minimum) -> list[str]:
    notes = []
    if not minimum.converged:
        notes.append(f"The search gave up after {minimum.evaluations} evaluations; the result may not be the best.")
    if fit.noise_known and fit.scatter > 1:
        factor = _times(np.sqrt(fit.scatter))
        notes.append(
            f"The residuals are {factor} times what the noise explains: the structure does not hold "
            "all of the response, or the system is not linear. Intervals are widened by that factor, which covers "
            "random deviations and not a wrong structure."
        )
    return notes


def _times(factor: float) -> str:
    """Two digits, without powers of ten."""
    return f"{factor:.1f}" if factor < 10 else f"{factor:.0f}"


def _bounds(fit: TransferFunctionFit, minimum: Minimum) -> list[str]:
    notes, structure = [], fit.structure
    if structure.dead_time_max is not None and minimum.at_bound[-1]:
        middle = (structure.dead_time + structure.dead_time_max) / 2
        end = "smallest" if fit.function.dead_time < middle else "largest"
        notes.append(
            f"The dead time ended at the {end} that was allowed, {fit.function.dead_time:.4g} s, and counts as known."
        )
    gaps = np.diff(fit.data.frequency)
    if gaps.size and fit.function.dead_time * float(np.min(gaps)) > _HALF_A_TURN:
        notes.append(
            f"A dead time of {fit.function.dead_time:.4g} s turns the phase by more than half a turn between any two "
            "measured frequencies: these data cannot tell it from others. It is meant in seconds."
        )
    if structure.stable and bool(np.any(minimum.at_bound[: structure.poles])):
        notes.append(
            "A pole ended at the edge of stability: without that condition the data ask for an unstable one, or for an "
            "integrator. It counts as known there, so the intervals are too narrow."
        )
    for i in fit.at_origin:
        notes.append(
            f"The pole at {fit.poles[i].frequency_hz:.2g} Hz cannot be told from an integrator: it is slower than any "
            "measured frequency. The gain at rest is not determined; the response within the measured band is."
        )
    unstable = sum(pole.value.real >= 0 for i, pole in enumerate(fit.poles) if i not in fit.at_origin)
    if unstable:
        notes.append(
            f"{unstable} of {len(fit.poles)} poles are not left of the imaginary axis: not stable. A system that "
            "answers steadily is; ask for a stable fit."
        )
    return notes


def _excess(fit: TransferFunctionFit, pairs: Sequence[tuple[int, int]]) -> list[str]:
    notes = []
    if fit.undetermined:
        notes.append(
            f"The data do not determine {', '.join(fit.undetermined)}: other values give the same response. Ask for "
            "fewer poles and zeros."
        )
    for i, j in pairs:
        pole, zero = fit.poles[i], fit.zeros[j]
        notes.append(
            f"The pole at {pole.frequency_hz:.4g} Hz and the zero at {zero.frequency_hz:.4g} Hz cannot be told apart "
            "and cancel: the data support fewer of both."
        )
    return notes
