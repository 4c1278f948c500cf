"""The term that each effect adds at its slot, as a function of what the slot sees, in the model's own slot units."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from pysim.types import Missing

Array = NDArray[np.float64]
Numbers = Mapping[str, float]
_Law = Callable[[Array, Numbers], Array]

_TURN, _PRELOAD_WIDTH = 1e-3, 0.2e-3  # m/s, m: widths of the standard list's changes of sign
_AIR, _EXPONENT, _VACUUM = 1.013e5, 1.4, 1e3  # Pa, 1, Pa

# Powers of s by which what is counted in a unit changes where the model's stroke is s times the plant's: the area is
# then 1/s times as large, pressures and flows are the same.
_POWERS = {"m": 1, "m/s": 1, "N": -1}


def _stribeck(v: Array, p: Numbers) -> Array:
    size = p["F_c"] + (p["F_s"] - p["F_c"]) * np.exp(-np.abs(v) / p["v_s"])
    return -size * np.tanh(v / _TURN)


def _air(pressure: Array, p: Numbers) -> Array:
    absolute = np.maximum(pressure + _AIR, _VACUUM)
    return p["eps"] * (_AIR / absolute) ** (1 / _EXPONENT) / (_EXPONENT * absolute)


def _dead(number: str) -> _Law:
    return lambda s, p: -np.clip(s, -p[number], p[number])


def _linear(number: str, factor: float = 1.0) -> _Law:
    return lambda z, p: factor * p[number] * z


def _constant(number: str) -> _Law:
    return lambda z, p: np.full(z.size, p[number])


def _sign(number: str) -> _Law:
    return lambda z, p: -p[number] * np.sign(z)


EXACT: Mapping[tuple[str, str], _Law] = MappingProxyType(
    {
        ("friction.coulomb", "pistonForce.v"): lambda v, p: -p["F_c"] * np.tanh(v / _TURN),
        ("friction.stribeck", "pistonForce.v"): _stribeck,
        ("spring.hardening", "pistonForce.x"): lambda x, p: -p["k_3"] * x**3,
        ("spring.preload", "pistonForce.x"): lambda x, p: -p["F_0"] * np.tanh(x / _PRELOAD_WIDTH),
        ("swash.bias", "pistonForce.x"): _constant("F_b"),
        ("swash.bias", "pistonForce.v"): _constant("F_b"),
        ("valve.deadband", "spoolOpening.s"): _dead("u_0"),
        ("valve.offset", "spoolOpening.s"): _constant("u_n"),
        ("card.error_deadzone", "angleError.s"): _dead("e_0"),
        ("oil.air", "oil.p"): _air,
        ("leakage.laminar", "internalLeakage.dp"): _linear("C_l"),
        ("leakage.external", "externalLeakage.p"): _linear("C_e"),
    }
)
"""Effects without memory: effect and what its term is drawn over -> the term."""

NEARLY: Mapping[tuple[str, str], _Law] = MappingProxyType(
    {
        ("sensor.lag", "angleSensor.s_t"): _linear("T_f", -1.0),
        ("card.sampling", "der(cardOutput.s)"): _linear("T_s", -0.5),
        ("supply.droop", "supply.Q"): _linear("R"),
        ("valve.hysteresis", "der(spoolCommand.s)"): _sign("h"),
        ("linkage.backlash", "linkage.s_t"): _sign("d"),
    }
)
"""Effects with memory, which no function of one variable gives: what they are to first order, for short memories."""


def true_term(effect: str, numbers: Numbers, found: Missing, stretch: float) -> Array | None:
    """The term (n,) at the arguments of what was found; None where it is no function of them.

    Args:
        numbers: of the effect, by the symbols of the standard list.
        stretch: the model's stroke over the plant's, since measurements do not tell the two apart.
    """
    law = EXACT.get((effect, found.depends_on)) or NEARLY.get((effect, found.depends_on))
    if law is None:
        return None
    z = found.shape.argument / stretch ** _POWERS.get(found.shape.argument_unit, 0)
    return np.asarray(law(z, numbers) * stretch ** _POWERS.get(found.shape.unit, 0))


def covered(found: Missing, truth: Array) -> float:
    """Share of the range in which the band holds the truth (n,); what refitting absorbs may be there in any amount."""
    shape = found.shape
    half, rest = 0.5 * (shape.high - shape.low), truth - shape.value
    if shape.absorbed.size:
        weights = 1 / np.maximum(half, 1e-12 * float(np.max(half)))
        fit = np.linalg.lstsq(shape.absorbed * weights[:, None], rest * weights, rcond=None)[0]
        rest = rest - shape.absorbed @ fit
    return float(np.mean(np.abs(rest) <= half))
