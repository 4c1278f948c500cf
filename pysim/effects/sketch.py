"""An effect's law as a few strokes: a curve, a family of curves, or an answer to a wave where it has a memory."""

from __future__ import annotations

import contextlib
import math
import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pysim.effects.law import Law, Moment, read_law
from pysim.effects.slots import Slot
from pysim.types import Effect

_POINTS, _STEEP, _STEPS = 81, 25.0, 240
_PERIODS, _SLOW = 1.5, 10.0  # of the wave that is answered; its period over the law's shortest time
_FAMILY = (-1.0, 0.0, 1.0)  # shares of its range at which a second variable is held
_ALIKE = 6.0  # times that wave and answer may differ in size and still be drawn to one scale
_RATES = (("x", "v"), ("phi", "w"))  # names whose second is the first's derivative, beside NAME and NAME_t
_PER_SECOND, _SECONDS = ("1/s", "rad/s", "Hz"), ("s", "ms")

Array = NDArray[np.float64]
Curve = tuple[list[float], list[float]]


@dataclass(frozen=True)
class Sketch:
    """What a few strokes can show.

    Args:
        curves: x and y, between -1 and 1; over time the wave first and the answer behind it.
        words: what is drawn over what.
        over_time: whether the law has a memory.
    """

    curves: tuple[Curve, ...]
    words: str
    over_time: bool = False


@dataclass(frozen=True)
class Sizes:
    """Numbers that a law is drawn with.

    Args:
        parameters: of the effect, at sizes that show, with their units.
        fixed: constants of its class.
        around: parameters of the model, for those that its slot has too.
        written: the constants, as the class writes them.
    """

    parameters: Mapping[str, tuple[float, str]]
    fixed: Mapping[str, float]
    around: Mapping[str, tuple[float, str]]
    written: str = ""

    def numbers(self) -> dict[str, float]:
        """Name -> value."""
        own = {name: value for name, (value, _) in self.parameters.items()}
        return {**{name: value for name, (value, _) in self.around.items()}, **self.fixed, **own}


def sketch(law: str, sees: Sequence[str], gives: Sequence[str], sizes: Sizes) -> Sketch | None:
    """A law as a picture.

    A width beside the variable in a quotient, as that of a sign change, is taken as a small part of the axis.

    Args:
        law: equations as the class writes them.
        sees, gives: variables of its slot.
        sizes: of all that it names.
    Returns:
        None for a law that is more than a few strokes can show.
    """
    try:
        read = read_law(law)
        target = next(name for name in gives if name in read.values or name in read.rates or name in read.sampled)
        arguments = [name for name in sees if name in read.needs(target)]
        if read.remembers(target):
            return _answer(read, law, target, arguments, sizes)
        return _curves(read, law, target, arguments, sizes)
    except (ValueError, StopIteration, np.linalg.LinAlgError):
        return None


def constants(written: Mapping[str, str], known: Mapping[str, float]) -> dict[str, float]:
    """Values of constants that are numbers, or a few functions of numbers and parameters."""
    found: dict[str, float] = {}
    for name, text in written.items():
        with contextlib.suppress(ValueError):
            found[name] = float(Moment(read_law(f"{name} = {text}"), {**known, **found})[name])
    return found


def law_sketch(
    effect: Effect, slot: Slot, constants_written: Mapping[str, str], around: Mapping[str, tuple[float, str]]
) -> Sketch | None:
    """The picture of an effect's law in a slot of a model, at its parameters' usual sizes.

    Args:
        constants_written: what else the law names, as its class writes it.
        around: the model's parameters with their units.
    """
    own = {p.name: (p.nominal or p.default, p.unit) for p in effect.parameters}
    known = {name: value for name, (value, _) in {**around, **own}.items()}
    sizes = Sizes(own, constants(constants_written, known), around, " ".join(constants_written.values()))
    return sketch(effect.law, slot.sees, slot.gives, sizes)


def _curves(read: Law, law: str, target: str, arguments: Sequence[str], sizes: Sizes) -> Sketch | None:
    """Over the first variable, for some values of the second."""
    if len(arguments) > 2:
        return None
    spans = {name: _span(law, name, sizes) for name in arguments}
    known = sizes.numbers() | _widths(law, spans)
    shares = np.linspace(-1.0, 1.0, _POINTS)
    over, other = arguments[0] if arguments else "", arguments[1] if len(arguments) > 1 else ""

    def row(held: float) -> Array:
        at = {name: spans[name] * where for name, where in ((over, shares), (other, held)) if name}
        return np.broadcast_to(np.asarray(Moment(read, known | at)[target], float), shares.shape)

    rows = np.array([row(held) for held in (_FAMILY if other else (0.0,))])
    if np.all(rows == rows[0]):
        rows = rows[:1]
    half = _POINTS // 2
    if np.max(np.abs(rows[0, :half])) > 20 * np.max(np.abs(rows[0, half + 1 :])):
        rows, shares = rows[:, half:], 2 * shares[half:] - 1  # a floor that only keeps a quotient finite is left out
    size = float(np.max(np.abs(rows)))
    if not (math.isfinite(size) and size > 0):
        return None
    words = f"{target} over {over}" if over else target
    words += f", for three values of {other}" if len(rows) > 1 else ""
    return Sketch(tuple((shares.tolist(), (one / size).tolist()) for one in rows), words)


