"""Poles and zeros that cancel each other within the accuracy of the data."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.special import chdtri

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]

_LEVEL = 0.95
_CLOSE = 1e-3  # relative distance below which a pair cancels at any noise


def cancellations(poles: Complex, zeros: Complex, pole_spread: Complex, zero_spread: Complex) -> list[tuple[int, int]]:
    """Indices of pairs (pole, zero) that cancel; of conjugate roots, those above the real axis.

    A pair cancels if the two differ by a thousandth of their magnitude. It also cancels if their difference is within
    its 95 percent confidence region around zero (Wald test), and no larger than the pole's magnitude.

    Args:
        poles, zeros: (n_p,) and (n_z,) rad/s.
        pole_spread, zero_spread: (n_p, r) and (n_z, r) complex factors of their joint covariance.
    """
    candidates = []
    for i, pole in enumerate(poles):
        for j, zero in enumerate(zeros):
            if pole.imag < 0 or zero.imag < 0 or (pole.imag == 0) != (zero.imag == 0):
                continue
            apart = abs(pole - zero)
            with np.errstate(invalid="ignore"):  # both may be undetermined
                noise = pole_spread[i] - zero_spread[j]
            if apart <= _CLOSE * abs(pole) or (apart <= abs(pole) and within_noise(pole - zero, noise)):
                candidates.append((apart, i, j))
    taken: list[tuple[int, int]] = []
    for _, i, j in sorted(candidates):
        if all(i != k and j != n for k, n in taken):
            taken.append((i, j))
    return taken


def within_noise(distance: complex, spread: Complex) -> bool:
    """Whether a distance is within its 95 percent region around zero; spread (r,): complex factor of its covariance."""
    rows = np.vstack([spread.real, spread.imag]) if distance.imag or np.any(spread.imag) else spread.real[None, :]
    if not np.isfinite(rows).all():
        return True
    gap = np.array([distance.real, distance.imag])[: rows.shape[0]]
    size = float(gap @ np.linalg.pinv(rows @ rows.T) @ gap)
    return size < float(chdtri(rows.shape[0], 1 - _LEVEL)) and bool(np.any(rows))
