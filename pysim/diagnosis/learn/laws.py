"""Which laws may be missing at which places of a model, and the Modelica text that is compiled to try them.

A law is `factor*h(argument)`, added to a variable that a slot computes. h is the curve of `curve.py`. The argument is a
variable of the slot ("force.x"), another variable of the model, or `time` on the common clock of all records. The
factor is 1, a variable of the slot or its smooth sign, a bristle that follows a speed and remembers, or a tone
(`pysim.types.factor`).

If a slot has two sides, `q1` over `p1` and `q2` over `p2`, both get the same curve, and the law has the names of the
first side.

One model is compiled for each place. Its parameters choose argument and factor by weights (1 for the chosen one, 0 for
the others), and hold knots and coefficients, so that another law or other knots need no new compilation. One model with
terms at all places would make derivatives by the coefficients ten times as expensive.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pysim.effects import Slot
from pysim.effects.learned import widths
from pysim.types import Model
from pysim.types.factor import Factor, Form

Array = NDArray[np.float64]

TIME = "time"  # of the model, which runs on the common clock of all records
_SPEEDS = ("m/s", "rad/s")  # units of the variables that may pull on a bristle


def wrapped(base: str, term: Terms, name: str) -> str:
    """Modelica text of a class that extends the model `base` by a term."""
    return f'model {name} "{base} with a law more"\n  extends {base};\n{term.text}end {name};\n'


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
        outside: variables outside the slot that the law may depend on.
        speeds: indices of the speeds in `own` of the side; none in a slot with two sides, which share no bristle.
    """

    name: str
    key: str
    sides: tuple[Side, ...]
    outside: tuple[str, ...]
    speeds: tuple[int, ...] = ()

    @property
    def arguments(self) -> tuple[str, ...]:
        """Variables that laws may depend on: those of the first side, then those outside the slot."""
        return (*self.sides[0].own, *self.outside)

    def laws(self) -> Iterator[Law]:
        """All laws of this place without memory. The factor is never the argument itself, which the curve can hold."""
        for i in range(len(self.arguments)):
            yield Law(self, i)
        if self.sides[0].output_rate:
            return
        for factor in range(len(self.sides[0].own)):
            for i in range(len(self.arguments)):
                if i != factor:
                    yield Law(self, i, Form.VARIABLE, factor)
                    yield Law(self, i, Form.SIGN, factor)

    def coefficients(self, count: int) -> tuple[str, ...]:
        """Names of the parameters that hold the curve's values."""
        return tuple(f"{self.key}_c{i}" for i in range(1, count + 1))


