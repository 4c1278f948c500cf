"""What a fit minimises: noise-weighted squares, or the thesis' sums of absolute deviations."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from pysim.identify.greybox.target import Residual, Simulated, Target
from pysim.types import BadInput

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Objective:
    """One way to count how far a model is from its measurements.

    Args:
        name: short, as on the command line.
        words: the same for a reader.
        weighted: residuals in standard deviations of the noise, else as the thesis counts deviations.
        squares: their squares are summed up, else their sizes.
        domains: of the targets that count.
    """

    name: str
    words: str
    weighted: bool
    squares: bool
    domains: tuple[str, ...]

    def counts(self, target: Target) -> bool:
        """Whether a target has a part in it."""
        return target.domain in self.domains

    def residual(self, target: Target, simulated: Sequence[Simulated]) -> Residual:
        """What is summed up of one target."""
        return target.weighted(simulated) if self.weighted else target.deviation(simulated)

    def cost(self, residual: Array) -> float:
        """The sum (n_r,) -> one number."""
        return float(residual @ residual) if self.squares else float(np.sum(np.abs(residual)))

    def chosen(self, targets: Sequence[Target]) -> tuple[Target, ...]:
        """Targets to fit.

        Raises:
            BadInput: none counts.
        """
        found = tuple(target for target in targets if target.use == "fit" and self.counts(target))
        if not found:
            raise BadInput(
                f"fit: no record to fit counts for the objective {self.name!r}, which needs "
                f"{' or '.join(self.domains)} data; choose another objective"
            )
        return found


NOISE = Objective("noise", "squares of residuals over their noise", True, True, ("time", "frequency"))
TIME = Objective("time", "absolute deviations over time in percent (thesis Eq. 2.24)", False, False, ("time",))
FREQUENCY = Objective(
    "frequency", "absolute deviations, 90/20 dB and degrees (thesis Eq. 2.25)", False, False, ("frequency",)
)
COMBINED = Objective(
    "combined", "absolute deviations over time and frequency (thesis Eq. 2.26)", False, False, ("time", "frequency")
)
OBJECTIVES: Mapping[str, Objective] = MappingProxyType({o.name: o for o in (NOISE, TIME, FREQUENCY, COMBINED)})
