"""A controller that is a plain class: its ports are the names in its `step`, its state is what it holds."""

from __future__ import annotations

import copy
import inspect
import weakref
from collections.abc import Mapping, Sequence
from numbers import Real
from typing import Any

import numpy as np

from pysim.types import BadInput, Port

# Number of a controller -> its numbers before its last run, and behind it.
_RUNS: dict[int, tuple[Mapping[str, Any], Mapping[str, Any]]] = {}


class PlainBlock:
    """A sampled block made of an object with `step(t, ...)`.

    The arguments of `step` after the time are the inputs; one with a default value need not be wired. What it returns
    is the output, or a tuple or dictionary of several. The numbers in `vars(...)` are its state: numbers, and rows of
    numbers whose length stays. A list that is empty at first is a log of the user's, and no state.

    Args:
        name: in the system.
        controller: the object.
        outputs: names, as the wires have them.
        units: port -> unit, of inputs and outputs; "1" where none is known.
    Raises:
        BadInput: no `step`, or one that takes rows of arguments.
    """

    def __init__(self, name: str, controller: Any, outputs: Sequence[str], units: Mapping[str, str]) -> None:
        self._name, self._controller, self._outputs = name, controller, tuple(outputs)
        parameters = step_arguments(name, controller)
        self.inputs = tuple(Port(p.name, units.get(p.name, "1"), _default(name, p)) for p in parameters)
        self.outputs = tuple(Port(one, units.get(one, "1")) for one in outputs)
        self.dt = getattr(controller, "dt", None)
        self._held = tuple((key, _size(value)) for key, value in vars(controller).items() if _size(value) is not None)

    def begin(self) -> None:
        """A run begins. What the one before has changed is as that found it, unless its owner has set it since."""
        own = self._controller
        found, left = _RUNS.get(id(own), ({}, {}))
        for key, _ in self._held:
            if key in left and np.array_equal(getattr(own, key), left[key], equal_nan=True):
                setattr(own, key, copy.copy(found[key]))
        self._found = self._numbers()

    def end(self) -> None:
        """The run is over."""
        if id(self._controller) not in _RUNS:
            weakref.finalize(self._controller, _RUNS.pop, id(self._controller), None)
        _RUNS[id(self._controller)] = self._found, self._numbers()

    def _numbers(self) -> Mapping[str, Any]:
        return {key: copy.copy(getattr(self._controller, key)) for key, _ in self._held}

    def step(self, time: float, inputs: Sequence[float]) -> tuple[float, ...]:
        """One sample."""
        given = self._controller.step(time, *inputs)
        if isinstance(given, Mapping):
            missing = [one for one in self._outputs if one not in given]
            if missing:
                raise ValueError(f"step returned no {', '.join(missing)}, which a wire asks for")
            return tuple(float(given[one]) for one in self._outputs)
        if isinstance(given, Real | np.number):
            return (float(given),)
        return tuple(float(one) for one in given)

    def state(self) -> tuple[float, ...]:
        """All numbers that it holds."""
        found: list[float] = []
        for key, size in self._held:
            value = getattr(self._controller, key)
            if _size(value) != size:
                raise BadInput(
                    f"{self._name}: its {key} was {_words(size)} and is {_words(_size(value))}; make it as long as it "
                    "will be in __init__, so that a run can be kept and repeated"
                )
            found += [float(value)] if size == -1 else np.ravel(np.array(value, dtype=float)).tolist()
        return tuple(found)

    def restore(self, state: Sequence[float]) -> None:
        """Put them back, as what they were: whole numbers stay whole, rows stay rows."""
        at = 0
        for key, size in self._held:
            old, count = getattr(self._controller, key), 1 if size == -1 else int(size or 0)
            part, at = list(state[at : at + count]), at + count
            setattr(self._controller, key, _like(old, part))


def step_arguments(name: str, controller: Any) -> list[inspect.Parameter]:
    """What its `step` takes after the time."""
    step = getattr(controller, "step", None)
    if not callable(step):
        raise BadInput(f"{name}: {type(controller).__name__} has no step(t, ...); give an FMU's path or a controller")
    parameters = list(inspect.signature(step).parameters.values())[1:]
    for one in parameters:
        if one.kind in (one.VAR_POSITIONAL, one.VAR_KEYWORD, one.KEYWORD_ONLY):
            raise BadInput(f"{name}: its step takes {one}; name each input: step(self, t, reference, measured)")
    return parameters


def _default(name: str, one: inspect.Parameter) -> float | None:
    if one.default is inspect.Parameter.empty:
        return None
    if not isinstance(one.default, Real | np.number):
        raise BadInput(f"{name}: the input {one.name} is {one.default!r} by default; give a number")
    return float(one.default)


def _size(value: Any) -> int | None:
    """-1 for a number, the count of a row of numbers; None for what is no state."""
    if isinstance(value, Real | np.number):
        return -1
    if isinstance(value, np.ndarray):
        return int(value.size) if np.issubdtype(value.dtype, np.number) or value.dtype == bool else None
    if hasattr(value, "__len__") and hasattr(value, "__iter__") and not isinstance(value, str | bytes | Mapping | set):
        return len(value) if len(value) and all(isinstance(one, Real | np.number) for one in value) else None
    return None


def _words(size: int | None) -> str:
    return "no number" if size is None else "a number" if size == -1 else f"a row of {size}"


def _like(old: Any, part: list[float]) -> Any:
    """These numbers in the form of what was there."""
    if isinstance(old, np.ndarray):
        return np.array(part).reshape(old.shape).astype(old.dtype)
    if isinstance(old, Real | np.number):
        return _as(old, part[0])
    kept = [_as(a, b) for a, b in zip(old, part, strict=True)]
    limit = getattr(old, "maxlen", None)
    return type(old)(kept) if limit is None else type(old)(kept, limit)


def _as(old: Any, value: float) -> Any:
    kind: Any = type(old)
    return kind(value)
