"""Start values: poles from iterated linear least squares, for several dead times and several first guesses.

Each step solves the linearised problem of Sanathanan and Koerner (IEEE Trans. Automatic Control 8, 1963): it minimises
numerator - denominator * measured, over the denominator of the step before, as vector fitting does (Gustavsen and
Semlyen, IEEE Trans. Power Delivery 14, 1999). The numbers of poles and zeros stay as given. Numerator and denominator
are polynomials that are orthonormal on the weighted points, so that high orders stay well conditioned.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from pysim.identify.blackbox.krylov import krylov_basis
from pysim.identify.blackbox.objective import Problem
from pysim.identify.blackbox.sections import from_poles, to_poles, values_and_slopes

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]

OPENING, STEPS = 4, 12
_SAME = 1e-3  # relative difference of costs, and of unknowns, below which two starts count as equal
_SETTLED = 1e-5  # relative change of the cost at which the iteration ends

_Start = tuple[float, Array]  # cost and unknowns


def starts(problem: Problem, count: int) -> list[Array]:
    """The best `count` different starts, unknowns (n,) each, best first."""
    stable = problem.structure.stable
    guesses = list(_guesses(problem))
    opened = [_walk(problem, poles, delay, stable, OPENING) for delay in _delays(problem) for poles in guesses]
    opened.sort(key=_cost)
    found = []
    for _, unknowns in opened[: max(2 * count, len(guesses))]:
        poles, delay = to_poles(unknowns[: problem.structure.poles]), problem.delay(unknowns)
        found.append(_walk(problem, poles, delay, stable, STEPS))
        if np.any(found[-1][1][: problem.structure.poles] < 0):  # once more with stable poles
            found.append(_walk(problem, _mirror(poles), delay, True, STEPS))
    return _different(sorted(found, key=_cost), count)


def _cost(start: _Start) -> float:
    return start[0]


def _different(found: list[_Start], count: int) -> list[Array]:
    chosen: list[_Start] = []
    for cost, unknowns in found:
        if all(abs(cost - other) > _SAME * other or _apart(unknowns, known) for other, known in chosen):
            chosen.append((cost, unknowns))
    return [unknowns for _, unknowns in chosen[:count]]


def _apart(a: Array, b: Array) -> bool:
    return bool(np.max(np.abs(a - b), initial=0) > _SAME * np.max(np.abs(b), initial=0))


def _delays(problem: Problem) -> Array:
    """Dead times to try, in units of 1 / scale, in steps of a quarter period of the highest frequency; at most 60."""
    structure = problem.structure
    low = structure.dead_time * problem.scale
    if structure.dead_time_max is None:
        return np.array([low])
    high = structure.dead_time_max * problem.scale
    quarter = np.pi / 2 / problem.s[-1].imag
    return np.linspace(low, high, int(np.clip(np.ceil((high - low) / quarter) + 1, 4, 60)))


def _walk(problem: Problem, poles: Complex, delay: float, mirrored: bool, steps: int) -> _Start:
    """The best unknowns of up to `steps` iterations; `mirrored` moves unstable poles to the left at every step."""
    best: _Start = (np.inf, np.empty(0))
    for _ in range(steps):
        unknowns = _unknowns(problem, poles, delay)
        cost = problem.evaluate(unknowns).cost
        settled = abs(cost - best[0]) <= _SETTLED * cost
        best = min(best, (cost, unknowns), key=_cost)
        moved = None if settled or not poles.size else _relocate(problem, unknowns, delay)
        if moved is None:
            break
        poles = _mirror(moved) if mirrored else moved
    return best


def _mirror(poles: Complex) -> Complex:
    return -np.abs(poles.real) + 1j * poles.imag


def _unknowns(problem: Problem, poles: Complex, delay: float) -> Array:
    numbers = from_poles(poles)
    return np.append(numbers, delay) if problem.structure.delayed else numbers


def _guesses(problem: Problem) -> Iterator[Complex]:
    """First guesses: lightly damped pairs, then real poles, in equal ratios over the band; then evenly spaced pairs."""
    n, omega = problem.structure.poles, problem.s.imag
    pairs = np.geomspace(omega[0], omega[-1], n // 2 + 2)[1:-1] if n >= 2 else np.empty(0)
    odd = np.full(n % 2, -1.0 + 0j)
    yield np.concatenate([odd, *(w * np.array([-0.05 - 1j, -0.05 + 1j]) for w in pairs)])
    if n:
        yield -np.geomspace(omega[0], omega[-1], n + 2)[1:-1].astype(np.complex128)
    if n >= 4:
        even = np.linspace(omega[0], omega[-1], n // 2 + 2)[1:-1]
        yield np.concatenate([odd, *(w * np.array([-0.05 - 1j, -0.05 + 1j]) for w in even)])


def _relocate(problem: Problem, unknowns: Array, delay: float) -> Complex | None:
    """One linear step: poles of the denominator for which measured * denominator is closest to a numerator.

    Both are in spaces with orthonormal columns, so the closest pair is at the smallest angle between these spaces.
    None if a pole would be infinite."""
    n = problem.structure.poles
    denominator, _ = values_and_slopes(unknowns[:n], problem.s)
    above = krylov_basis(np.exp(-delay * problem.s) / denominator, problem.s, problem.structure.zeros, problem.roots)
    below = krylov_basis(problem.values / denominator, problem.s, n, problem.roots)
    _, _, turned = np.linalg.svd(above.white.T @ below.white)
    weights = turned[0]
    if abs(weights[-1]) < 1e-14 or not np.isfinite(weights).all():
        return None  # a pole at infinity
    return below.roots(weights)
