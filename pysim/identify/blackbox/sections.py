"""A denominator as a product of second-order sections: well conditioned at any order, and stability means bounds only.

The numbers are a of s + a first, if the order is odd, then pairs (a_1, a_0) of s^2 + a_1 s + a_0. A section has two
real poles or a conjugate pair, with a smooth transition between both. Its poles are left of the imaginary axis if and
only if its numbers are positive.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]


def from_poles(poles: Complex) -> Array:
    """Section numbers (n_p,) of poles that are real or conjugate pairs; neighbouring real ones share a section."""
    above = poles[poles.imag > 0]
    real = np.sort(poles[poles.imag == 0].real)
    numbers = [-real[:1]] if real.size % 2 else []
    pairs = real[real.size % 2 :].reshape(-1, 2)
    numbers += [np.array([-pair.sum(), pair.prod()]) for pair in pairs]
    numbers += [np.array([-2 * pole.real, abs(pole) ** 2]) for pole in above]
    return np.concatenate(numbers) if numbers else np.empty(0)


def to_poles(numbers: Array) -> Complex:
    """The poles (n_p,), in the order of the sections."""
    single, pairs = _split(numbers)
    root = np.sqrt(pairs[:, 0].astype(np.complex128) ** 2 - 4 * pairs[:, 1])
    # the larger root is computed without cancellation, the smaller one from the product of both
    large = -(pairs[:, 0] + np.where(pairs[:, 0] >= 0, 1, -1) * root) / 2
    safe = np.where(large == 0, 1, large)
    small = np.where(np.abs(root.imag) > 0, np.conj(large), pairs[:, 1] / safe)
    return np.concatenate([-single.astype(np.complex128), np.column_stack([small, large]).ravel()])


def polynomial(numbers: Array) -> Array:
    """Coefficients (n_p + 1,) of the monic denominator, from the highest power down."""
    product = np.ones(1)
    for factor in _factors(numbers):
        product = np.convolve(product, factor)
    return product


def polynomial_slopes(numbers: Array) -> Array:
    """d coefficients / d numbers, (n_p + 1, n_p)."""
    factors = _factors(numbers)
    columns = []
    for i, factor in enumerate(factors):
        others = np.ones(1)
        for other in factors[:i] + factors[i + 1 :]:
            others = np.convolve(others, other)
        for power in range(factor.size - 2, -1, -1):
            column = np.zeros(numbers.size + 1)
            column[numbers.size - power - others.size + 1 : numbers.size - power + 1] = others
            columns.append(column)
    return np.column_stack(columns) if columns else np.empty((1, 0))


def values_and_slopes(numbers: Array, s: Complex) -> tuple[Complex, Complex]:
    """The denominator at s (n_f,), and derivatives of its logarithm by the numbers, (n_f, n_p)."""
    single, pairs = _split(numbers)
    first = s[:, None] + single
    second = s[:, None] ** 2 + pairs[:, 0] * s[:, None] + pairs[:, 1]
    slopes = np.empty((s.size, numbers.size), dtype=np.complex128)
    slopes[:, : single.size] = 1 / first
    slopes[:, single.size :: 2] = s[:, None] / second
    slopes[:, single.size + 1 :: 2] = 1 / second
    return first.prod(axis=1) * second.prod(axis=1), slopes


def pole_slopes(numbers: Array) -> Complex:
    """d poles / d numbers, (n_p, n_p); infinite for two equal poles in one section."""
    single, _ = _split(numbers)
    poles = to_poles(numbers)
    slopes = np.zeros((numbers.size, numbers.size), dtype=np.complex128)
    slopes[: single.size, : single.size] = -np.eye(single.size)
    for k in range(single.size, numbers.size, 2):
        for row in (k, k + 1):
            inside = 2 * poles[row] + numbers[k]
            pair = [np.inf, np.inf] if inside == 0 else [-poles[row] / inside, -1 / inside]
            slopes[row, k : k + 2] = pair
    return slopes


def _split(numbers: Array) -> tuple[Array, Array]:
    odd = numbers.size % 2
    return numbers[:odd], numbers[odd:].reshape(-1, 2)


def _factors(numbers: Array) -> list[Array]:
    single, pairs = _split(numbers)
    return [np.array([1.0, a]) for a in single] + [np.array([1.0, *pair]) for pair in pairs]
