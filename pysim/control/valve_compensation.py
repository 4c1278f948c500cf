"""The servo valve's characteristic turned round: from the wanted flow to the opening, with measured pressures."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from pysim.control._check import check_numbers
from pysim.types import BadInput, Port


@dataclass
class ValveCompensation:
    """u = Q / (K sqrt((p_s - sign(Q) p_L) / rho)), within the valve's limits.

    With it the loop sees a valve whose flow is what was asked for, whatever the load pressure; so a feed-forward of the
    motor's flow takes away what the shaft's speed does to the load pressure.

    Args:
        K: m2, flow over opening and root of pressure over density.
        rho: kg/m3.
        least: Pa, pressure drop below which the valve is taken to have this one; it keeps the opening finite.
    Raises:
        BadInput: a number that is not positive.
    Source: thesis Eq. 5.2 solved for u_sv; proposed in its Section 6.1.
    """

    K: float
    rho: float
    least: float = 5e5

    def __post_init__(self) -> None:
        check_numbers("valve compensation", self, "K", "rho", "least")
        for name in ("K", "rho", "least"):
            if not 0 < getattr(self, name) < math.inf:
                raise BadInput(f"valve compensation: {name} = {getattr(self, name):g}; give a positive number")
        self.inputs = (Port("flow", "m3/s"), Port("p_s", "Pa"), Port("p_L", "Pa"))
        self.outputs = (Port("u", "1"),)

    def step(self, time: float, inputs: Sequence[float]) -> tuple[float]:
        """(flow, p_s, p_L) -> (u,)."""
        flow, p_s, p_L = inputs
        drop = max(p_s - math.copysign(p_L, flow * p_L), self.least) if flow else self.least
        return (min(max(flow / (self.K * math.sqrt(drop / self.rho)), -1.0), 1.0),)
