"""Measurements that a model is compared with, and how they are compared."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field

from pysim.identify.frequency_response import THESIS_REFERENCE_HZ
from pysim.identify.greybox.settings import NoiseSettings
from pysim.types import BadInput, Dataset
from pysim.types._frozen import FrozenMapping


@dataclass(frozen=True)
class Measurements:
    """One data set and how it is used.

    Args:
        dataset: its records of use "validate" are compared, never fitted.
        overrides: parameters that differ from the nominal ones in these tests, in the variables' units.
    """

    dataset: Dataset
    overrides: Mapping[str, float] = field(default_factory=dict)

    def __post_init__(self) -> None:
        object.__setattr__(self, "overrides", FrozenMapping(self.overrides))


@dataclass(frozen=True)
class Rest:
    """How the model settles at the first sample's input before a log, as on the bench (thesis Section 2.1.1, step 1).

    Args:
        ramp: s from the input's start value to its value at the first sample; None: half the model's settling time.
        hold: s at that value until the log starts; None: twice the model's settling time.
    Raises:
        BadInput: a duration that is not positive.
    """

    ramp: float | None = None
    hold: float | None = None

    def __post_init__(self) -> None:
        for value in (self.ramp, self.hold):
            if value is not None and not 0 < value < math.inf:
                raise BadInput(f"rest: ramp and hold must be positive times in s, got {self.ramp} and {self.hold}")

    def times(self, settling: float) -> tuple[float, float]:
        """Ramp and hold in s, for a model with this settling time in s."""
        return (settling / 2 if self.ramp is None else self.ramp, 2 * settling if self.hold is None else self.hold)


@dataclass(frozen=True)
class SinePlan:
    """How a stepped-sine log is cut and compared.

    Args:
        settle_time: s of the sine that are left out for settling; see `settle_periods`.
        settle_periods: whole periods that are left out if they are longer than `settle_time`. If that is None, more are
            left out until the first compared period agrees with the later ones.
        harmonics: fewest harmonics to compare, if the sampling resolves them; more are compared if significant.
        points: samples over one period of the model's orbit; at most a quarter of `points` harmonics are compared.
    Raises:
        BadInput: fewer than one harmonic, or too few points for the harmonics.
    """

    settle_time: float | None = None
    settle_periods: int = 1
    harmonics: int = 5
    points: int = 49

    def __post_init__(self) -> None:
        if self.harmonics < 1 or self.points < 4 * self.harmonics + 1:
            raise BadInput(
                f"sine plan: {self.harmonics} harmonics need at least one and {4 * self.harmonics + 1} points, "
                f"got {self.points}"
            )
        if (self.settle_time or 0.0) < 0 or self.settle_periods < 0:
            raise BadInput("sine plan: what is left out for settling must not be negative")


@dataclass(frozen=True)
class Treatment:
    """How logs are compared.

    Args:
        rest: how the model settles before a log over time; None starts it at the log's start, at its start values.
        sine: which periods and harmonics of a stepped sine are compared.
        reference_hz: frequency whose gain counts as 0 dB in responses (Eq. 2.12); None compares absolute gains.
        steady: "orbit" compares each stepped sine with the model's periodic steady state; "transient" simulates the
            test over time, for models without such a state (sampling, play, chaos).
        initial: state of the plant at the first sample of a log that does not specify it: "near rest", "rest", or
            "estimate" if nothing is known of it.
        noise: settings of levels, priors and blocks.
    Raises:
        BadInput: an unknown word for `steady` or `initial`.
    """

    rest: Rest | None = field(default_factory=Rest)
    sine: SinePlan = field(default_factory=SinePlan)
    reference_hz: float | None = THESIS_REFERENCE_HZ
    steady: str = "orbit"
    initial: str = "near rest"
    noise: NoiseSettings = field(default_factory=NoiseSettings)

    def __post_init__(self) -> None:
        if self.steady not in ("orbit", "transient"):
            raise BadInput(f'treatment: steady = {self.steady!r} is not known; use "orbit" or "transient"')
        if self.initial not in ("near rest", "rest", "estimate"):
            raise BadInput(f'treatment: initial = {self.initial!r} is not known; use "near rest", "rest" or "estimate"')
