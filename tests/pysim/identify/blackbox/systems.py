"""Systems with known answers, exact and noisy."""

from __future__ import annotations

import numpy as np

from pysim.identify import TransferFunction
from pysim.identify.blackbox import ComplexResponse


def from_roots(zeros: list[complex], poles: list[complex], lead: float, dead_time: float = 0.0) -> TransferFunction:
    """lead prod(s - zero) / prod(s - pole) exp(-dead_time s); roots in rad/s, conjugates included."""
    above, below = (np.atleast_1d(np.poly(roots)).real for roots in (np.array(zeros), np.array(poles)))
    return TransferFunction(tuple((lead * above).tolist()), tuple(below.tolist()), dead_time)


def exact(function: TransferFunction, frequency: np.ndarray) -> ComplexResponse:
    """Without noise."""
    return ComplexResponse(frequency, function.at(frequency), origin="closed form")


def noisy(function: TransferFunction, frequency: np.ndarray, noise: float, seed: int) -> ComplexResponse:
    """Independent Gaussian noise of that standard deviation on real and imaginary part, and its covariance."""
    draw = np.random.default_rng(seed).standard_normal((2, frequency.size)) * noise
    covariance = np.tile(noise**2 * np.eye(2), (frequency.size, 1, 1))
    return ComplexResponse(frequency, function.at(frequency) + draw[0] + 1j * draw[1], covariance)


def pairs(*roots: complex) -> list[complex]:
    """Each with its conjugate."""
    return [value for root in roots for value in (root, complex(root).conjugate())]
