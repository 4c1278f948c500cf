"""The slots of a model: its replaceable parts, what they take, and which effects of a catalogue fit."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from fmu_build.text import ClassText, Declaration, Libraries
from fmu_build.text.declarations import Kind
from fmu_build.text.statements import statements
from fmu_build.text.tokens import split
from fmu_build.text.write import quoted
from pysim.effects._text import as_bad_input, changes, is_input, known_class, with_full_names
from pysim.effects.catalogue import input_signal, read_pairs
from pysim.types import BadInput, Effect

_PAIR = ("first", "second")  # parts of a class that puts two effects into one slot
_EQUALS = re.compile(r"(?<![<>=:])=(?!=)")  # of an equation
_GIVEN = re.compile(r"(?:der\s*\(\s*(\w+)\s*\)|(\w+))\s*=")


@dataclass(frozen=True)
class Slot:
    """One replaceable part of a model.

    Args:
        name: of the part.
        filling: full name of the class that fills it in the model as it is.
        takes: full name of the class that whatever fills it has to extend.
        gives: variables of `takes` that the filling's own equations give, by themselves or by their derivative: where
            a missing term would stand, "NAME.variable" in the compiled model.
        description: in words.
        sees: the other variables of `takes`, as far as they are numbers that change: what a term may depend on.
        nodes: those of them that are no inputs: they follow from the connectors, and answer to the term at once.
    """

    name: str
    filling: str
    takes: str
    gives: tuple[str, ...]
    description: str = ""
    sees: tuple[str, ...] = ()
    nodes: tuple[str, ...] = ()


def slots(class_name: str, libraries: Sequence[Path]) -> tuple[Slot, ...]:
    """The slots that a class declares or inherits.

    Args:
        class_name: full name of the model.
        libraries: where it, its slots' fillings and their partial classes are.
    Raises:
        BadInput: no such class.
    """
    library = Libraries(libraries)
    found: dict[str, Slot] = {}
    with as_bad_input():
        for own in library.ancestry(known_class(class_name, library)):
            for declaration in own.of_kind(Kind.COMPONENT):
                if "replaceable" in declaration.prefixes:
                    slot = _slot(declaration, own, library)
                    if slot is not None:
                        found.setdefault(slot.name, slot)
    return tuple(found.values())


def fitting(effects: Sequence[Effect], class_name: str, libraries: Sequence[Path]) -> tuple[Effect, ...]:
    """Those effects that a slot of the model takes: by the slot's name, and by the class that they extend.

    Raises:
        BadInput: no such class.
    """
    takes = {slot.name: slot.takes for slot in slots(class_name, libraries)}
    library = Libraries(libraries)

    def fits(effect: Effect) -> bool:
        text = library.full(effect.class_name)
        return text is not None and any(one.full_name == takes.get(effect.slot) for one in library.ancestry(text))

    with as_bad_input():
        return tuple(effect for effect in effects if fits(effect))


@dataclass(frozen=True)
class Filling:
    """What fills a slot, in parts that a class with a further term can be written from, names of classes in full.

    Args:
        modifications: of the partial class that it extends.
        declarations: its own, without semicolons; parameters are final, since they belong to no effect.
        equations: (left, right) of each; "" and the whole text of one that is no equation of two sides.
        initial: those of the initial section.
    """

    modifications: tuple[str, ...]
    declarations: tuple[str, ...]
    equations: tuple[tuple[str, str], ...]
    initial: tuple[str, ...]


def filling(slot: Slot, libraries: Sequence[Path], *, final: bool = True) -> Filling:
    """The class that fills a slot in the model as it is.

    Args:
        final: whether its parameters cannot be set any more.
    Raises:
        BadInput: it inherits its law, or has more than declarations and plain equations.
    """
    library = Libraries(libraries)
    with as_bad_input():
        text = known_class(slot.filling, library)
        bases = [library.resolve(one.class_name, text) for one in text.of_kind(Kind.EXTENDS)]
        if [base.full_name for base in bases if base] != [slot.takes] and slot.filling != slot.takes:
            raise BadInput(f"{slot.filling} inherits its law; write a class for the slot {slot.name} by hand")
        found = list(statements(text.own_tokens))
        has_more = any(token.text == "algorithm" for token in text.own_tokens) or any(one.branches for one in found)
        if has_more or any(text.of_kind(Kind.CLASS)):
            raise BadInput(f"{slot.filling} is more than equations; write a class for the slot {slot.name} by hand")
        parts = [part for one in text.of_kind(Kind.EXTENDS) for part in split(one.arguments, ",")]
        modifications = [with_full_names(text.text(part), text, library) for part in parts]
        declared = [_declared(one, text, library, final) for one in text.of_kind(Kind.COMPONENT)]
        own = {one.start for one in text.equations}
        written = [(one.start, with_full_names(text.text(one.tokens).rstrip("; \n"), text, library)) for one in found]
    equations = [equation for start, equation in written if start in own]
    initial = [equation for start, equation in written if start not in own and not equation.startswith("annotation")]
    sides = [_EQUALS.split(one, maxsplit=1) for one in equations]
    pairs = [(s[0].strip(), s[1].strip()) if len(s) == 2 else ("", s[0]) for s in sides]
    return Filling(tuple(modifications), tuple(declared), tuple(pairs), tuple(initial))


def paired(slot: Slot, effects: Sequence[Effect], libraries: Sequence[Path]) -> Filling:
    """What fills a slot with two effects, `first` and `second` of a pair of the libraries.

    Raises:
        BadInput: no pair takes them, or one of them has a signal from outside the slot.
    """
    pair = next((one for one in read_pairs(*libraries) if one.slot == slot.name and not one.of), None)
    library = Libraries(libraries)
    texts = [library.full(one.class_name) for one in effects]
    outside = any(input_signal(d) for text in texts if text for d in text.of_kind(Kind.COMPONENT))
    if pair is None or len(effects) != 2 or outside:
        names = " and ".join(one.name for one in effects)
        raise BadInput(f"{names} cannot share a class of the slot {slot.name}; write one by hand")
    parts, named = filling(replace(slot, filling=pair.class_name), libraries), dict(zip(_PAIR, effects, strict=True))
    own = {name: f"{one.class_name} {name} {quoted(one.description)}" for name, one in named.items()}
    declared = (next((own[name] for name in own if f" {name} " in one), one) for one in parts.declarations)
    return replace(parts, declarations=tuple(declared))


def _declared(one: Declaration, owner: ClassText, library: Libraries, final: bool) -> str:
    known = library.resolve(one.class_name, owner)
    prefixes = one.prefixes - {"replaceable"} | ({"final"} if final and "parameter" in one.prefixes else set())
    words = [*sorted(prefixes), known.full_name if known else one.class_name]
    rest = with_full_names(owner.text(one.dimensions) + owner.text(one.modification), owner, library)
    about = f" {quoted(one.description)}" if one.description else ""
    return f"{' '.join(words)} {one.name}{rest}{about}"


def _slot(declaration: Declaration, owner: ClassText, library: Libraries) -> Slot | None:
    """None for what is replaceable but no component of a class in the libraries."""
    filling = library.resolve(declaration.class_name, owner)
    if filling is None:
        return None
    takes = library.resolve(declaration.constraining, owner) if declaration.constraint else None
    if takes is None:  # Modelica's rule is the declared class itself; a filling without a law extends what is meant
        base = next(filling.of_kind(Kind.EXTENDS), None)
        takes = (library.resolve(base.class_name, filling) if base else None) or filling
    owned = list(library.ancestry(takes))
    declared = {d.name: d for text in owned for d in text.of_kind(Kind.COMPONENT)}
    laws = [text for text in library.ancestry(filling) if filling is takes or text not in owned]
    names = [name for name in _given(laws) if name in declared and not is_input(declared[name])]
    gives = tuple(dict.fromkeys(names))
    others = {d.name: is_input(d) for text in owned for d in text.of_kind(Kind.COMPONENT) if changes(d, text, library)}
    sees = tuple(name for name in others if name not in gives)
    nodes = tuple(name for name in sees if not others[name])
    about = " ".join(declaration.description.split())
    return Slot(declaration.name, filling.full_name, takes.full_name, gives, about, sees, nodes)


def _given(laws: Sequence[ClassText]) -> Iterator[str]:
    for text in laws:
        for outer in text.equations:
            for equation in (outer, *outer.inside()):
                match = _GIVEN.match(text.text(equation.tokens))
                if match:
                    yield match[1] or match[2]
