"""Best linear approximations from periodic and other broadband tests, with noise, even and odd distortion."""

from pysim.identify.multisine.approximation import (
    best_linear_approximation,
    fast_approximation,
    robust_approximation,
    smooth_approximation,
)
from pysim.identify.multisine.conversion import as_frequency_response
from pysim.identify.multisine.groups import grouped_realisations
from pysim.identify.multisine.lines import Lines, excited_lines, find_excited, lines_of
from pysim.identify.multisine.local_polynomial import LocalPolynomial, local_polynomial_approximation
from pysim.identify.multisine.periods import Periods, periods_of
from pysim.identify.multisine.realisations import METHODS, approximations
from pysim.identify.multisine.statistics import (
    difference_interval,
    distortion_p_value,
    gain_interval,
    gain_radius,
    pooled,
    variance_interval,
)
from pysim.identify.multisine.steady import DropPeriods, LocalTransient, SteadySpectra
from pysim.identify.multisine.window_choice import WindowChoice, rank_local_polynomials

__all__ = [
    "METHODS",
    "DropPeriods",
    "Lines",
    "LocalPolynomial",
    "LocalTransient",
    "Periods",
    "SteadySpectra",
    "WindowChoice",
    "approximations",
    "as_frequency_response",
    "best_linear_approximation",
    "difference_interval",
    "distortion_p_value",
    "excited_lines",
    "fast_approximation",
    "find_excited",
    "gain_interval",
    "gain_radius",
    "grouped_realisations",
    "lines_of",
    "local_polynomial_approximation",
    "periods_of",
    "pooled",
    "rank_local_polynomials",
    "robust_approximation",
    "smooth_approximation",
    "variance_interval",
]
