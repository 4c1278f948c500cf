"""Refuses arrays, ranges and chains of parameters that rumoca 0.10.2 would write out until time or memory ends.

It writes out each element of a value, and each step of a loop. For a chain of parameters, each calculated from the one
before, its time and memory grow with the square of the length: 3 s and 1 GB for 1,000, 11 s and 3.6 GB for 2,000.
"""

import math
from collections.abc import Iterator, Mapping
from graphlib import CycleError, TopologicalSorter
from itertools import islice

from fmu_build.errors import BuildError
from fmu_build.front.flat_model import FlatModel
from fmu_build.text.classes import ClassText
from fmu_build.text.declarations import Declaration, Kind
from fmu_build.text.expressions import MOST_ELEMENTS, Value, literal
from fmu_build.text.lookup import Libraries
from fmu_build.text.tokens import Tokens, bracket, split

_LONGEST_CHAIN = 1_000  # parameters that follow from each other, see above
_SIZES_BEHIND = {"zeros": 0, "ones": 0, "fill": 1, "linspace": 2}  # how many arguments stand ahead of the sizes


def refuse_enormous_texts(source: ClassText, classes: Libraries) -> None:
    """Look through the class and all classes that make it up, for sizes of literals and of parameters' own values.

    Raises:
        TextError: an array, a range or a chain is too long; says where.
    """
    for here in classes.used(source):
        known = _integers(here, classes)
        for size, offset in _sizes(here, known):
            if size > MOST_ELEMENTS:
                raise here.error(_too_many(f"{size:,.0f} elements"), offset)
        for name, length in _chains(here):
            if length > _LONGEST_CHAIN:
                at = next(one.start for one in here.of_kind(Kind.COMPONENT) if one.name == name)
                raise here.error(
                    f"{name} is the last of {length:,} parameters that each follow from the one before, of which "
                    f"{_LONGEST_CHAIN:,} are supported; give it a value of its own, or calculate it in a function",
                    at,
                )


def refuse_enormous_models(
    source: ClassText, classes: Libraries, model: FlatModel, overrides: Mapping[str, float | str]
) -> None:
    """Count scalars and steps of loops, now that all sizes are known.

    Raises:
        BuildError: there are too many; says of which variable.
    """
    largest = max(model.variables, key=lambda one: math.prod(one.dimensions), default=None)
    count = sum(math.prod(one.dimensions) for one in model.variables)
    if largest is not None and count > MOST_ELEMENTS:
        many = f"{count:,} variables, {math.prod(largest.dimensions):,} of them in {largest.name}"
        raise BuildError(_too_many(many), largest.span.file, largest.span.line)
    for loop in model.loops:
        steps = math.prod(len(range(low, high + (1 if step > 0 else -1), step)) for low, high, step in loop.ranges)
        if steps > MOST_ELEMENTS:
            raise BuildError(_too_many(f"{steps:,} steps of a loop"), *source.place(source.start))


def _too_many(what: str) -> str:
    return f"{what} are too many, of which {MOST_ELEMENTS:,} are supported; choose a smaller size"


def _integers(here: ClassText, classes: Libraries) -> Mapping[str, Value]:
    """Values of Integer parameters and constants of a class and its bases, as far as they are literals."""
    found: dict[str, Value] = {}
    for one in classes.ancestry(here):
        for declaration in one.of_kind(Kind.COMPONENT):
            if declaration.class_name == "Integer" and _is_fixed(declaration) and not declaration.dimensions:
                value = _number(one, declaration.value, found)
                if value is not None:
                    found.setdefault(declaration.name, value)
    return found


def _is_fixed(declaration: Declaration) -> bool:
    return bool({"parameter", "constant"} & declaration.prefixes)


def _number(here: ClassText, tokens: Tokens, known: Mapping[str, Value]) -> float | None:
    try:
        value = literal(here.text(tokens), known)
    except ValueError:
        return None
    return value if isinstance(value, float | int) else None


def _sizes(here: ClassText, known: Mapping[str, Value]) -> Iterator[tuple[float, int]]:
    """Numbers of elements, and where they are written: of components, of `fill` and its like, of ranges."""

    def product(sizes: Iterator[Tokens]) -> float:
        return math.prod(abs(value) for size in sizes if (value := _number(here, size, known)) is not None)

    for declaration in here.of_kind(Kind.COMPONENT):
        if declaration.dimensions:
            yield product(split(declaration.dimensions[1:-1], ",")), declaration.start
    tokens = here.own_tokens
    for at, token in enumerate(tokens):
        if token.text in _SIZES_BEHIND and (inside := bracket(tokens, at + 1)[1:-1]):
            yield product(islice(split(inside, ","), _SIZES_BEHIND[token.text], None)), token.start
        elif token.text == ":" and 0 < at < len(tokens) - 1:
            low, high = (_number(here, tokens[k : k + 1], known) for k in (at - 1, at + 1))
            if low is not None and high is not None:
                yield high - low + 1, token.start


def _chains(here: ClassText) -> Iterator[tuple[str, int]]:
    """The parameters of a class, each with the number of parameters in the longest chain that ends in it."""
    fixed = {one.name: one for one in here.of_kind(Kind.COMPONENT) if _is_fixed(one)}
    used = {name: {t.text for t in one.value if t.text in fixed} for name, one in fixed.items()}
    lengths: dict[str, int] = {}
    try:
        for name in TopologicalSorter(used).static_order():
            lengths[name] = 1 + max((lengths[other] for other in used[name]), default=0)
            yield name, lengths[name]
    except CycleError:  # said behind the compiler, if it is one: a branch that is not taken may close it
        return
