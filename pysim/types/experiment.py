"""What is done to a model: inputs, overrides, and what to record."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from pysim.types.errors import BadInput
from pysim.types.signal import Signal

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Experiment:
    """One run, without a solver or a file.

    Args:
        times: (n_t,) s, increasing; the run starts at `start` and ends at times[-1]; a row is recorded at each.
        record: names of the variables to record.
        inputs: input name -> Signal, in the input's unit; an input not named keeps its start value.
        overrides: parameter or start value -> number, in the variable's unit; set before initialisation.
        start: s, not after times[0].
        rates: input -> another input that is driven: the first carries the exact derivative, per s, of the second.
    Raises:
        BadInput: times that do not increase, nothing to record, or the rate of an input that is not driven.
    """

    times: Array
    record: tuple[str, ...]
    inputs: Mapping[str, Signal] = field(default_factory=dict)
    overrides: Mapping[str, float] = field(default_factory=dict)
    start: float = 0.0
    rates: Mapping[str, str] = field(default_factory=dict)

    def __post_init__(self) -> None:
        times = np.array(self.times, dtype=np.float64)
        times.setflags(write=False)
        object.__setattr__(self, "times", times)
        object.__setattr__(self, "inputs", MappingProxyType(dict(self.inputs)))
        object.__setattr__(self, "overrides", MappingProxyType(dict(self.overrides)))
        object.__setattr__(self, "rates", MappingProxyType(dict(self.rates)))
        if times.ndim != 1 or times.size == 0 or np.any(np.diff(times) <= 0) or not np.isfinite(times).all():
            raise BadInput("experiment: times must be a non-empty row of finite, increasing numbers")
        if times[0] < self.start:
            raise BadInput(f"experiment: the first time {times[0]} s lies before the start {self.start} s")
        if not self.record:
            raise BadInput("experiment: name at least one variable to record")
        for name, of in self.rates.items():
            if of not in self.inputs or name in self.inputs:
                raise BadInput(
                    f"experiment: {name!r} is to carry the rate of {of!r}; give {of!r} a signal, and {name!r} none"
                )

    def override(self, **values: float) -> Experiment:
        """The same experiment with more parameters set."""
        return replace(self, overrides={**self.overrides, **values})