@dataclass(frozen=True)
class Law:
    """One law: a place, an argument and a factor.

    Args:
        place: where it is added.
        chosen: index of its argument in `place.arguments`.
        form: what its factor is.
        by: index of the factor's variable in `own` of each side; None for 1 and for a tone.
        number: of the factor: the width over which a sign changes, in its variable's unit; the length of a bristle, in
            that unit times s; the phase of a tone, rad. The last two are refitted.
        rate: angular frequency of a tone, rad/s.
    """

    place: Place
    chosen: int
    form: Form = Form.ONE
    by: int | None = None
    number: float = 1.0
    rate: float = 0.0

    @property
    def argument(self) -> str:
        """Name of the argument on the first side."""
        return self.place.arguments[self.chosen]

    @property
    def factor(self) -> Factor:
        """The factor, with the name of its variable in the slot."""
        variable = "" if self.by is None else self.place.sides[0].own[self.by].removeprefix(f"{self.place.name}.")
        return Factor(self.form, variable, self.number, self.rate)

    @property
    def free(self) -> tuple[str, ...]:
        """Name of the parameter that holds the factor's number if it is refitted."""
        last = {Form.BRISTLE: "l", Form.TONE: "p"}.get(self.form)
        return (f"{self.place.key}_{last}",) if last else ()

    @property
    def start(self) -> Array:
        """(1,) start of the factor's number in the search, of a length its logarithm; (0,) if it is not refitted."""
        own = math.log(self.number) if self.form is Form.BRISTLE else self.number
        return np.full(len(self.free), own)

    @property
    def label(self) -> str:
        """The law as text, such as "force: sign(v) * h(force.x)", without the number of its factor."""
        own = self.factor
        forms = {Form.BRISTLE: f"bristle({own.variable})", Form.TONE: f"tone({self.rate / (2 * math.pi):.4g} Hz)"}
        factor = forms.get(self.form, str(own))
        return f"{self.place.name}: {factor + ' * ' if factor else ''}h({self.argument})"

    def seen(self, side: Side) -> tuple[str, str]:
        """Full names of argument and factor on one side; "" for the factor 1."""
        argument = (*side.own, *self.place.outside)[self.chosen]
        return argument, "" if self.by is None else side.own[self.by]

    def settings(self, knots: Array, unit: float = 1.0) -> dict[str, float]:
        """Parameter values that turn the compiled term into this law, with knots (m,); `unit` scales coefficients."""
        key, wide, form = self.place.key, widths(knots), self.form
        found = {f"{key}_u": unit}
        found |= {f"{key}_a{i}": float(i == self.chosen) for i in range(len(self.place.arguments))}
        found[f"{key}_b"] = float(form is Form.ONE)
        for i in range(len(self.place.sides[0].own)):
            found[f"{key}_b{i}"] = float(i == self.by and form is Form.VARIABLE)
            found[f"{key}_s{i}"] = float(i == self.by and form is Form.SIGN)
            found[f"{key}_d{i}"] = self.number if form is Form.SIGN else 1.0
            if self.free:
                found[f"{key}_m{i}"] = float(i == self.by and form is Form.BRISTLE)
        if self.free:
            found |= {f"{key}_t": float(form is Form.TONE), f"{key}_f": self.rate, self.free[0]: self.number}
        for i, (k, w) in enumerate(zip(knots.tolist(), wide.tolist(), strict=True), start=1):
            found[f"{key}_k{i}"], found[f"{key}_w{i}"] = k, w
        return found


