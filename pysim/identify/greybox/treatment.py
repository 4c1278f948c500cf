"""Which measurements a model is compared with, and how."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from pysim.identify.frequency_response import THESIS_REFERENCE_HZ
from pysim.identify.greybox.command import Rest
from pysim.identify.greybox.sine_log import SinePlan
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
class Treatment:
    """How logs are compared.

    Args:
        rest: how the model comes to rest before a log over time; None starts it as the model says, at the log's start.
        sine: what of a stepped sine is compared.
        reference_hz: whose gain counts as 0 dB in responses (Eq. 2.12); None compares gains as they are.
        steady: "orbit" seeks each stepped sine's periodic steady state; "transient" runs the test as the bench did,
            for models that have none (sampling, play, chaos).
    Raises:
        BadInput: a word that is not known.
    """

    rest: Rest | None = field(default_factory=Rest)
    sine: SinePlan = field(default_factory=SinePlan)
    reference_hz: float | None = THESIS_REFERENCE_HZ
    steady: str = "orbit"

    def __post_init__(self) -> None:
        if self.steady not in ("orbit", "transient"):
            raise BadInput(f'treatment: steady = {self.steady!r} is not known; use "orbit" or "transient"')
