"""A controller that is a plain class or a function: its inputs are the names of its arguments."""

from __future__ import annotations

import inspect
import reprlib
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from numbers import Real
from typing import Any

import numpy as np

from pysim.control import Block
from pysim.cosim.member import MemberFailed
from pysim.cosim.sampled import Sampled
from pysim.cosim.system import Part
from pysim.types import BadInput, Port

_NUMBERS = float, Real, np.number  # the first is found at once; the others take longer than most controllers
_ALONE = "u"  # the output of a controller that no wire begins at


class PlainBlock:
    """A sampled block made of an object with `step(t, ...)`, or of a function of the same arguments.

    Those after the time are the inputs; one with a default value need not be wired. What it returns is the output, or
    a dictionary of several. A row of several is taken where the object lists its `outputs`.

    Args:
        name: in the system.
        controller: the object or function.
        inputs: name -> unit, where one is known; "1" elsewhere.
        outputs: name -> unit, as the wires have them.
    Raises:
        BadInput: no `step`, or one that takes rows of arguments.
    """

    def __init__(self, name: str, controller: Any, inputs: Mapping[str, str], outputs: Mapping[str, str]) -> None:
        self.controller, self._step, self._names = controller, _step_of(name, controller), tuple(outputs)
        parameters = _arguments(name, self._step)
        self.inputs = tuple(Port(p.name, inputs.get(p.name, "1"), _default(name, p)) for p in parameters)
        self.outputs = tuple(Port(one, unit) for one, unit in outputs.items())
        self.dt, self._has_order = getattr(controller, "dt", None), bool(_listed(controller))

    def step(self, time: float, inputs: Sequence[float]) -> tuple[float, ...]:
        """One sample.

        Raises:
            MemberFailed: what it returned is not one number for each output.
        """
        given, names = self._step(time, *inputs), self._names
        if isinstance(given, Mapping):
            row: Iterable[Any] = [given[name] for name in names if name in given]
        else:
            row = given if len(names) > 1 and self._has_order and np.ndim(given) else [given]
        found = tuple(_number(one) for one in row)
        if len(found) != len(names) or None in found:
            wanted = f"a number, {names[0]}" if len(names) == 1 else f"a dictionary of numbers, {', '.join(names)}"
            raise MemberFailed(f"its step returned {reprlib.repr(given)}; end it with return and {wanted}")
        return found  # type: ignore[return-value]


def own_object(block: Block) -> Any:
    """What the user gave as a controller."""
    return block.controller if isinstance(block, PlainBlock) else block


@dataclass(frozen=True)
class Unwired:
    """A controller whose ports and units its wires have yet to give; its fields are those of `Sampled`."""

    name: str
    controller: Any
    every: float
    delay: float = 0.0
    hold: int = 0

    def __post_init__(self) -> None:
        _arguments(self.name, _step_of(self.name, self.controller))


def sampled(name: str, controller: Any, every: float, delay: float = 0.0, hold: int = 0) -> Sampled | Unwired:
    """A block with ports as it is, and a plain object or a function until its wires are known."""
    ports = [getattr(controller, side, ()) for side in ("inputs", "outputs")]
    whole = any(isinstance(one, Port) for side in ports if isinstance(side, tuple | list) for one in side)
    return (Sampled if whole and not isinstance(controller, type) else Unwired)(name, controller, every, delay, hold)


def wired(parts: Sequence[Part | Unwired], wires: Sequence[tuple[str, str]]) -> tuple[Part, ...]:
    """The parts, of which every controller has the ports that wires (output, input) give it, in the units they carry.

    Raises:
        BadInput: what `PlainBlock` refuses.
    """
    known = [part for part in parts if not isinstance(part, Unwired)]
    starts = {f"{part.name}.{p.name}": p.unit for part in known for p in part.outputs}
    ends = {f"{part.name}.{p.name}": p.unit for part in known for p in part.inputs}
    for _ in range(2):  # an output has the unit of the first input that has one, and then gives it to its others
        for source, target in wires:
            if unit := starts.get(source) or ends.get(target):
                starts.setdefault(source, unit)
                ends.setdefault(target, unit)
    return tuple(_with_ports(part, wires, starts, ends) if isinstance(part, Unwired) else part for part in parts)


def _with_ports(
    part: Unwired, wires: Sequence[tuple[str, str]], starts: Mapping[str, str], ends: Mapping[str, str]
) -> Sampled:
    own = {p.partition(".")[2]: unit for p, unit in ends.items() if p.partition(".")[0] == part.name}
    # Names of what it returns: those it lists itself, else those that wires begin with.
    begun = [source.partition(".")[2] for source, _ in wires if source.partition(".")[0] == part.name]
    names = _listed(part.controller) or begun or [_ALONE]
    outputs = {name: starts.get(f"{part.name}.{name}", "1") for name in names}
    block = PlainBlock(part.name, part.controller, own, outputs)
    return Sampled(part.name, block, part.every, part.delay, part.hold)


def _listed(controller: Any) -> list[str]:
    """Names of outputs that it lists itself; none where it has something else under that name, as its last values."""
    given = getattr(controller, "outputs", ())
    row = [given] if isinstance(given, str) else list(given) if isinstance(given, tuple | list) else []
    return row if all(isinstance(one, str) for one in row) else []


def _step_of(name: str, controller: Any) -> Callable[..., Any]:
    step = getattr(controller, "step", controller)
    if isinstance(controller, type):
        raise BadInput(f"{name}: {controller.__name__} is a class; give an object of it, {controller.__name__}(...)")
    if not callable(step):
        raise BadInput(f"{name}: {type(controller).__name__} has no step(t, ...); give an FMU's path or a controller")
    return step


def _arguments(name: str, step: Callable[..., Any]) -> list[inspect.Parameter]:
    """What a step takes after the time."""
    try:
        time, *parameters = inspect.signature(step).parameters.values() or (None,)
    except ValueError as error:  # of some that are written in C or C++
        cure = "call it in a function of your own: lambda t, reference, measured: ..."
        raise BadInput(f"{name}: its step does not tell its arguments ({error}); {cure}") from error
    for one in parameters:
        if one.kind in (one.VAR_POSITIONAL, one.VAR_KEYWORD, one.KEYWORD_ONLY):
            raise BadInput(f"{name}: its step takes {one}; name each input: step(self, t, reference, measured)")
    if time is None:
        raise BadInput(f"{name}: its step takes no time; let it begin with it: step(self, t, reference, measured)")
    return parameters


def _default(name: str, one: inspect.Parameter) -> float | None:
    if one.default is inspect.Parameter.empty:
        return None
    if not isinstance(one.default, _NUMBERS):
        raise BadInput(f"{name}: the input {one.name} is {one.default!r} by default; give a number")
    return float(one.default)


def _number(value: Any) -> float | None:
    """As a float; None for what is no number. An array of one is one."""
    if isinstance(value, _NUMBERS):
        return float(value)
    array = np.asarray(value)
    return float(array.item()) if array.size == 1 and array.dtype.kind in "biuf" else None
