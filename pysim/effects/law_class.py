"""A law as a user writes it, made a Modelica class that fills a slot."""

from __future__ import annotations

import difflib
import re
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from fmu_build.text import Libraries, class_text
from fmu_build.text.declarations import Kind
from fmu_build.text.expressions import Call, Misplaced, Name, Tree, names_in
from fmu_build.text.statements import statements
from fmu_build.text.tokens import tokenise
from fmu_build.text.write import quoted
from pysim.effects._text import as_bad_input, attributes_of, known_class
from pysim.effects.catalogue import VENDOR
from pysim.effects.law import ARGUMENTS, Law, check_units, dimension, dimension_words, read_law
from pysim.effects.slots import Slot
from pysim.types import BadInput, EffectParameter

_BEFORE = "equation "
_EQUALS = re.compile(r"(?<![=<>])=(?!=)")  # of an equation
_COMMENT = re.compile(r"//[^\n]*|/\*.*?\*/", re.DOTALL)
# Source: Modelica Specification 3.6, Section 2.3.3.
_KEYWORDS = {
    "algorithm", "and", "annotation", "assert", "block", "break", "class", "connect", "connector", "constant",
    "constrainedby", "der", "discrete", "each", "else", "elseif", "elsewhen", "encapsulated", "end",
    "enumeration", "equation", "expandable", "extends", "external", "false", "final", "flow", "for", "function",
    "if", "import", "impure", "in", "initial", "inner", "input", "loop", "model", "not", "operator", "or",
    "outer", "output", "package", "parameter", "partial", "protected", "public", "pure", "record", "redeclare",
    "replaceable", "return", "stream", "then", "true", "type", "when", "while", "within", "time",
}  # fmt: skip


class LawRefused(BadInput):
    """What is wrong in the text of a law, and at which of its letters; `what` leaves out where that is."""

    def __init__(self, where: str, what: str, place: int) -> None:
        super().__init__(what, argument="law", where=where)
        self.what, self.place = what, place


@dataclass(frozen=True)
class _Equation:
    """One of a law: what it gives, its right-hand side, and where it stands in the law's text."""

    gives: str
    tree: Tree
    written: str
    start: int


def law_class(
    name: str,
    slot: Slot,
    law: str,
    parameters: Sequence[EffectParameter],
    libraries: Sequence[Path],
    *,
    effect: str = "",
    description: str = "",
) -> str:
    """The Modelica class of a law, to be put into a file of its own and named as a library.

    The law may name the slot's variables, its parameters, `time`, and what an equation of it gives. It has no memory:
    for a derivative or an event write the class by hand.

    Args:
        name: of the class, such as "QuadraticDrag".
        slot: that it fills; `slots` reads them from a model.
        law: equations that give each of `slot.gives`, "f = -c_2*v*abs(v)"; an expression alone where that is one.
        parameters: with SI units; "1" for a plain number.
        libraries: where the slot's partial class is.
        effect: its name in the catalogue, such as "own.drag"; "" for a class that is no candidate of a diagnosis.
        description: in words.
    Raises:
        BadInput: what the law may not name or call, units that do not fit, a variable of the slot that no equation
            gives; says where in the law.
    """
    _check_names(name, slot, law, parameters)
    units = slot_units(slot, libraries) | {one.name: one.unit for one in parameters} | {"time": "s"}
    equations = list(_equations(name, law, slot))
    given = [one.gives for one in equations]
    for one in slot.gives:
        if one not in given:
            raise BadInput(f"law of {name}: nothing gives {one} of the slot {slot.name}; add {one} = expression")
    own = _local_units(name, law, equations, slot, units)
    declared = [parameter_text(one) for one in parameters]
    declared += [f'Real {one}(unit="{unit}")' for one, unit in own.items()]
    note = f"{VENDOR}(effect={quoted(effect)}, slot={quoted(slot.name)})" if effect else ""
    return class_text(
        name,
        description=description,
        extends=[(slot.takes, ())],
        declarations=declared,
        equations=[one.written for one in equations],
        annotation=note,
    )


def law_equations(name: str, law: str, slot: Slot) -> list[tuple[str, Tree]]:
    """What each equation of a law gives, and its right-hand side; every name may stand there.

    Args:
        name: for messages.
    Raises:
        LawRefused: what is no equation.
    """
    return [(one.gives, one.tree) for one in _equations(name, law, slot)]


def slot_units(slot: Slot, libraries: Sequence[Path]) -> dict[str, str | None]:
    """Units of all that a law in the slot may name; None where its partial class leaves them open.

    Raises:
        BadInput: the slot's partial class is in none of the libraries.
    """
    library, found = Libraries(libraries), dict[str, str | None]()
    with as_bad_input():
        for text in library.ancestry(known_class(slot.takes, library)):
            for one in text.of_kind(Kind.COMPONENT):
                if one.name in (*slot.gives, *slot.sees) or one.prefixes & {"parameter", "constant"}:
                    unit = attributes_of(one, text, library).get("unit")
                    found.setdefault(one.name, unit.strip().strip('"') if unit else None)
    return found


def _check_names(name: str, slot: Slot, law: str, parameters: Sequence[EffectParameter]) -> None:
    taken = [*slot.gives, *slot.sees]
    for one in (name, *(parameter.name for parameter in parameters)):
        if not re.fullmatch(r"[A-Za-z_]\w*", one, re.ASCII) or one in _KEYWORDS:
            raise BadInput(f"{one!r} is no name in Modelica; write letters, digits and _, a letter first")
        if one in taken:
            raise BadInput(f"law of {name}: {one} is named twice, or is a variable of the slot {slot.name}; rename it")
        taken.append(one)
    for parameter in parameters:
        if not parameter.unit:
            raise BadInput(f'law of {name}: the parameter {parameter.name} has no unit; write "1" for a plain number')
        try:
            dimension(parameter.unit)
        except ValueError as error:
            place = _place(law, parameter.name, 0)
            raise _refusal(name, law, place, f"the parameter {parameter.name}: {error}") from error