@dataclass(frozen=True)
class Terms:
    """Terms at some places, off until their parameters are set.

    Args:
        places: get one term each.
        count: number of knots of each curve.
        memory: whether the factor may be a bristle or a tone, which costs a state.
    """

    places: tuple[Place, ...]
    count: int
    memory: bool = False

    @property
    def probes(self) -> tuple[str, ...]:
        """Which variable is added to which equation, in the form of `fmu_build.build(probes=...)`."""
        found = []
        for place in self.places:
            for i, side in enumerate(place.sides, start=1):
                found.append(f"{side.output}={place.key}_y{i}")
                if side.output_rate:
                    found.append(f"{side.output_rate}={place.key}_r{i}")
        return tuple(found)

    @property
    def text(self) -> str:
        """Modelica declarations and equations."""
        declared: list[str] = []
        equations: list[str] = []
        for place in self.places:
            key, numbers = place.key, range(1, self.count + 1)
            declared += [f"  parameter Real {name} = 0;" for name in place.coefficients(self.count)]
            declared += [f"  parameter Real {key}_k{i} = {i};" for i in numbers]
            declared += [f"  parameter Real {key}_w{i} = 0.25;" for i in numbers]
            declared += [f"  parameter Real {key}_a{i} = 0;" for i in range(len(place.arguments))]
            declared += [f"  parameter Real {key}_b = 0;", f"  parameter Real {key}_u = 1;"]
            for i in range(len(place.sides[0].own)):
                declared += [f"  parameter Real {key}_{weight}{i} = 0;" for weight in ("bsm" if self.memory else "bs")]
                declared += [f"  parameter Real {key}_d{i} = 1;"]
            if self.memory:
                declared += [f"  parameter Real {key}_{name} = 0;" for name in "tfp"]
                declared += [f"  parameter Real {key}_l = 1;"]
            for n, side in enumerate(place.sides, start=1):
                declared += [f"  Real {key}_z{n};", f"  Real {key}_h{n};", f"  Real {key}_y{n};"]
                seen = (*side.own, *place.outside)
                weighted = [f"{key}_a{i}*{name}" for i, name in enumerate(seen)]
                equations.append(f"  {key}_z{n} = {' + '.join(weighted)};")
                equations.append(f"  {key}_h{n} = {key}_u*({_curve(key, f'{key}_z{n}', self.count)});")
                factors = [f"{key}_b"]
                if not side.output_rate:
                    for i, name in enumerate(side.own):
                        factors += [f"{key}_b{i}*{name}", f"{key}_s{i}*tanh({name}/{key}_d{i})"]
                if self.memory:
                    factors.append(f"{key}_t*cos({key}_f*time + {key}_p)")
                    if place.speeds:
                        pulls = " + ".join(f"{key}_m{i}*{side.own[i]}" for i in place.speeds)
                        declared += [f"  Real {key}_v;", f"  Real {key}_s(start=0, fixed=true);"]
                        equations.append(f"  {key}_v = {pulls};")
                        equations.append(f"  der({key}_s) = ({key}_v - noEvent(abs({key}_v))*{key}_s)/{key}_l;")
                        factors.append(f"{key}_s")
                equations.append(f"  {key}_y{n} = ({' + '.join(factors)})*{key}_h{n};")
                if side.output_rate:
                    declared.append(f"  Real {key}_r{n};")
                    rate = " + ".join(f"{key}_a{i}*{name}" for i, name in enumerate(side.rates))
                    slope = _slope(key, f"{key}_z{n}", self.count)
                    equations.append(f"  {key}_r{n} = {key}_u*{key}_b*({slope})*({rate});")
        return "\n".join([*declared, "equation", *equations, ""])


def _turns(key: str, count: int) -> Iterator[tuple[str, str, str]]:
    """For each knot the Modelica text of its position, of its corner's width, and of the change of slope there."""
    rises = [f"({key}_c{i + 1} - {key}_c{i})/({key}_k{i + 1} - {key}_k{i})" for i in range(1, count)]
    for i in range(count):
        before, after = (rises[i - 1] if i else ""), (rises[i] if i < count - 1 else "")
        turn = f"{after} - {before}" if before and after else after or f"-{before}"
        yield f"{key}_k{i + 1}", f"{key}_w{i + 1}", turn


def _curve(key: str, z: str, count: int) -> str:
    ramps = [f"({turn})*0.5*({z} - {k} + sqrt(({z} - {k})^2 + {w}^2))" for k, w, turn in _turns(key, count)]
    return " + ".join([f"{key}_c1", *ramps])


def _slope(key: str, z: str, count: int) -> str:
    return " + ".join(
        f"({turn})*0.5*(1 + ({z} - {k})/sqrt(({z} - {k})^2 + {w}^2))" for k, w, turn in _turns(key, count)
    )


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
    """Time, inputs, and states outside all slots: a law over these makes no algebraic loop."""
    inner = tuple(f"{slot.name}." for slot in slots)
    states = [name for name in model.abilities.states if not name.startswith(inner)]
    own = {name for side in sides for name in side.own}
    return tuple(name for name in (*states, *_inputs(model), TIME) if name not in own)


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


def samples(law: Law, seen: Mapping[str, Array]) -> tuple[Array, Array]:
    """Samples (n,) of a law's argument and factor, all sides concatenated, from those of the model's variables.
    A bristle and a tone count as 1, which is the most that they reach."""
    z, by = [], []
    for side in law.place.sides:
        argument, factor = law.seen(side)
        z.append(seen[argument])
        value = seen[factor] if factor and not law.free else np.ones(z[-1].size)
        by.append(np.tanh(value / law.number) if law.form is Form.SIGN else value)
    return np.concatenate(z), np.concatenate(by)
