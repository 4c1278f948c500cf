"""Choice of the numbers of poles and zeros that the data support, by AICc and BIC."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from pysim.identify.blackbox.fit import UNLIKELY, fit_transfer_function
from pysim.identify.blackbox.response import ComplexResponse, complex_response
from pysim.identify.blackbox.result import TransferFunctionFit
from pysim.identify.blackbox.structure import Structure
from pysim.types import BadInput, FrequencyResponse

_ALIKE = 2.0  # largest difference of AICc that counts as none (Burnham and Anderson, 2002, Section 2.6)
_TRIES = 2  # starts per structure


@dataclass(frozen=True)
class Candidate:
    """One structure: its fit, and both criteria. Smaller is better; only differences are meaningful."""

    fit: TransferFunctionFit
    aicc: float
    bic: float

    @property
    def sound(self) -> bool:
        """Whether the search converged, all numbers are determined and no pole and zero cancel."""
        return self.fit.converged and not self.fit.cancelling and not self.fit.undetermined


@dataclass(frozen=True)
class OrderSuggestion:
    """Every structure that was tried, by rising AICc, and the suggested one.

    Args:
        suggested: the one with fewest parameters among sound structures with an AICc within 2 of the lowest sound one.
        by_bic: the sound structure of lowest BIC, for comparison.
        noise_trusted: whether the criteria take the noise as known. If not, its variance counts as one more unknown:
            it was not given, or no structure explains the response to within the noise.
    """

    candidates: tuple[Candidate, ...]
    suggested: Candidate
    by_bic: Candidate
    noise_trusted: bool


def suggest_orders(
    response: FrequencyResponse | ComplexResponse,
    *,
    most_poles: int = 6,
    relative_degree: int = 1,
    dead_time_max: float | None = None,
    stable: bool = False,
    weights: str = "",
) -> OrderSuggestion:
    """Fit every structure up to an order and rank them by AICc.

    Args:
        most_poles: largest number of poles.
        relative_degree: smallest excess of poles over zeros; 1 for responses that vanish at high frequency.
        dead_time_max: s; every structure is also tried with a dead time up to this. None tries no dead time.
        stable, weights: as for a single fit.
    Raises:
        BadInput: too few frequencies for any structure.
    """
    data = complex_response(response) if isinstance(response, FrequencyResponse) else response
    count = 2 * data.frequency.size
    tops = (None,) if dead_time_max is None else (None, dead_time_max)
    structures = [
        Structure(n, m, 0.0, top, stable)
        for top in tops
        for n in range(1, min(most_poles, count) + 1)
        for m in range(max(n - relative_degree, -1) + 1)
    ]
    fits = [
        fit_transfer_function(data, s, weights=weights, tries=_TRIES) for s in structures if s.parameters + 3 <= count
    ]
    if not fits:
        raise BadInput(f"orders: {data.origin} has {data.frequency.size} frequencies, too few for any structure")
    trusted = fits[0].noise_known and max(fit.explains for fit in fits) >= UNLIKELY
    candidates = sorted((_candidate(fit, count, trusted) for fit in fits), key=lambda c: c.aicc)
    pool = [c for c in candidates if c.sound] or candidates
    near = [c for c in pool if c.aicc <= pool[0].aicc + _ALIKE]
    suggested = min(near, key=lambda c: (c.fit.structure.parameters, c.aicc))
    return OrderSuggestion(tuple(candidates), suggested, min(pool, key=lambda c: c.bic), trusted)


def _candidate(fit: TransferFunctionFit, count: int, trusted: bool) -> Candidate:
    """AICc and BIC: minus twice the log-likelihood of Gaussian noise, plus a penalty per unknown.

    The small-sample correction of AICc is kept for known noise, although not needed there: it favours fewer poles.
    """
    if trusted:
        deviance, unknowns = fit.misfit, fit.structure.parameters
    else:
        floor = count * np.finfo(float).eps ** 2  # an exact fit to data without noise
        deviance, unknowns = count * np.log(max(fit.misfit, floor) / count), fit.structure.parameters + 1
    corrected = 2 * unknowns + 2 * unknowns * (unknowns + 1) / (count - unknowns - 1)
    return Candidate(fit, float(deviance + corrected), float(deviance + unknowns * np.log(count)))