def _equations(name: str, law: str, slot: Slot) -> Iterator[_Equation]:
    """Each once, with names and functions that are known."""
    ahead, law = _BEFORE, _COMMENT.sub(lambda found: re.sub(r"\S", " ", found[0]), law)
    if len(slot.gives) == 1 and not _EQUALS.search(law):
        ahead += f"{slot.gives[0]} = "
    text = ahead + law
    seen: set[str] = set()
    end = 0
    for statement in statements(tokenise(text)):
        start = max(statement.start - len(ahead), 0)
        written = text[statement.start : statement.end].rstrip("; \n")
        try:
            read = read_law(written)
        except Misplaced as error:
            raise _refusal(name, law, max(statement.start + error.at - len(ahead), 0), f"{error}") from error
        except ValueError as error:
            raise _refusal(name, law, start, f"{error}") from error
        if not read.values:
            raise _refusal(name, law, start, f"{written!r} has a memory or an event; write the class by hand for that")
        ((gives, tree),) = read.values.items()
        if gives in seen or gives in slot.sees:
            cure = "keep one of the two" if gives in seen else f"the slot gives {', '.join(slot.gives)}"
            raise _refusal(name, law, start, f"{gives} is given already; {cure}")
        seen.add(gives)
        end = statement.end
        yield _Equation(gives, tree, written, start)
    rest = next((token for token in tokenise(text) if token.start >= max(end, len(_BEFORE))), None)
    if rest is not None:
        raise _refusal(name, law, max(rest.start - len(ahead), 0), f"{rest.text} is no part of a law; remove it")


def _local_units(
    name: str, law: str, equations: Sequence[_Equation], slot: Slot, units: Mapping[str, str | None]
) -> dict[str, str]:
    """What the law gives besides the slot's variables, with its unit, once everything it names is known to fit."""
    known, own = dict(units), dict[str, str]()
    depends = Law({one.gives: one.tree for one in equations})
    for one in equations:
        _check_words(name, law, one, {*units, *depends.values})
        if one.gives in depends.needs(one.gives):
            raise _refusal(name, law, one.start, f"{one.gives} depends on itself; give it by what is known")
    left = list(equations)
    while left:
        one = next(e for e in left if all(word in known for word in names_in(e.tree)))
        left.remove(one)
        try:
            found = check_units(one.tree, known)
            dimension(dimension_words(found))  # refuses a broken power
        except ValueError as error:
            raise _refusal(name, law, one.start, f"{one.written!r}: {error}") from error
        if one.gives not in known:
            own[one.gives] = known[one.gives] = dimension_words(found)
        unit = known[one.gives]
        if unit is not None and found is not None and found != dimension(unit):
            said = f"{one.gives} is in {unit}, and what stands behind it in {dimension_words(found)}"
            raise _refusal(name, law, one.start, f"{one.written!r}: {said}; make both the same")
    return own


def _check_words(name: str, law: str, one: _Equation, known: Collection[str]) -> None:
    """Every name and function of an equation is one that a law may have."""
    for word, count in _words(one.tree):
        offers: Collection[str] = known if count is None else [f for f in ARGUMENTS if f.isalpha()]
        wanted = None if count is None else ARGUMENTS.get(word)
        if (word in known) if count is None else (count == wanted):
            continue
        if wanted is not None:
            why = f"{word}() takes {wanted} argument{'s' * (wanted > 1)}, not {count}"
        else:
            near = difflib.get_close_matches(word, list(offers), n=1)
            cure = f"did you mean {near[0]}?" if near else f"there are {', '.join(sorted(offers))}"
            why = f"{word} is no {'name' if count is None else 'function'} that the law may use; {cure}"
        raise _refusal(name, law, _place(law, word, one.start), why)


def _words(tree: Tree) -> Iterator[tuple[str, int | None]]:
    """Names with None, and functions with the number of their arguments."""
    if isinstance(tree, Name):
        yield tree.name, None
    elif isinstance(tree, Call):
        yield tree.function, len(tree.arguments)
        for argument in tree.arguments:
            yield from _words(argument)


def _place(law: str, word: str, start: int) -> int:
    """Where a word first stands from a place on; that place where it is not found as one word."""
    return next((token.start for token in tokenise(law) if token.start >= start and token.text == word), start)


def _refusal(name: str, law: str, start: int, message: str) -> LawRefused:
    line, column = law.count("\n", 0, start) + 1, start - law.rfind("\n", 0, start)
    return LawRefused(f"law of {name}, line {line}, column {column}", message, start)


def parameter_text(one: EffectParameter) -> str:
    """A parameter's declaration, without semicolon, as `read_catalogue` reads it back."""
    numbers = {"min": one.min, "max": one.max, "nominal": one.nominal}
    if one.off is not None and (one.off or one.default):
        numbers["start"] = one.off
    attributes = ", ".join([f'unit="{one.unit}"', *(f"{key}={value!r}" for key, value in numbers.items())])
    said = ", ".join(
        f"{key}={quoted(value)}" for key, value in (("inverse", one.inverse), ("limits", one.limits)) if value
    )
    about = f" {quoted(one.description)}" if one.description else ""
    note = f" annotation({VENDOR}({said}))" if said else ""
    return f"parameter Real {one.name}({attributes}) = {one.default!r}{about}{note}"
