"""Terms that a place of the model may lack, as a table over one of the model's variables: what is compiled for them."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Protocol

from pysim.effects import Slot
from pysim.types import Model

KNOTS = 15
# A flow or a pressure that answers to its own pressure or flow would close an algebraic loop: it sees it later, by one
# of these, s; a supply answers within milliseconds, or as slowly as its pump is controlled.
LAGS = (1e-3, 5e-3, 20e-3)
# A rate that the model does not know is taken over so long, s.
RATE = 1e-3
_C, _K, _H, _W = "missing_c", "missing_k", "missing_term", "missing_seen"
UNIT = "missing_unit"  # parameter that scales the table


@dataclass(frozen=True)
class Copy:
    """One term: what it is added to, what it depends on.

    Args:
        output: variable that gets the term.
        argument: variable the term depends on.
        output_rate: variable that needs the term's rate, "" where none does.
        argument_rate: variable that is the argument's rate, "" where the model has none.
    """

    output: str
    argument: str
    output_rate: str = ""
    argument_rate: str = ""


@dataclass(frozen=True)
class Law:
    """A term y = h(z) at one place, with h a table of KNOTS values, straight in between but for rounded corners.

    Args:
        slot: name of the place.
        argument: what h depends on, as people read it.
        copies: one, or two where the place has two sides with the same law.
        lag: s by which the term follows its argument.
        of_rate: whether it depends on the argument's rate.
    """

    slot: str
    argument: str
    copies: tuple[Copy, ...]
    lag: float = 0.0
    of_rate: bool = False

    @property
    def values(self) -> tuple[str, ...]:
        """Parameters that hold the table's values."""
        return tuple(f"{_C}{i}" for i in range(1, KNOTS + 1))

    @property
    def knots(self) -> tuple[str, ...]:
        """Parameters that hold where these are."""
        return tuple(f"{_K}{i}" for i in range(1, KNOTS + 1))

    @property
    def probes(self) -> tuple[str, ...]:
        """What is added to which equation, as `fmu_build.build(probes=...)` takes it."""
        found = []
        for i, copy in enumerate(self.copies, start=1):
            found.append(f"{copy.output}={_H}{i}")
            if copy.output_rate:
                found.append(f"{copy.output_rate}={_H}{i}_t")
        return tuple(found)

    @property
    def text(self) -> str:
        """Declarations and equations for a class that extends the model. Knots and values stay free: compiled once."""
        lines = [f"  parameter Real {c} = 0;" for c in self.values]
        lines += [f"  parameter Real {k} = {i};" for i, k in enumerate(self.knots, start=1)]
        lines.append(f"  parameter Real {UNIT} = 1;")
        equations: list[str] = []
        first: list[str] = []
        for i, copy in enumerate(self.copies, start=1):
            lines.append(f"  Real {_H}{i};")
            z, rate = copy.argument, copy.argument_rate
            if self.lag or self.of_rate or (copy.output_rate and not rate):
                over = self.lag or RATE
                lines.append(f"  Real {_W}{i};")
                first.append(f"  {_W}{i} = {z};")
                change = f"({z} - {_W}{i})/{over!r}"
                equations.append(f"  der({_W}{i}) = {change};")
                z, rate = (change, "") if self.of_rate else (f"{_W}{i}", change)
            equations.append(f"  {_H}{i} = {UNIT}*({_table(f'({z})')});")
            if copy.output_rate:
                lines.append(f"  Real {_H}{i}_t;")
                equations.append(f"  {_H}{i}_t = {UNIT}*{_slope(f'({z})')}*({rate});")
        start = ["initial equation", *first] if first else []
        return "\n".join([*lines, *start, "equation", *equations, ""])


class Term(Protocol):
    """What can be compiled beside a model."""

    @property
    def slot(self) -> str:
        """Name of the place."""
        ...

    @property
    def text(self) -> str:
        """Declarations and equations."""
        ...

    @property
    def probes(self) -> tuple[str, ...]:
        """What is added to which equation, as `fmu_build.build(probes=...)` takes it."""
        ...


def wrapped(base: str, law: Term, name: str) -> str:
    """The class to compile: the model and the term beside it."""
    return f'model {name} "{base} with a term at {law.slot}"\n  extends {base};\n{law.text}end {name};\n'


