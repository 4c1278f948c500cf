"""Poles and zeros of a fitted transfer function, with their covariances."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pysim.identify.blackbox import sections
from pysim.identify.blackbox.cancellation import cancellations, within_noise
from pysim.identify.blackbox.objective import Problem
from pysim.identify.blackbox.refine import Minimum
from pysim.identify.blackbox.result import Root
from pysim.identify.blackbox.uncertainty import Spread, zero_slopes
from pysim.identify.transfer_function import TransferFunction

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]


@dataclass(frozen=True)
class Roots:
    """Poles and zeros by rising magnitude.

    Args:
        cancelling: indices of pairs (pole, zero) that cancel.
        at_origin: indices of poles that the data do not separate from integrators.
    """

    poles: tuple[Root, ...]
    zeros: tuple[Root, ...]
    cancelling: tuple[tuple[int, int], ...]
    at_origin: tuple[int, ...]


def roots_of(problem: Problem, minimum: Minimum, function: TransferFunction, doubt: Spread, variance: float) -> Roots:
    """Poles and zeros of the fitted function.

    Args:
        doubt: covariances for data of unit variance.
        variance: factor on these.
    """
    poles = problem.scale * sections.to_poles(minimum.unknowns[: problem.structure.poles])
    order = np.lexsort((poles.imag, np.abs(poles)))
    zeros, count = function.zeros, len(function.numerator)
    first = count - 1 - function.zeros.size  # leading coefficients of zero have no root
    slopes = zero_slopes(np.array(function.numerator[first:]), zeros)
    with np.errstate(invalid="ignore"):
        pole_rows, zero_rows = doubt.poles[order], slopes @ doubt.coefficients[first:count]
        pole_spread, zero_spread = (_known(doubt, rows, np.sqrt(variance)) for rows in (pole_rows, zero_rows))
    return Roots(
        _with_doubt(poles[order], pole_spread),
        _with_doubt(zeros, zero_spread),
        tuple(cancellations(poles[order], zeros, pole_spread, zero_spread)),
        tuple(_at_origin(problem, minimum, poles[order], pole_spread)),
    )


def _at_origin(problem: Problem, minimum: Minimum, poles: Complex, spread: Complex) -> Iterator[int]:
    """Indices of poles below all measured frequencies that may be zero within their noise, or are at a bound."""
    lowest = problem.scale * problem.s[0].imag
    held = problem.structure.stable and bool(np.any(minimum.at_bound[: problem.structure.poles]))
    for i, pole in enumerate(poles):
        if abs(pole) < lowest and (held or pole == 0 or within_noise(pole, spread[i])):
            yield i


def _known(doubt: Spread, rows: Complex, noise: float) -> Complex:
    """Covariance factors (n, r) of roots with derivatives (n, q); infinite if the data do not determine the root."""
    spread = np.asarray(noise * doubt.of(rows), dtype=np.complex128)
    spread[doubt.touched(rows)] = np.inf
    return spread


def _with_doubt(values: Complex, spread: Complex) -> tuple[Root, ...]:
    roots = []
    for value, row in zip(values, spread, strict=True):
        pair = np.vstack([row.real, row.imag])
        covariance = pair @ pair.T if np.isfinite(pair).all() else np.full((2, 2), np.inf)
        roots.append(Root(complex(value), covariance))
    return tuple(roots)
