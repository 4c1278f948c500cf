"""Where a learned law may be added to a model: its slots, or the derivatives of its states if it has no slots.

If a slot has two sides, `q1` over `p1` and `q2` over `p2`, both get the same curve, and the law has the names of the
first side.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations

from pysim.effects.slots import Slot
from pysim.types import Model

TIME = "time"  # of the model, which runs on the common clock of all records
LESS = " - "  # between two variables whose difference a law depends on
_SPEEDS = ("m/s", "rad/s")  # units of the variables that may pull on a bristle


@dataclass(frozen=True)
class Side:
    """One variable of a place that a law is added to.

    Args:
        output: the variable; if it is a state, the law is added to its derivative.
        output_rate: variable to which the law's time derivative is added; "" if there is none.
        own: full names of the slot's variables for this side, which laws may depend on; the same order on all sides.
        rates: their time derivatives, "" where the model has none.
    """

    output: str
    output_rate: str
    own: tuple[str, ...]
    rates: tuple[str, ...]


@dataclass(frozen=True)
class Place:
    """A place in the model where a law may be added.

    Args:
        name: of the slot, or "der(STATE)" in a model without slots.
        key: prefix of the names of its parameters.
        sides: variables that get the same law.
        outside: variables outside the slot that the law may depend on, and differences of two, "a - b".
        speeds: indices of the speeds in `own` of the side; none in a slot with two sides, which share no bristle.
        moved: indices of variables there that are states, whose rates the model has; for a place without speeds.
    """

    name: str
    key: str
    sides: tuple[Side, ...]
    outside: tuple[str, ...]
    speeds: tuple[int, ...] = ()
    moved: tuple[int, ...] = ()

    @property
    def pulls(self) -> dict[int, str]:
        """Index in `own` of what may pull on a bristle -> Modelica text of its speed."""
        own = self.sides[0].own
        return {i: own[i] for i in self.speeds} | {i: f"der({own[i]})" for i in self.moved}

    @property
    def arguments(self) -> tuple[str, ...]:
        """Variables that laws may depend on: those of the first side, then those outside the slot."""
        return (*self.sides[0].own, *self.outside)

    def coefficients(self, count: int) -> tuple[str, ...]:
        """Names of the parameters that hold the curve's values."""
        return tuple(f"{self.key}_c{i}" for i in range(1, count + 1))


def places(slots: Sequence[Slot], model: Model) -> tuple[Place, ...]:
    """Places where a law may be added: the slots, or the derivatives of the states if the model has no slots."""
    known = {variable.name for variable in model.variables}
    if not slots:
        return tuple(_of_state(k, model) for k in range(len(model.abilities.states)))
    found: list[Place] = []
    for number, slot in enumerate(slots, start=1):
        sides = _sides(slot, known, set(model.abilities.states))
        if sides and sides[0].own:
            outside = () if sides[0].output_rate else _outside(slots, model, sides)
            found.append(Place(slot.name, f"law{number}", sides, outside, _speeds(sides, model)))
    return tuple(found)


def _speeds(sides: Sequence[Side], model: Model) -> tuple[int, ...]:
    if len(sides) > 1 or sides[0].output_rate:
        return ()
    return tuple(i for i, name in enumerate(sides[0].own) if model[name].unit in _SPEEDS)


def _of_state(k: int, model: Model) -> Place:
    state = model.abilities.states[k]
    depends = model.abilities.dependencies[k] if k < len(model.abilities.dependencies) else None
    others = [name for name in model.abilities.states if depends is None or name in depends] or [state]
    own = tuple(others)
    side = Side(state, "", own, ("",) * len(own))
    return Place(f"der({state})", f"law{k + 1}", (side,), (*_inputs(model), TIME), _speeds((side,), model))


def _outside(slots: Sequence[Slot], model: Model, sides: Sequence[Side]) -> tuple[str, ...]:
    """States outside all slots, differences of two in one unit, inputs and time: a law over these makes no algebraic
    loop."""
    inner = tuple(f"{slot.name}." for slot in slots)
    states = [name for name in model.abilities.states if not name.startswith(inner)]
    units = {name: model[name].unit for name in states}
    pairs = [f"{a}{LESS}{b}" for a, b in combinations(states, 2) if units[a] == units[b] not in (None, "", "1")]
    own = {name for side in sides for name in side.own}
    return tuple(name for name in (*states, *pairs, *_inputs(model), TIME) if name not in own)


def _inputs(model: Model) -> tuple[str, ...]:
    """Inputs of the model without those that are rates of other inputs."""
    names = [v.name for v in model.variables if v.causality == "input"]
    return tuple(name for name in names if not _rate_of(name, names))


def _sides(slot: Slot, known: set[str], states: set[str]) -> tuple[Side, ...]:
    """Sides of a slot: each variable that its class computes, with the variables that a law there may depend on."""

    def full(name: str) -> str:
        return f"{slot.name}.{name}" if f"{slot.name}.{name}" in known else ""

    sees = [v for v in slot.sees if full(v)]
    outputs = [v for v in slot.gives if not _rate_of(v, slot.gives)]
    pairs = _numbered(outputs, sees)
    if pairs:
        return tuple(Side(full(y), "", tuple(map(full, own)), ("",) * len(own)) for y, own in pairs)
    moving = [v for v in slot.gives if full(v) in states]
    free = [v for v in slot.gives if full(v) and full(v) not in states]
    if moving and free:  # the slot holds a state: the law is added to what drives the state
        own = [*moving, *sees]
        return (Side(full(free[-1]), "", tuple(map(full, own)), ("",) * len(own)),)
    if not outputs or not full(outputs[0]):
        return ()
    y = outputs[0]
    rate = full(f"{y}_t") if f"{y}_t" in slot.gives else ""
    own = [v for v in sees if not _rate_of(v, sees)] if rate or any(_rate_of(v, sees) for v in sees) else sees
    rates = [full(f"{v}_t") for v in own]
    if rate:
        own, rates = [v for v, r in zip(own, rates, strict=True) if r], [r for r in rates if r]
    return (Side(full(y), rate, tuple(map(full, own)), tuple(rates)),)


def _rate_of(name: str, names: Sequence[str]) -> bool:
    return name.endswith("_t") and name[:-2] in names


def _numbered(outputs: Sequence[str], sees: Sequence[str]) -> list[tuple[str, list[str]]]:
    """Outputs of a slot with several sides, each with the variables of its side; empty for any other slot.

    A side is marked by a number, `q1`, or by an underscore and a letter, `q_s`.
    """
    bare = {re.sub(r"(\d+|_[A-Za-z])$", "", y) for y in outputs}
    numbers = [re.search(r"(\d+|_[A-Za-z])$", y) for y in outputs]
    if len(outputs) < 2 or len(bare) != 1 or not all(numbers):
        return []
    found = []
    for y, number in zip(outputs, numbers, strict=True):
        own = [z for z in sees if number is not None and re.fullmatch(rf"[A-Za-z_]+{number[0]}", z)]
        found.append((y, own))
    return found if all(own and len(own) == len(found[0][1]) for _, own in found) else []
