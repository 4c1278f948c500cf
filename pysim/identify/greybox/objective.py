"""Objectives of a fit: squares of residuals over their levels, or the thesis' sums of absolute deviations."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType

from pysim.identify.greybox.observation import Measure, Observation
from pysim.types import BadInput


@dataclass(frozen=True)
class Objective:
    """One objective function.

    Args:
        name: as on the command line.
        words: description for users.
        measure: unit of the residuals: divided by their levels, or deviations as in the thesis.
        squares: whether squares are summed up, or absolute values.
        domains: domains of the observations that are fitted.
    """

    name: str
    words: str
    measure: Measure
    squares: bool
    domains: tuple[str, ...]

    def counts(self, observation: Observation) -> bool:
        """Whether an observation belongs to one of its domains."""
        return observation.domain in self.domains

    def chosen(self, observations: Sequence[Observation]) -> tuple[Observation, ...]:
        """The observations to fit: those with use "fit" in its domains.

        Raises:
            BadInput: there are none.
        """
        found = tuple(one for one in observations if one.use == "fit" and self.counts(one))
        if not found:
            raise BadInput(
                f"fit: no record to fit counts for the objective {self.name!r}, which needs "
                f"{' or '.join(self.domains)} data; choose another objective"
            )
        return found


_SIGNAL, _THESIS = Measure.SIGNAL, Measure.THESIS
NOISE = Objective("noise", "squares of residuals over their noise", _SIGNAL, True, ("time", "frequency"))
TIME = Objective("time", "absolute deviations over time in percent (thesis Eq. 2.24)", _THESIS, False, ("time",))
FREQUENCY = Objective(
    "frequency", "absolute deviations, 90/20 dB and degrees (thesis Eq. 2.25)", _THESIS, False, ("frequency",)
)
COMBINED = Objective(
    "combined", "absolute deviations over time and frequency (thesis Eq. 2.26)", _THESIS, False, ("time", "frequency")
)
OBJECTIVES: Mapping[str, Objective] = MappingProxyType({o.name: o for o in (NOISE, TIME, FREQUENCY, COMBINED)})
