"""What may be missing from a model: the standard list with its plausible sizes, the same laws shaped differently, and
effects that are on no list."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

import numpy as np

from validation.blind.plant.quantities import Parameters, Strengths

SIZES = ("small", "middle", "large")
_SHARE = 0.15  # of the logarithmic range, that one size takes

_BASE = Parameters()
_RATED = 4.1e-4  # m3/s, rated flow of the valve, standard list
_LARGEST_FLOW = 1.57e-4  # m3/s, that the supply gives in the programme's tests with the thesis' parameters
_FULL_ANGLE = math.radians(15)
_HALF_STROKE = _BASE.L / 2
_STEEP = _BASE.k / _HALF_STROKE  # N/m2


@dataclass(frozen=True)
class Range:
    """Of one number of an effect, from its weakest to its strongest plausible size.

    Args:
        field: of `Strengths`.
        shape: drawn from the whole range whatever the size, because it shapes the effect and has no off value.
        signed: either sign.
        share_of: another field, of which the drawn number is a share.
    """

    field: str
    weak: float
    strong: float
    shape: bool = False
    signed: bool = False
    share_of: str = ""

    @property
    def symbol(self) -> str:
        """As the lists call it."""
        return self.field.split("__")[1]

    def draw(self, size: str, rng: np.random.Generator) -> float:
        """A number of that size: log-uniform in the lowest, central or uppermost part of the range."""
        place = SIZES.index(size) / 2 * (1 - _SHARE) + _SHARE * rng.uniform()
        part = rng.uniform() if self.shape else place
        value = self.weak * (self.strong / self.weak) ** part
        return float(value * (rng.choice((-1.0, 1.0)) if self.signed else 1.0))


def _of_full_spring(share: float) -> float:
    return share * _BASE.k / _HALF_STROKE**2


STANDARD: Mapping[str, tuple[Range, ...]] = MappingProxyType(
    {
        "friction.coulomb": (Range("coulomb__F_c", 20, 300),),
        "friction.stribeck": (
            Range("stribeck__F_s", 40, 400),
            Range("stribeck__F_c", 0.3, 0.8, shape=True, share_of="stribeck__F_s"),
            Range("stribeck__v_s", 2e-3, 20e-3, shape=True),
        ),
        "spring.hardening": (Range("hardening__k_3", _of_full_spring(0.3), _of_full_spring(3)),),
        "spring.preload": (Range("preload__F_0", 20, 200),),
        "swash.bias": (Range("bias__F_b", 20, 200, signed=True),),
        "linkage.backlash": (Range("backlash__d", 0.02e-3, 0.3e-3),),
        "valve.deadband": (Range("deadband__u_0", 0.005, 0.05),),
        "valve.offset": (Range("offset__u_n", 0.003, 0.03, signed=True),),
        "valve.saturation": (Range("saturation__u_max", 0.6, 0.1),),
        "valve.rate_limit": (Range("rate_limit__r_max", 60, 15),),
        "valve.hysteresis": (Range("hysteresis__h", 0.003, 0.03),),
        "oil.air": (Range("air__eps", 0.002, 0.05),),
        "supply.droop": (
            Range("droop__R", 10e5 / _LARGEST_FLOW, 60e5 / _LARGEST_FLOW),
            Range("droop__T", 5e-3, 50e-3, shape=True),
        ),
        "leakage.laminar": (Range("laminar__C_l", 0.005 * _RATED / 100e5, 0.05 * _RATED / 100e5),),
        "leakage.external": (Range("external__C_e", 0.005 * _RATED / 100e5, 0.05 * _RATED / 100e5),),
        "sensor.lag": (Range("lag__T_f", 0.5e-3, 5e-3),),
        "card.sampling": (Range("sampling__T_s", 1e-3, 8e-3),),
        "card.error_deadzone": (Range("deadzone__e_0", 0.0005 * _FULL_ANGLE, 0.005 * _FULL_ANGLE),),
    }
)
"""The pump's effects of the standard list."""

BEYOND: Mapping[str, tuple[Range, ...]] = MappingProxyType(
    {
        "shaft.force": (Range("shaft__F", 30, 300), Range("shaft__phase", 0.1, 2 * math.pi, shape=True)),
        "damping.quadratic": (Range("quadratic__b_2", 1.3e4, 1.3e5),),
        "spring.one_sided": (Range("one_sided__k_a", 0.1 * _BASE.k, _BASE.k),),
        "leakage.worn": (
            Range("worn__C_w", 0.01 * _RATED / 100e5, 0.2 * _RATED / 100e5),
            Range("worn__x_w", 2e-3, 8e-3, shape=True),
        ),
        "valve.uneven": (Range("uneven__share", 0.05, 0.5),),
        "spool.friction": (Range("spool_friction__a_c", 60, 600),),
        "supply.ripple": (Range("ripple__p", 1e5, 20e5), Range("ripple__f", 8, 16, shape=True)),
        "sensor.resonance": (Range("resonance__f", 90, 45), Range("resonance__zeta", 0.1, 0.3, shape=True)),
        "delay.warming": (Range("warming__share", 0.03, 0.3),),
        "card.fading": (Range("fading__share", 0.02, 0.2),),
    }
)
"""Effects of the same kinds that are on no list, so that a diagnosis ought to answer "unknown"."""

SHAPED: Mapping[str, tuple[Range, ...]] = MappingProxyType(
    {
        "friction.coulomb~arctan": (Range("arctan__F", 40, 400),),
        "spring.preload~wide": (Range("wide__F", 40, 400),),
        "spring.hardening~progressive": (Range("progressive__k", 0.3 * _STEEP, 3 * _STEEP),),
        "valve.deadband~rounded": (Range("rounded__u_0", 0.005, 0.05),),
        "valve.saturation~soft": (Range("soft__u", 0.5, 0.08),),
        "oil.air~isothermal": (Range("isothermal__eps", 0.002, 0.05),),
        "supply.droop~square": (Range("square__R", 10e5 / _LARGEST_FLOW**2, 60e5 / _LARGEST_FLOW**2),),
        "leakage.external~orifice": (Range("orifice__K", 0.5e-9, 5e-9),),
        "sensor.lag~twofold": (Range("twofold__T", 0.5e-3, 5e-3),),
        "card.error_deadzone~blunt": (Range("blunt__e_0", 0.0005 * _FULL_ANGLE, 0.005 * _FULL_ANGLE),),
    }
)
"""Laws of the list with another shape, behind the name that is right for them."""

_ALL = {**STANDARD, **BEYOND, **SHAPED}


def draw_effect(name: str, size: str, rng: np.random.Generator) -> dict[str, float]:
    """Fields of `Strengths` and their numbers for one effect of one size."""
    drawn: dict[str, float] = {}
    for part in _ALL[name]:
        value = part.draw(size, rng)
        drawn[part.field] = value * drawn[part.share_of] if part.share_of else value
    return drawn


def told(name: str, strengths: Strengths) -> dict[str, float]:
    """The effect's numbers by the symbols of the lists, SI units."""
    return {part.symbol: float(getattr(strengths, part.field)) for part in _ALL[name]}