def _corners() -> Iterator[tuple[str, str, str]]:
    """Per inner knot its place, the width of its rounding, and the change of slope there."""
    k, c = [f"{_K}{i}" for i in range(1, KNOTS + 1)], [f"{_C}{i}" for i in range(1, KNOTS + 1)]
    for i in range(1, KNOTS - 1):
        width = f"(0.25*min({k[i]} - {k[i - 1]}, {k[i + 1]} - {k[i]}))"
        change = f"(({c[i + 1]} - {c[i]})/({k[i + 1]} - {k[i]}) - ({c[i]} - {c[i - 1]})/({k[i]} - {k[i - 1]}))"
        yield k[i], width, change


def _table(z: str) -> str:
    """h(z): a straight line, and a rounded ramp from each inner knot on."""
    ramps = [f"{change}*0.5*({z} - {k} + sqrt(({z} - {k})^2 + {w}^2))" for k, w, change in _corners()]
    first = f"{_C}1 + ({_C}2 - {_C}1)/({_K}2 - {_K}1)*({z} - {_K}1)"
    return " + ".join([first, *ramps])


def _slope(z: str) -> str:
    """h'(z)."""
    steps = [f"{change}*0.5*(1 + ({z} - {k})/sqrt(({z} - {k})^2 + {w}^2))" for k, w, change in _corners()]
    return "(" + " + ".join([f"({_C}2 - {_C}1)/({_K}2 - {_K}1)", *steps]) + ")"


def slot_laws(slots: Sequence[Slot], model: Model) -> tuple[Law, ...]:
    """What may be missing at each slot: a term that depends on one of the variables the slot sees.

    A slot with two sides, `q1` of `p1` and `q2` of `p2`, gets one law for both. Where it hands a value on with its
    rate, `y` with `y_t`, the term's rate goes along. Of a signal without a known rate the rate is tried as well.
    """
    known = {v.name for v in model.variables}
    found: list[Law] = []
    for slot in slots:
        own = tuple(v for v in slot.sees if f"{slot.name}.{v}" in known)
        found += _laws_of(slot, own, set(model.abilities.states))
    return tuple(found)


def _laws_of(slot: Slot, sees: tuple[str, ...], states: set[str]) -> Iterator[Law]:
    def full(name: str) -> str:
        return f"{slot.name}.{name}" if name else ""

    outputs = [v for v in slot.gives if not _rate_of(v, slot.gives)]
    pairs = _sides(outputs, sees)
    if pairs:
        argument = _bare(pairs[0][1])
        yield Law(slot.name, full(argument), tuple(Copy(full(y), full(z)) for y, z in pairs))
        return
    free = [v for v in slot.gives if full(v) not in states]
    if any(full(v) in states for v in slot.gives) and free:  # it moves by itself: what drives it, by how it moves
        for z in (v for v in slot.gives if full(v) in states):
            yield Law(slot.name, full(z), (Copy(full(free[-1]), full(z)),))
            if _rate_of(z, slot.gives):  # what moves, moves other than by its rate
                yield Law(slot.name, full(z), (Copy(full(z[:-2]), full(z)),))
        return
    for y in outputs:
        y_t = f"{y}_t" if f"{y}_t" in slot.gives else ""
        for z in sees:
            z_t = f"{z}_t" if f"{z}_t" in sees else ""
            for late in LAGS if z in slot.nodes else (0.0,):
                yield Law(slot.name, full(z), (Copy(full(y), full(z), full(y_t), full(z_t)),), late)
            if z == "s" and not y_t and not z_t:
                yield Law(slot.name, f"der({full(z)})", (Copy(full(y), full(z)),), of_rate=True)


def _rate_of(name: str, names: Sequence[str]) -> bool:
    return name.endswith("_t") and name[:-2] in names


def _bare(name: str) -> str:
    return re.sub(r"\d+$", "", name)


def _sides(outputs: Sequence[str], sees: Sequence[str]) -> list[tuple[str, str]]:
    """Outputs and what they see by their numbers, where the slot has two or more sides."""
    numbers = [re.search(r"\d+$", y) for y in outputs]
    if len(outputs) < 2 or not all(numbers) or len({_bare(y) for y in outputs}) != 1:
        return []
    found = []
    for y, number in zip(outputs, numbers, strict=True):
        own = [z for z in sees if number is not None and re.fullmatch(rf"[A-Za-z_]+{number[0]}", z)]
        if not own:
            return []
        found.append((y, own[0]))
    return found


def state_laws(model: Model) -> tuple[Law, ...]:
    """For a model without slots: a term in each state's equation that depends on a state that it depends on already."""
    ability = model.abilities
    found: list[Law] = []
    for k, state in enumerate(ability.states):
        depends = ability.dependencies[k] if k < len(ability.dependencies) else None
        for other in ability.states:
            if other == state or depends is None or other in depends:
                found.append(Law(f"der({state})", other, (Copy(state, other),)))
    return tuple(found)
