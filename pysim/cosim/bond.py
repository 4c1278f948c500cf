"""A power bond: an effort one way, a flow back, and the energy that gets lost or made between them."""

from __future__ import annotations

from dataclasses import dataclass

# Pairs whose product is a power in W.
_POWER = ({"Pa", "m3/s"}, {"N", "m/s"}, {"N.m", "rad/s"}, {"V", "A"})


@dataclass(frozen=True)
class Bond:
    """Two members that exchange power: one gives an effort, the other a flow.

    Both are held, extrapolated or averaged over a step on the side that receives them, so that the power one side gives
    is not quite the power the other takes. The difference is energy that only the coupling makes. The record shows, in
    the sign of the side that gives the effort, `<name>.power` (W, the last step's mean) and `<name>.residual` (J since
    the start: given minus taken).

    Args:
        name: of the two columns in the record.
        effort: "member.input" that receives the effort: a pressure, force, torque or voltage.
        flow: "member.input" of the other member, which receives the flow: a volume flow, velocity, speed or current.
    Source: Sadjina, Kyllingstad, Skjong, Pedersen, Energy conservation and power bonds in co-simulations, 2017.
    """

    name: str
    effort: str
    flow: str


def is_power(effort: str, flow: str) -> bool:
    """Whether the product of two units is a watt."""
    return {effort, flow} in _POWER
