"""The slots of a model: its replaceable parts, what they take, and which effects of a catalogue fit."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from pysim.effects._classes import ClassText, Declaration
from pysim.effects._library import Libraries
from pysim.types import BadInput, Effect

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
    text = library.classes.get(class_name)
    if text is None:
        raise BadInput(f"no class {class_name} in the libraries; check its full name, and name its library")
    found: dict[str, Slot] = {}
    for own in _ancestry(text, library):
        for declaration in own.declarations:
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
        text = library.classes.get(effect.class_name)
        return text is not None and any(one.full_name == takes.get(effect.slot) for one in _ancestry(text, library))

    return tuple(effect for effect in effects if fits(effect))


def _slot(declaration: Declaration, owner: ClassText, library: Libraries) -> Slot | None:
    """None for what is replaceable but no component of a class in the libraries."""
    filling = library.resolve(declaration.type_name, owner.full_name)
    if filling is None:
        return None
    takes = library.resolve(declaration.constraint, owner.full_name) if declaration.constraint else None
    if takes is None:  # Modelica's rule is the declared class itself; a filling without a law extends what is meant
        base = filling.bases[0].class_name if filling.bases else ""
        takes = (library.resolve(base, filling.full_name) if base else None) or filling
    owned = list(_ancestry(takes, library))
    declared = {d.name: d for text in owned for d in text.declarations}
    laws = [text for text in _ancestry(filling, library) if filling is takes or text not in owned]
    names = [name for name in _given(laws) if name in declared and not _is_input(declared[name])]
    gives = tuple(dict.fromkeys(names))
    others = {d.name: _is_input(d) for text in owned for d in text.declarations if _changes(d, text, library)}
    sees = tuple(name for name in others if name not in gives)
    nodes = tuple(name for name in sees if not others[name])
    return Slot(declaration.name, filling.full_name, takes.full_name, gives, declaration.description, sees, nodes)


def _changes(declaration: Declaration, owner: ClassText, library: Libraries) -> bool:
    """Whether it is a real number that is no parameter."""
    if declaration.prefixes & {"parameter", "constant"}:
        return False
    resolved = library.resolve(declaration.type_name, owner.full_name)
    if resolved is None:
        return declaration.type_name == "Real"
    return resolved.kind == "type" or resolved.full_name.endswith((".RealInput", ".RealOutput"))


def _given(laws: Sequence[ClassText]) -> Iterator[str]:
    for text in laws:
        for equation in text.equations:
            match = _GIVEN.match(equation)
            if match:
                yield match[1] or match[2]


def _is_input(declaration: Declaration) -> bool:
    return "input" in declaration.prefixes or declaration.type_name.endswith("RealInput")


def _ancestry(text: ClassText, library: Libraries) -> Iterator[ClassText]:
    """The class, then all it extends, nearest first."""
    seen, queue = set(), [text]
    while queue:
        current = queue.pop(0)
        if current.full_name in seen:
            continue
        seen.add(current.full_name)
        yield current
        bases = (library.resolve(base.class_name, current.full_name) for base in current.bases)
        queue += [base for base in bases if base is not None]
