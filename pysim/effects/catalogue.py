"""The catalogue of effects, read from the Modelica classes themselves."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from textwrap import dedent
from typing import Any

from fmu_build.text import ClassText, Declaration, Libraries
from fmu_build.text.declarations import Kind, Modifier, modifiers
from fmu_build.text.expressions import literal
from fmu_build.text.libraries import bundled_library, files_of, read_text
from fmu_build.text.tokens import string_value
from pysim.effects._text import as_bad_input, attributes_of, known_class
from pysim.effects.law import check_unit
from pysim.types import BadInput, Effect, EffectParameter

VENDOR = "__HydraulicTestBench"  # the annotation's name
STANDARD_LIBRARY = bundled_library()
_Said = Mapping[str, Modifier]


@dataclass(frozen=True)
class Pair:
    """A class that puts two effects into one slot.

    Args:
        slot: which.
        class_name: full name.
        of: the two effects it is for, whose parameters it has itself; none where it takes any two fillings as
            `first` and `second`.
    """

    slot: str
    class_name: str
    of: tuple[str, ...] = ()


def read_catalogue(*libraries: Path) -> tuple[Effect, ...]:
    """Every effect of some libraries, in the order of their files' names.

    A class is an effect when its annotation says `__HydraulicTestBench(effect="...", slot="...")`. Of its parameters
    those with the declared value 0 are strengths, with 0 for off (another off value is stated by `start`); `min`, `max`
    and `nominal` are bounds and size. Of an array each element is a parameter, `c[1]`, `c[2]`, ... An input annotated
    with `signal="chamber1.p"` takes this signal of the model where `variant` puts the effect in. A class annotated with
    `smooth="..."` is that effect without events.

    Args:
        libraries: folders with a package.mo, or .mo files. A user's own go behind ours.
    Raises:
        BadInput: two effects of one name, or a parameter without bounds or unit; with file and class.
    """
    with as_bad_input():
        texts = tuple((file, read_text(file)) for place in libraries for file, _ in files_of(place))
        return _effects(libraries, texts)


@lru_cache(maxsize=16)
def _effects(libraries: tuple[Path, ...], texts: tuple[tuple[Path, str], ...]) -> tuple[Effect, ...]:
    """What `read_catalogue` gives, read again only where a text of the libraries has changed."""
    library = Libraries(libraries)
    found: dict[str, ClassText] = {}
    effects = []
    annotated = list(_annotated(library))
    smooth = {name: _effect(name, text, said, library) for text, said in annotated if (name := _string(said, "smooth"))}
    for text, said in annotated:
        if "effect" not in said:
            continue
        name = _string(said, "effect")
        if name in found:
            other = found[name].source.file
            raise BadInput(f"{text.source.file}: the effect {name} is also in {other}; rename one of the two")
        found[name] = text
        effects.append(_effect(name, text, said, library, smooth.get(name)))
    return tuple(effects)


def read_pairs(*libraries: Path) -> tuple[Pair, ...]:
    """Every class that puts two effects into one slot, annotated with `pair="slot"`.

    Raises:
        BadInput: a library cannot be read.
    """
    with as_bad_input():
        return tuple(
            Pair(_string(said, "pair"), text.full_name, _strings(said, "of"))
            for text, said in _annotated(Libraries(libraries))
            if "pair" in said
        )


def law_constants(effect: Effect, libraries: Sequence[Path]) -> dict[str, str]:
    """What else the law of an effect names: values, as written, of constants and of parameters that nobody sets.

    Raises:
        BadInput: the effect's class is in none of the libraries.
    """
    own = {parameter.name for parameter in effect.parameters}
    with as_bad_input():
        text = known_class(effect.class_name, Libraries(libraries))
    declared = [d for d in text.declarations if d.prefixes & {"constant", "parameter"}]
    return {d.name: d.text(d.value) for d in declared if d.value and d.name not in own and f"{d.name}[1]" not in own}


def input_signal(declaration: Declaration) -> str:
    """The model's signal that an input of an effect takes, annotated with `signal="chamber1.p"`; "" for none."""
    said = modifiers(declaration.annotation).get(VENDOR)
    return _string(modifiers(said.inside), "signal") if said is not None else ""


def _annotated(library: Libraries) -> Iterator[tuple[ClassText, _Said]]:
    """Classes with the annotation, and what it says."""
    for text in library.classes(VENDOR):
        said = modifiers(text.annotation).get(VENDOR)
        if said is not None:
            yield text, modifiers(said.inside)


def _effect(name: str, text: ClassText, said: _Said, library: Libraries, smooth: Effect | None = None) -> Effect:
    file = text.source.file
    if "slot" not in said:
        raise BadInput(f'{file}: the effect {name} fills no slot; write slot="..." into its annotation')
    parameters: list[EffectParameter] = []
    for declaration in text.of_kind(Kind.COMPONENT):
        if "parameter" in declaration.prefixes and "final" not in declaration.prefixes:
            parameters += _parameters(declaration, text, library)
    try:
        return Effect(
            name,
            _string(said, "slot"),
            text.full_name,
            tuple(parameters),
            _on_one_line(text.description),
            "bypass" in said and text.text(said["bypass"].value) == "true",
            _law(text),
            smooth,
        )
    except BadInput as error:
        raise BadInput(f"{file}: {error}") from error


