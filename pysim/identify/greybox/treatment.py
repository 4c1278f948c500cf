"""Which measurements a model is compared with, and how."""

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
        overrides: parameters that differ from the model's own in these tests, in the variables' units.
        outputs: columns to compare; every measured output where None.
        noise: column -> standard deviation in its unit, in place of what the data set says.
    """

    dataset: Dataset
    overrides: Mapping[str, float] = field(default_factory=dict)
    outputs: tuple[str, ...] | None = None
    noise: Mapping[str, float] = field(default_factory=dict)

    def __post_init__(self) -> None:
        for name in ("overrides", "noise"):
            object.__setattr__(self, name, FrozenMapping(getattr(self, name)))
        for name, value in self.noise.items():
            if not value > 0:
                raise BadInput(f"measurements: the noise of {name} is {value}; give a positive number")


@dataclass(frozen=True)
class Rest:
    """How the model comes to rest at the first sample's input, as the bench did (thesis Section 2.1.1, step 1).

    Args:
        ramp: s, from the input's start value to the first sample's; half the model's settling time where None.
        hold: s, at that value until the log starts; twice the model's settling time where None.
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
        """Ramp and hold of a model that settles within so many s."""
        return (settling / 2 if self.ramp is None else self.ramp, 2 * settling if self.hold is None else self.hold)


@dataclass(frozen=True)
class SinePlan:
    """How a stepped-sine log is cut and compared.

    Args:
        settle_time: s of the sine that are left out, and
        settle_periods: whole periods, whichever is longer; more of them where `settle_time` is None and the first that
            is compared is unlike those after it.
        harmonics: how many are compared at least, where the sampling tells them apart; more where more are measured, a
            quarter of `points` at most.
        points: samples over one period of the model's orbit.
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
        rest: how the model comes to rest before a log over time; None starts it as the model says, at the log's start.
        sine: what of a stepped sine is compared.
        reference_hz: whose gain counts as 0 dB in responses (Eq. 2.12); None compares gains as they are.
        steady: "orbit" seeks each stepped sine's periodic steady state; "transient" runs the test as the bench did,
            for models that have none (sampling, play, chaos).
        initial: what is known of the plant at the first sample of a log that does not say it itself: "near rest",
            "rest", or "estimate" where nothing is.
        noise: the numbers that residuals are judged by.
    Raises:
        BadInput: a word that is not known.
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
