"""Choice of order and width of the local polynomials for a record: a compromise between bias and variance."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from pysim.identify.multisine.local_fit import LocalFit
from pysim.identify.multisine.local_polynomial import Complex, LocalPolynomial, prepare, solve
from pysim.types import BadInput, Record

CANDIDATES = tuple(LocalPolynomial(r, n) for r in (2, 4) for n in (4, 6, 9, 14, 20, 30) if 2 * n + 1 > 2 * (r + 1) + 2)


@dataclass(frozen=True)
class WindowChoice:
    """Settings, and their mean square prediction error of a left-out line, over that of the best candidate."""

    settings: LocalPolynomial
    relative_error: float


def rank_local_polynomials(
    record: Record,
    columns: Sequence[str],
    *,
    band: tuple[float, float] | None = None,
    candidates: Sequence[LocalPolynomial] = CANDIDATES,
) -> tuple[WindowChoice, ...]:
    """Candidates from best to worst, by the prediction error of the middle line of every window when it is left out.

    A window that is too wide predicts badly due to bias, a narrow one due to variance. The errors are weighted by the
    residual variance of the first candidate, since noise may depend on frequency.

    Args:
        record, columns, band: as `local_polynomial_approximation`.
        candidates: settings to compare; those whose window does not fit into the record are left out.
    Raises:
        BadInput: as `local_polynomial_approximation`, or no candidate.
    Source: leave-one-out prediction by the leverage of each line, as in D. M. Allen, Technometrics 16 (1974), 125-127.
    """
    if not candidates:
        raise BadInput("local polynomial: there is no candidate to rank; give at least one")
    spectra = prepare(record, columns, band, min(candidates, key=lambda settings: settings.half_width))
    ranked: list[tuple[float, LocalPolynomial]] = []
    weight = None
    for settings in candidates:
        if spectra.drive.size < 2 * settings.half_width + 1:
            continue
        fit = solve(spectra.drive, spectra.answers[:, -1:], spectra.chosen, settings)
        miss = _left_out(fit, spectra.drive[spectra.chosen], spectra.answers[spectra.chosen, -1], settings)
        weight = 1 / np.maximum(fit.residual[:, 0, 0].real, 1e-300) if weight is None else weight
        ranked.append((float(np.mean(np.abs(miss) ** 2 * weight)), settings))
    ranked.sort(key=lambda pair: pair[0])
    best = ranked[0][0]
    return tuple(WindowChoice(settings, error / best if best > 0 else 1.0) for error, settings in ranked)


def _left_out(fit: LocalFit, drive: Complex, answer: Complex, settings: LocalPolynomial) -> Complex:
    """(n,) middle line of each window less its prediction from all other lines."""
    transient = settings.order + 1
    row = np.zeros((drive.size, 2 * transient), dtype=np.complex128)
    row[:, 0], row[:, transient] = drive, 1.0
    leverage = np.einsum("ki,kij,kj->k", row, fit.gram, np.conj(row)).real
    residual = answer - np.einsum("ki,ki->k", row, fit.coefficients[:, :, 0])
    return np.asarray(residual / np.maximum(1 - leverage, 1e-12))
