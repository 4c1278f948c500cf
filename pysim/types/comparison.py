"""A model beside measured frequency responses: what was compared, how far apart, and the verdict."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from pysim.types._frozen import FrozenMapping
from pysim.types.criterion import Deviation
from pysim.types.frequency_response import FrequencyResponse


@dataclass(frozen=True)
class ResponseComparison:
    """One test: measured and simulated at the same frequencies.

    Args:
        measured: what the bench answered.
        simulated: what the model answered, or None where a run failed.
        deviations: one per criterion; empty where a run failed.
        message: why there is no simulated response; empty where there is one.
    """

    measured: FrequencyResponse
    simulated: FrequencyResponse | None
    deviations: tuple[Deviation, ...]
    message: str = ""

    @property
    def passes(self) -> bool:
        """Whether every criterion is met; a run that failed meets none."""
        return bool(self.deviations) and all(deviation.passes for deviation in self.deviations)


@dataclass(frozen=True)
class Comparison:
    """All tests of one model with one set of parameters.

    Args:
        model: the model's name.
        label: the parameter set's name.
        overrides: parameters that were set, in the variables' units.
        dataset: name of the data set.
        note: what the data set says of itself; belongs beside every verdict.
        tests: one per measured response, in the data set's order.
        reference_hz: where magnitudes count as 0 dB, on both sides; None where gains are compared as they are.
        command_unit: of the tests' offsets and amplitudes.
        conditions: what else it takes to repeat the runs, in words: FMU token, solver, settling, versions.
        parameters: every parameter of the model in these runs, name -> (value, unit).
    """

    model: str
    label: str
    dataset: str
    note: str
    tests: tuple[ResponseComparison, ...]
    overrides: Mapping[str, float] = field(default_factory=dict)
    reference_hz: float | None = 0.1
    command_unit: str = "%"
    conditions: Mapping[str, str] = field(default_factory=dict)
    parameters: Mapping[str, tuple[float, str]] = field(default_factory=dict)

    def __post_init__(self) -> None:
        for name in ("overrides", "conditions", "parameters"):
            object.__setattr__(self, name, FrozenMapping(getattr(self, name)))

    @property
    def passes(self) -> bool:
        """Whether there are tests and every one passes."""
        return bool(self.tests) and all(test.passes for test in self.tests)

    @property
    def measured_name(self) -> str:
        """What the model is held against, in words: the responses' origin, their common part where they differ."""
        origins = list(dict.fromkeys(test.measured.origin for test in self.tests))
        kinds = list(dict.fromkeys(origin.partition(",")[0] for origin in origins))
        return origins[0] if len(origins) == 1 else ", ".join(kinds)

    @property
    def independent(self) -> int:
        """How many measured responses differ from each other."""
        return len(self.groups)

    @property
    def independent_passes(self) -> int:
        """How many of the independent tests pass; one that stands in several rows passes where all of them do."""
        return sum(all(test.passes for test in group) for group in self.groups)

    @property
    def groups(self) -> tuple[tuple[ResponseComparison, ...], ...]:
        """The tests, those with the same measured response together: a copied one is no evidence of its own."""
        found: list[list[ResponseComparison]] = []
        for test in self.tests:
            group = next((group for group in found if _same(group[0].measured, test.measured)), None)
            if group is None:
                found.append([test])
            else:
                group.append(test)
        return tuple(tuple(group) for group in found)


def _same(a: FrequencyResponse, b: FrequencyResponse) -> bool:
    return all(np.array_equal(getattr(a, name), getattr(b, name)) for name in ("frequency", "gain", "phase"))
