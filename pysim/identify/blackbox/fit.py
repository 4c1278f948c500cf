"""Fit of a transfer function to a frequency response (thesis Section 2.4, Appendix B)."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from scipy.special import chdtrc

from pysim.identify.blackbox import sections
from pysim.identify.blackbox.notes import notes_on
from pysim.identify.blackbox.objective import Problem
from pysim.identify.blackbox.refine import Minimum, refine
from pysim.identify.blackbox.response import ComplexResponse, complex_response, whitening
from pysim.identify.blackbox.result import TransferFunctionFit
from pysim.identify.blackbox.roots import roots_of
from pysim.identify.blackbox.start import starts
from pysim.identify.blackbox.structure import Structure
from pysim.identify.blackbox.uncertainty import spread
from pysim.identify.transfer_function import TransferFunction
from pysim.types import BadInput, FrequencyResponse

UNLIKELY = 1e-3  # p-value of the misfit below which the residuals are more than noise and widen the intervals


def fit_transfer_function(
    response: FrequencyResponse | ComplexResponse, structure: Structure, *, weights: str = "", tries: int = 4
) -> TransferFunctionFit:
    """Fit a transfer function of a given structure to measured gains, by weighted least squares.

    Args:
        response: complex gains, or gain and phase, over frequency.
        structure: numbers of poles and zeros; known or unknown dead time; whether it has to be stable.
        weights: "covariance", "uniform" or "relative"; by default the covariance if the response has one, otherwise
            uniform. Real and imaginary part are weighted jointly.
        tries: number of the best starts that are refined to their minimum.
    Returns:
        the best minimum. Covariances are to first order in the noise, which is that of the response, enlarged if the
        residuals are significantly larger; without a covariance it is estimated from the residuals.
    Raises:
        BadInput: fewer measured numbers than unknowns, or weights that need a missing covariance.
    Source: thesis Eq. 2.14; starts after Sanathanan and Koerner, variable projection after Kaufman.
    """
    data = complex_response(response) if isinstance(response, FrequencyResponse) else response
    weights = weights or ("uniform" if data.covariance is None else "covariance")
    spare = 0 if weights == "covariance" else 1  # the noise is estimated from the residuals
    if 2 * data.frequency.size < structure.parameters + spare:
        raise BadInput(
            f"black box: {structure.label} are {structure.parameters} numbers and {data.origin} has "
            f"{data.frequency.size} frequencies, two numbers each; ask for fewer poles and zeros"
        )
    problem = Problem.of(data, structure, whitening(data, weights))
    minima = [refine(problem, start) for start in starts(problem, max(tries, 1))]
    return _result(data, weights, problem, min(minima, key=lambda minimum: minimum.point.cost))


def _result(data: ComplexResponse, weights: str, problem: Problem, minimum: Minimum) -> TransferFunctionFit:
    structure, known = problem.structure, weights == "covariance"
    function, doubt = _function(problem, minimum), spread(problem, minimum)
    misfit, freedom = minimum.point.cost, 2 * data.frequency.size - structure.parameters
    variance = _variance(misfit, freedom, known)
    roots = roots_of(problem, minimum, function, doubt, variance)
    names, lost = _names(structure), doubt.touched(doubt.coefficients)
    fit = TransferFunctionFit(
        function=function,
        structure=structure,
        data=data,
        weights=weights,
        names=names,
        spread=np.sqrt(variance) * doubt.of(doubt.coefficients),
        undetermined=tuple(name for name, gone in zip(names, lost, strict=True) if gone),
        poles=roots.poles,
        zeros=roots.zeros,
        cancelling=roots.cancelling,
        at_origin=roots.at_origin,
        standardised=minimum.point.residual.reshape(-1, 2) / (np.sqrt(variance) if variance > 0 else 1.0),
        misfit=misfit,
        freedom=freedom,
        noise_known=known,
        scatter=float(variance),
        converged=minimum.converged,
    )
    return replace(fit, notes=tuple(notes_on(fit, minimum)))


def _function(problem: Problem, minimum: Minimum) -> TransferFunction:
    n, m, scale = problem.structure.poles, problem.structure.zeros, float(problem.scale)
    below = sections.polynomial(minimum.unknowns[:n]) * scale ** np.arange(n + 1)
    above = minimum.point.basis.powers() @ minimum.point.coefficients * scale ** (n - np.arange(m, -1, -1.0))
    delay = problem.delay(minimum.unknowns) / scale if problem.structure.delayed else problem.structure.dead_time
    return TransferFunction(tuple(above.tolist()), tuple(below.tolist()), delay)


def _variance(misfit: float, freedom: int, known: bool) -> float:
    """Factor on the covariance: 1 if the known noise explains the residuals, otherwise their variance."""
    if known and (freedom == 0 or chdtrc(freedom, misfit) >= UNLIKELY):
        return 1.0
    return misfit / freedom


def _names(structure: Structure) -> tuple[str, ...]:
    above = [f"b{k}" for k in range(structure.zeros, -1, -1)]
    below = [f"a{k}" for k in range(structure.poles - 1, -1, -1)]
    return tuple(above + below + ["dead_time"] * structure.delayed)