def _answer(read: Law, law: str, target: str, arguments: Sequence[str], sizes: Sizes) -> Sketch | None:
    """Over time, while the slot's first variable is a wave and a variable that is its rate goes along."""
    wave, *others = arguments
    period, size = _period(law, sizes), _span(law, wave, sizes)
    if any(name != f"{wave}_t" and (wave, name) not in _RATES for name in others):
        return None
    course = _Course(read, [name for name in read.rates if name in {target, *read.needs(target)}], size)
    known, turn = sizes.numbers(), 2 * math.pi / period
    ins, outs = [], []
    for k in range(_STEPS + 1):
        time = k * _PERIODS * period / _STEPS
        given = known | dict.fromkeys(others, size * turn * math.cos(turn * time))
        given[wave] = size * math.sin(turn * time)
        ins.append(given[wave])
        outs.append(course.go(given, time, _PERIODS * period / _STEPS)[target])
    return _drawn_over_time(ins, outs, f"{target} and {wave} over time")


class _Course:
    """A law with a memory from moment to moment.

    Args:
        law: its equations.
        states: names that have a derivative.
        size: of the wave, by which small steps are judged.
    """

    def __init__(self, law: Law, states: Sequence[str], size: float) -> None:
        self._law, self._states, self._size = law, states, size
        self._values: Array = np.zeros(len(states))
        self._kept, self._due = dict.fromkeys(law.sampled, 0.0), dict.fromkeys(law.sampled, 0.0)
        self._before: dict[str, float] = {}

    def go(self, given: Mapping[str, float], time: float, step: float) -> Moment:
        """What is at a time, s; the states go on by a step, s."""

        def moment(values: Array) -> Moment:
            own = dict(zip(self._states, map(float, values), strict=True))
            return Moment(self._law, {**given, **self._kept, **own}, self._before)

        now = moment(self._values)
        for name, (what, interval) in self._law.sampled.items():
            if time >= self._due[name] - 1e-6 * step:
                self._kept[name], self._due[name] = now.value(what), self._due[name] + max(now.value(interval), step)
        now = moment(self._values)
        self._values = _stepped(self._law, self._states, self._values, moment, step, self._size)
        after = moment(self._values)
        for name, (what, conditions) in self._law.resets.items():
            if name in self._states and any(after.value(c) and not now.value(c) for c in conditions):
                self._values[list(self._states).index(name)] = after.value(what)
        self._before = {name: after[name] for name in self._law.looks_back()}
        return now


def _stepped(
    read: Law, states: Sequence[str], values: Array, moment: Callable[[Array], Moment], step: float, size: float
) -> Array:
    """One step that stays calm however fast a state follows: implicit in the law's slope."""
    if not states:
        return values

    def rate(own: Array) -> Array:
        now = moment(own)
        return np.array([now.value(read.rates[n][0]) / now.value(read.rates[n][1]) for n in states])

    first = rate(values)
    nudge = 1e-6 * size
    slope = np.column_stack([(rate(values + nudge * unit) - first) / nudge for unit in np.eye(len(states))])
    return np.asarray(values + np.linalg.solve(np.eye(len(states)) - step * slope, step * first))


def _drawn_over_time(ins: list[float], outs: list[float], words: str) -> Sketch | None:
    size, high = max(map(abs, ins)), max(map(abs, outs))
    if not (math.isfinite(high) and high > 0):
        return None
    both = max(size, high)
    scales = (both, both) if both < _ALIKE * min(size, high) else (size, high)
    x = [2 * k / (len(ins) - 1) - 1 for k in range(len(ins))]
    curves = ((x, [v / scales[0] for v in ins]), (x, [v / scales[1] for v in outs]))
    return Sketch(curves, words, over_time=True)


def _span(law: str, name: str, sizes: Sizes) -> float:
    """Half of a variable's axis: some sizes of what stands beside it, or beside any variable, in a sum or a comparison;
    else 1."""
    numbers = {n: v for n, (v, unit) in sizes.parameters.items() if unit not in (*_SECONDS, *_PER_SECOND)}
    for other, value in numbers.items():
        if value and re.search(rf"\b{name}\s*(?:[-+<>]|>=|<=)\s*-?\s*{other}\b", law):
            return 3 * abs(value)
        if value and re.search(rf"\babs\({name}\)\s*/\s*{other}\b", law):
            return 4 * abs(value)
    for other, value in (numbers | dict(sizes.fixed)).items():
        if value and re.search(rf"\b{name}\s*\+\s*{other}\b|(?:[<>]=?|[a-z]\s*[-+])\s*-?\s*{other}\b(?!\s*[*/^])", law):
            return 3 * abs(value)
    return 1.0


def _widths(law: str, spans: Mapping[str, float]) -> dict[str, float]:
    """What a variable is divided by, as a small part of its axis, where nobody gives it or it is a constant."""
    found: dict[str, float] = {}
    for name, span in spans.items():
        for other in re.findall(rf"\b{name}\s*/\s*([a-z]\w*)", law):
            found[other] = span / _STEEP
    return found


def _period(law: str, sizes: Sizes) -> float:
    """Of a wave that the law's times show in, s; 1 for a law without one."""
    times = []
    for name, (value, unit) in {**sizes.around, **sizes.parameters}.items():
        if value and re.search(rf"\b{name}\b", f"{law} {sizes.written}"):
            times += [abs(value)] if unit in _SECONDS else [1 / abs(value)] if unit in _PER_SECOND else []
    return _SLOW * min(times, default=1 / _SLOW)
