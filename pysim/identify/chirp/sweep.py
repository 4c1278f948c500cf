"""Error of a sweep through a resonance, and the fastest sweep for a given error."""

from __future__ import annotations

import math

from pysim.types import BadInput


def sweep_error(rate: float, natural_hz: float, damping: float) -> float:
    """Relative deviation of a sweep's response from the steady response near a resonance, to first order.

    With the angular rate kappa = 2 pi rate, the response to exp(i theta(t)) is exp(i theta) (G - i kappa/2 G'').
    Near a pair of poles with the real part -zeta omega, |G''/G| is at most 2 / (zeta omega)^2.

    Args:
        rate: Hz/s, of either sign.
        natural_hz: natural frequency of the least damped resonance, Hz.
        damping: its damping ratio.
    Raises:
        BadInput: a natural frequency or a damping that is not positive.
    """
    if not (natural_hz > 0 and damping > 0):
        raise BadInput(f"sweep: natural frequency {natural_hz:g} Hz and damping {damping:g} must be positive")
    return 2 * math.pi * abs(rate) / (damping * 2 * math.pi * natural_hz) ** 2


def fastest_rate(natural_hz: float, damping: float, error: float = 0.02) -> float:
    """The sweep rate, Hz/s, at which `sweep_error` is `error`.

    Raises:
        BadInput: as `sweep_error`.
    """
    return error / sweep_error(1.0, natural_hz, damping)