def _law(text: ClassText) -> str:
    """Its equations as written, each from the first column on."""
    found = []
    for statement in text.equations:
        column = statement.start - text.source.text.rfind("\n", 0, statement.start) - 1
        found.append(dedent(" " * column + text.text(statement.tokens)))
    return "\n".join(found)


def _parameters(declaration: Declaration, text: ClassText, library: Libraries) -> Iterator[EffectParameter]:
    """A parameter, or each element of a vector of them."""
    where = f"{text.source.file}: {declaration.name}"
    attributes = attributes_of(declaration, text, library)
    for attribute in ("min", "max", "unit"):
        if attribute not in attributes:
            raise BadInput(
                f"{where} has no {attribute}, which a fit needs; write it there, or declare constant what stays"
            )
    unit = attributes["unit"].strip().strip('"')
    try:
        check_unit(unit)
    except ValueError as error:
        raise BadInput(f"{where}: {error}") from error
    if not declaration.value:
        raise BadInput(f"{where} has no value; declare it with = 0 for off, or with a usual size")
    known = _integers(text)
    default = _number(declaration.text(declaration.value), where, known)
    numbers = {name: _number(value, where, known) for name, value in attributes.items() if name in _NUMBERS}
    count = _size(declaration, where, known)
    if count is None:
        yield _parameter(declaration.name, default, numbers, unit, declaration, where)
        return
    for k in range(count):
        own = {name: _element(value, k, count, where) for name, value in numbers.items()}
        name, value = f"{declaration.name}[{k + 1}]", _element(default, k, count, where, of_value=True)
        yield _parameter(name, value, own, unit, declaration, where)


_NUMBERS = ("min", "max", "nominal", "start")


def _parameter(
    name: str, default: Any, numbers: Mapping[str, Any], unit: str, declaration: Declaration, where: str
) -> EffectParameter:
    if any(isinstance(value, tuple) for value in (default, *numbers.values())):
        raise BadInput(f"{where} has an array where a number is meant; write a number, or declare it as an array")
    low, high = numbers["min"], numbers["max"]
    off = numbers.get("start", 0.0 if default == 0 else None)
    said = modifiers(declaration.annotation).get(VENDOR)
    inside = modifiers(said.inside) if said else {}
    try:
        return EffectParameter(
            name,
            unit,
            low,
            high,
            numbers.get("nominal", max(abs(low), abs(high)) / 10),
            default,
            off,
            _on_one_line(declaration.description),
            _string(inside, "inverse"),
            _string(inside, "limits"),
        )
    except BadInput as error:
        raise BadInput(f"{declaration.source.file}: {error}") from error


def _integers(text: ClassText) -> dict[str, float]:
    """The class' Integer constants and parameters with their values, for sizes of arrays."""
    found: dict[str, float] = {}
    for declaration in text.of_kind(Kind.COMPONENT):
        if declaration.class_name == "Integer" and declaration.prefixes & {"constant", "parameter"}:
            with suppress(ValueError):  # one that is calculated is no size that can be known here
                found[declaration.name] = literal(declaration.text(declaration.value), found)
    return found


def _size(declaration: Declaration, where: str, known: Mapping[str, float]) -> int | None:
    """The number of elements of a vector; None for what is no array."""
    if not declaration.dimensions:
        return None
    size = _number(declaration.text(declaration.dimensions[1:-1]), where, known)
    if isinstance(size, tuple) or size != int(size) or size < 1:
        raise BadInput(f"{where} has the size {size}; give one whole number, as in {declaration.name}[9]")
    return int(size)


def _element(value: Any, k: int, count: int, where: str, *, of_value: bool = False) -> Any:
    """Of an array its element; of an attribute that is one number, this for each element."""
    if not isinstance(value, tuple) and not of_value:
        return value
    if not isinstance(value, tuple) or len(value) != count:
        raise BadInput(f"{where} has {count} elements; give as many values, as in zeros({count})")
    return value[k]


def _number(text: str, where: str, known: Mapping[str, float]) -> Any:
    """A number, or a tuple of numbers, from an expression of literals such as `50e-3`, `2*Constants.pi*5`, `zeros(9)`.

    Raises:
        BadInput: anything else; says where.
    """
    try:
        return literal(text, known)
    except ValueError as error:
        raise BadInput(f"{where}: {text.strip()!r} must be a number; write it out, such as 5e-3") from error


def _string(said: _Said, name: str) -> str:
    return _on_one_line(string_value(said[name].value)) if name in said else ""


def _strings(said: _Said, name: str) -> tuple[str, ...]:
    """Of `{"a", "b"}` both."""
    return tuple(string_value((token,)) for token in said[name].value if token.is_string) if name in said else ()


def _on_one_line(text: str) -> str:
    return " ".join(text.split())
