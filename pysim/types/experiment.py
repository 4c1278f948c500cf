"""What is done to a model: inputs, overrides, and what to record."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from numbers import Real

import numpy as np
from numpy.typing import NDArray

from pysim.types._frozen import FrozenMapping, changed, frozen_array
from pysim.types.errors import BadInput
from pysim.types.signal import Signal

Array = NDArray[np.float64]
_ROUNDING = 1e-6  # of a step that is left at the end, and makes no row of its own


def rows_every(step: float, start: float, stop: float) -> Array:
    """(n_t,) s: a row at each step from the start on, and one at the stop, which may come sooner."""
    return np.append(np.arange(0.0, stop - start - _ROUNDING * step, step) + start, stop)


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
        offset: (n_x,) added to the model's continuous states, in its order, at `offset_at`; nothing where empty.
            An initial state that is not the one the model comes to by itself.
        offset_at: s, between start and times[-1]; the start where None. A row at that time is recorded behind it.
    Raises:
        BadInput: times that do not increase, nothing to record, an input that is no Signal, an override that is no
            number, or the rate of an input that is not driven.
    """

    times: Array
    record: tuple[str, ...]
    inputs: Mapping[str, Signal] = field(default_factory=dict)
    overrides: Mapping[str, float] = field(default_factory=dict)
    start: float = 0.0
    rates: Mapping[str, str] = field(default_factory=dict)
    offset: Array = field(default_factory=lambda: np.zeros(0))
    offset_at: float | None = None

    def __post_init__(self) -> None:
        if isinstance(self.record, str):
            raise BadInput(
                f"experiment: record is the text {self.record!r}; write a tuple of names, ({self.record!r},)"
            )
        if not isinstance(self.record, Iterable) or not all(isinstance(name, str) for name in self.record):
            raise BadInput(f"experiment: record is {self.record!r}; write a tuple of the names of variables")
        object.__setattr__(self, "times", _times(self.times))
        object.__setattr__(self, "offset", frozen_array(self.offset))
        object.__setattr__(self, "record", tuple(self.record))
        for name in ("inputs", "overrides", "rates"):
            object.__setattr__(self, name, FrozenMapping(getattr(self, name)))
        self._check_times()
        self._check_offset()
        self._check_names()

    def _check_times(self) -> None:
        times = self.times
        if times.ndim != 1 or times.size == 0 or np.any(np.diff(times) <= 0) or not np.isfinite(times).all():
            raise BadInput("experiment: times must be a non-empty row of finite, increasing numbers")
        if not isinstance(self.start, Real) or not math.isfinite(self.start):
            raise BadInput(f"experiment: the start is {self.start!r} s; give a finite time")
        if times[0] < self.start:
            raise BadInput(f"experiment: the first time {times[0]} s lies before the start {self.start} s")

    def _check_offset(self) -> None:
        times = self.times
        if self.offset_at is not None and not self.start <= self.offset_at <= times[-1]:
            raise BadInput(
                f"experiment: offset_at = {self.offset_at} s lies outside the run, {self.start} to {times[-1]} s"
            )
        if self.offset.ndim != 1 or not np.isfinite(self.offset).all():
            raise BadInput("experiment: the offset is a row of finite numbers, one per state of the model, or empty")

    def _check_names(self) -> None:
        if not self.record:
            raise BadInput("experiment: name at least one variable to record")
        for name, signal in self.inputs.items():
            if not isinstance(signal, Signal):
                raise BadInput(f"experiment: input {name!r} is {signal!r}; give a Signal, as Signal.constant(1.0)")
        _check_numbers(self.overrides)
        for name, of in self.rates.items():
            if of not in self.inputs or name in self.inputs:
                raise BadInput(
                    f"experiment: {name!r} is to carry the rate of {of!r}; give {of!r} a signal, and {name!r} none"
                )

    def override(self, **values: float) -> Experiment:
        """The same experiment with more parameters set; what stays is not checked again."""
        _check_numbers(values)
        return changed(self, overrides=FrozenMapping(self.overrides, values))

    def moved(self, offset: Array, at: float | None = None) -> Experiment:
        """The same experiment with the states offset (n_x,) at that time (s); what stays is not checked again."""
        other = changed(self, offset=frozen_array(offset), offset_at=at)
        other._check_offset()
        return other


def _check_numbers(overrides: Mapping[str, float]) -> None:
    for name, value in overrides.items():
        if type(value) is not float and not isinstance(value, Real):  # the second alone takes ten times the time
            raise BadInput(f"experiment: {name!r} cannot be set to {value!r}; give a number in its unit")


def _times(given: object) -> Array:
    try:
        return frozen_array(given)
    except (TypeError, ValueError):
        raise BadInput("experiment: times must be a non-empty row of finite, increasing numbers") from None
