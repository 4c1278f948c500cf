"""A model beside measured frequency responses: what was compared, how far apart, and the verdict."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from types import MappingProxyType

import numpy as np

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
    """

    model: str
    label: str
    dataset: str
    note: str
    tests: tuple[ResponseComparison, ...]
    overrides: Mapping[str, float] = field(default_factory=dict)

    def __post_init__(self) -> None:
        object.__setattr__(self, "overrides", MappingProxyType(dict(self.overrides)))

    @property
    def passes(self) -> bool:
        """Whether there are tests and every one passes."""
        return bool(self.tests) and all(test.passes for test in self.tests)

    @property
    def independent(self) -> int:
        """How many measured responses differ from each other; a copied one is no evidence of its own."""
        distinct: list[FrequencyResponse] = []
        for test in self.tests:
            if not any(_same(test.measured, other) for other in distinct):
                distinct.append(test.measured)
        return len(distinct)


def _same(a: FrequencyResponse, b: FrequencyResponse) -> bool:
    return all(np.array_equal(getattr(a, name), getattr(b, name)) for name in ("frequency", "gain", "phase"))
