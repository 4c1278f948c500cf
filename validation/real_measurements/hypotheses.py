"""What may be wrong with the locked model: a number taken as known, a bound, or an effect that is missing."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field

from pysim.effects import STANDARD_LIBRARY, fitting, read_catalogue
from pysim.identify.greybox import Parameter, Tie
from pysim.types import Effect

_LOCKED_CLASS = "HydraulicTestBench.Pump.LockedGreyBox"
LOCKED = ("omega_v", "zeta_v", "V_0", "m_eff", "k", "b", "K_p", "K_D", "T_d", "K_L", "tau")
# Known numbers may be wrong by this factor either way: the free model went a third of the way with the area.
_FACTOR = 5.0
# Bounds of Table 4.6 that the locked model's fit runs into, ten times as wide.
_WIDER: Mapping[str, tuple[float, float]] = {
    "omega_v": (30.0, 2000.0),
    "k": (0.0, 300e3),
    "b": (0.0, 300e3),
    "K_D": (0.001, 10.0),
    "T_d": (0.0004, 0.0159),
    "m_eff": (2.0, 7000.0),
    "K_L": (0.0, 5e-6),
}


@dataclass(frozen=True)
class Hypothesis:
    """One explanation of why the locked model does not fit.

    Args:
        name: short.
        kind: "as it is" | "known number" | "bounds" | "effect".
        about: in words.
        freed: parameters that are fitted besides, or with other bounds.
        ties: parameters that follow one that is free.
        effect: what is added to the model.
    """

    name: str
    kind: str
    about: str
    freed: tuple[Parameter, ...] = ()
    ties: tuple[Tie, ...] = ()
    effect: Effect | None = field(default=None, repr=False)


def hypotheses(known: Mapping[str, float]) -> Iterator[Hypothesis]:
    """The locked model as it is, then everything that may be changed, one at a time.

    Args:
        known: value of each number that the locked model takes as known, in SI units.
    """

    def within(name: str) -> Parameter:
        return Parameter(name, known[name], known[name] / _FACTOR, known[name] * _FACTOR)

    yield Hypothesis("locked", "as it is", "11 parameters within the bounds of Table 4.6")
    yield Hypothesis("A_p", "known number", "area of the control piston", (within("A_p"),))
    yield Hypothesis("L", "known number", "stroke of the control piston", (within("L"),))
    yield Hypothesis("A_p and L", "known number", "both, as in the free model", (within("A_p"), within("L")))
    yield Hypothesis("pS", "known number", "supply pressure of the control", (within("pS"),))
    yield Hypothesis("beta", "known number", "stiffness of the oil", (within("beta"),))
    ties = tuple(Tie(name, "k2", known[name] / known["k2"]) for name in ("k1", "k3"))
    yield Hypothesis("K(u)", "known number", "size of the valve's opening, k1 to k3 alike", (within("k2"),), ties)
    yield Hypothesis("k3", "known number", "the valve's opening near its middle, linear part", (within("k3"),))
    wider = tuple(Parameter(name, None, *bounds) for name, bounds in _WIDER.items())
    yield Hypothesis("bounds", "bounds", f"bounds of {', '.join(_WIDER)} ten times as wide", wider)
    both = (*wider, within("k2"))
    yield Hypothesis("bounds and K(u)", "bounds", "the last, and the size of the valve's opening", both, ties)
    for effect in fitting(read_catalogue(STANDARD_LIBRARY), _LOCKED_CLASS, [STANDARD_LIBRARY]):
        if effect.name not in SLOW:
            yield Hypothesis(effect.name, "effect", effect.description, effect=effect)


# Effects that end the smooth periodic motion: each of their fits would take a quarter of an hour.
SLOW = ("card.sampling", "linkage.backlash", "valve.hysteresis", "valve.rate_limit", "valve.saturation")
