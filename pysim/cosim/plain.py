"""A controller that is a plain class: its ports are the names in its `step`, its state is what it holds."""

from __future__ import annotations

import copy
import inspect
import weakref
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from numbers import Real
from typing import Any

import numpy as np

from pysim.cosim.sampled import Sampled
from pysim.cosim.system import Part
from pysim.types import BadInput, Port

_BLOCK = ("inputs", "outputs", "step", "state", "restore")
_NUMBERS = float, Real, np.number  # the first is found at once; the others take longer than most controllers
_ALONE = "u"  # the output of a controller that no wire begins at

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
        self._name, self.controller, self._outputs = name, controller, tuple(outputs)
        parameters = step_arguments(name, controller)
        self.inputs = tuple(Port(p.name, units.get(p.name, "1"), _default(name, p)) for p in parameters)
        self.outputs = tuple(Port(one, units.get(one, "1")) for one in outputs)
        self.dt = getattr(controller, "dt", None)
        self._held = tuple((key, _size(value)) for key, value in vars(controller).items() if _size(value) is not None)

    def begin(self) -> None:
        """A run begins. What the one before has changed is as that found it, unless its owner has set it since."""
        own = self.controller
        found, left = _RUNS.get(id(own), ({}, {}))
        for key, _ in self._held:
            if key in left and np.array_equal(getattr(own, key), left[key], equal_nan=True):
                setattr(own, key, copy.copy(found[key]))
        self._found = self._numbers()

    def end(self) -> None:
        """The run is over."""
        if id(self.controller) not in _RUNS:
            weakref.finalize(self.controller, _RUNS.pop, id(self.controller), None)
        _RUNS[id(self.controller)] = self._found, self._numbers()

    def _numbers(self) -> Mapping[str, Any]:
        return {key: copy.copy(getattr(self.controller, key)) for key, _ in self._held}

    def step(self, time: float, inputs: Sequence[float]) -> tuple[float, ...]:
        """One sample."""
        given = self.controller.step(time, *inputs)
        if isinstance(given, _NUMBERS):
            return (float(given),)
        if isinstance(given, Mapping):
            if missing := [one for one in self._outputs if one not in given]:
                raise ValueError(f"step returned no {', '.join(missing)}, which a wire asks for")
            return tuple(float(given[one]) for one in self._outputs)
        return tuple(float(one) for one in given)

    def state(self) -> tuple[float, ...]:
        """All numbers that it holds."""
        found: list[float] = []
        for key, size in self._held:
            value = getattr(self.controller, key)
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
            old, count = getattr(self.controller, key), 1 if size == -1 else int(size or 0)
            part, at = list(state[at : at + count]), at + count
            setattr(self.controller, key, _like(old, part))


@dataclass(frozen=True)
class Unwired:
    """A controller whose ports and units its wires have yet to give; its fields are those of `Sampled`."""

    name: str
    controller: Any
    every: float
    delay: float = 0.0
    hold: int = 0

    def __post_init__(self) -> None:
        step_arguments(self.name, self.controller)


def sampled(name: str, controller: Any, every: float, delay: float = 0.0, hold: int = 0) -> Sampled | Unwired:
    """A block as it is, and a plain object until its wires are known."""
    whole = all(hasattr(controller, attribute) for attribute in _BLOCK)
    return (Sampled if whole else Unwired)(name, controller, every, delay, hold)


def wired(parts: Sequence[Part | Unwired], wires: Sequence[tuple[str, str]]) -> tuple[Part, ...]:
    """The parts, of which every controller has the ports that wires (output, input) give it, in the units they carry.

    Raises:
        BadInput: what `PlainBlock` refuses.
    """
    known = [part for part in parts if not isinstance(part, Unwired)]
    units = {f"{part.name}.{p.name}": p.unit for part in known for p in (*part.inputs, *part.outputs)}
    for _ in range(len(parts) - len(known)):  # a unit goes from wire to wire, through as many controllers as there are
        for source, target in wires:
            unit = units.get(source) or units.get(target)
            if unit:
                units.setdefault(source, unit)
                units.setdefault(target, unit)
    return tuple(_with_ports(part, wires, units) if isinstance(part, Unwired) else part for part in parts)


def _with_ports(part: Unwired, wires: Sequence[tuple[str, str]], units: Mapping[str, str]) -> Sampled:
    own = {port.partition(".")[2]: unit for port, unit in units.items() if port.partition(".")[0] == part.name}
    block = PlainBlock(part.name, part.controller, _outputs(part, wires), own)
    block.begin()
    return Sampled(part.name, block, part.every, part.delay, part.hold)


def _outputs(part: Unwired, wires: Sequence[tuple[str, str]]) -> list[str]:
    """Names of what a controller returns: those it lists itself, else those that wires begin with."""
    if listed := getattr(part.controller, "outputs", None):
        return [str(each) for each in listed]
    begun = [source.partition(".")[2] for source, _ in wires if source.partition(".")[0] == part.name]
    return list(dict.fromkeys(begun)) or [_ALONE]


def step_arguments(name: str, controller: Any) -> list[inspect.Parameter]:
    """What its `step` takes after the time."""
    step = getattr(controller, "step", None)
    if not callable(step):
        raise BadInput(f"{name}: {type(controller).__name__} has no step(t, ...); give an FMU's path or a controller")
    if not hasattr(controller, "__dict__"):
        raise BadInput(
            f"{name}: {type(controller).__name__} has __slots__, so its state cannot be kept; do without them"
        )
    parameters = list(inspect.signature(step).parameters.values())[1:]
    for one in parameters:
        if one.kind in (one.VAR_POSITIONAL, one.VAR_KEYWORD, one.KEYWORD_ONLY):
            raise BadInput(f"{name}: its step takes {one}; name each input: step(self, t, reference, measured)")
    return parameters


def _default(name: str, one: inspect.Parameter) -> float | None:
    if one.default is inspect.Parameter.empty:
        return None
    if not isinstance(one.default, _NUMBERS):
        raise BadInput(f"{name}: the input {one.name} is {one.default!r} by default; give a number")
    return float(one.default)


def _size(value: Any) -> int | None:
    """-1 for a number, the count of a row of numbers; None for what is no state."""
    if isinstance(value, _NUMBERS):
        return -1
    if isinstance(value, np.ndarray):
        return int(value.size) if np.issubdtype(value.dtype, np.number) or value.dtype == bool else None
    if hasattr(value, "__len__") and hasattr(value, "__iter__") and not isinstance(value, str | bytes | Mapping | set):
        return len(value) if len(value) and all(isinstance(one, _NUMBERS) for one in value) else None
    return None


def _words(size: int | None) -> str:
    return "no number" if size is None else "a number" if size == -1 else f"a row of {size}"


def _like(old: Any, part: list[float]) -> Any:
    """These numbers in the form of what was there."""
    kind: Any = type(old)
    if isinstance(old, np.ndarray):
        return np.array(part).reshape(old.shape).astype(old.dtype)
    if isinstance(old, _NUMBERS):
        return kind(part[0])
    kept = [type(a)(b) for a, b in zip(old, part, strict=True)]
    limit = getattr(old, "maxlen", None)
    return kind(kept) if limit is None else kind(kept, limit)
