"""Refuses if-equations whose assertions and when-clauses rumoca 0.10.2 would drop without a word.

It keeps them only where it decides the condition itself: by constants and final parameters, or by parameters that it
fixes because the branches differ in their number of equations. Any other condition becomes one of if-expressions, in
which only the equations are left.
"""

import re
from collections.abc import Iterator, Mapping, Set
from itertools import pairwise

from fmu_build.front.expression import Span
from fmu_build.front.flat_model import FlatModel, FlatVariable, Role
from fmu_build.text.classes import ClassText
from fmu_build.text.declarations import Declaration, Kind
from fmu_build.text.lookup import Libraries
from fmu_build.text.statements import Statement, statements
from fmu_build.text.tokens import Tokens, behind_brackets, is_name

_INDEX = re.compile(r"\[[^\]]*\]")
_ACTIONS = ("when", "assert", "terminate")
_VARYING = ("time", "initial", "terminal")


def refuse_lost_actions(
    source: ClassText, classes: Libraries, model: FlatModel, overrides: Mapping[str, float | str]
) -> None:
    """Look through the class and all classes that make it up.

    Raises:
        BuildError: an if-equation would lose what it does; says what to write instead.
    """
    for here in classes.used(source):
        for outer in statements(here.own_tokens):
            iterators = set(_iterators(outer))
            for statement in _acting_ifs((outer,)):
                free = _free_name(statement, iterators, here, classes, model)
                if free or (statement is outer and _always_acts(outer) and not _is_kept(outer, here, model)):
                    lost = next(inner.word for inner in statement.inside() if inner.word in _ACTIONS)
                    raise here.error(
                        f"the compiler would drop the {lost} of this if-equation, whose condition is not decided when "
                        f"the FMU is built; {_cure(lost, free, model)}",
                        statement.start,
                    )


def _acting_ifs(branch: tuple[Statement, ...]) -> Iterator[Statement]:
    """The if-equations outside of when-clauses that hold an action, in their branches too."""
    for statement in branch:
        if statement.word == "if" and any(_acts(inner) for inner in statement.branches):
            yield statement
        if statement.word != "when":
            for inner in statement.branches:
                yield from _acting_ifs(inner)


def _acts(branch: tuple[Statement, ...]) -> bool:
    return any(inner.word in _ACTIONS for statement in branch for inner in (statement, *statement.inside()))


def _always_acts(statement: Statement) -> bool:
    return len(statement.branches) > len(statement.conditions) and all(_acts(branch) for branch in statement.branches)


def _is_kept(statement: Statement, here: ClassText, model: FlatModel) -> bool:
    first, last = here.source.line(statement.start), here.source.line(statement.end)
    spans = [a.span for a in model.assertions] + [t.span for t in model.terminations] + [c.span for c in model.clauses]
    return any(s.file == here.source.file and s.line is not None and first <= s.line <= last for s in spans)


def _iterators(outer: Statement) -> Iterator[str]:
    for statement in (outer, *outer.inside()):
        for condition in statement.conditions if statement.word == "for" else ():
            words = [word for word, _ in condition]
            yield from (name for name, behind in pairwise(words) if behind == "in")


def _free_name(statement: Statement, iterators: Set[str], here: ClassText, classes: Libraries, model: FlatModel) -> str:
    """A name in the conditions without a fixed value, somewhere in the model; empty where there is none."""
    for name in _names(tuple(token for condition in statement.conditions for token in condition)):
        if name in _VARYING:
            return name
        for variable in variables_meant(name, here, classes, model) if name.split(".")[0] not in iterators else ():
            if variable.role not in (Role.STRUCTURAL, Role.CONSTANT):
                return name
    return ""


def variables_meant(name: str, here: ClassText, classes: Libraries, model: FlatModel) -> Iterator[FlatVariable]:
    """What a name with dots and without indices, as it stands in a class, may mean: one of each part of that class."""
    first, *rest = name.split(".")
    for owner, declaration in classes.elements(first, here):
        for variable in model.variables if declaration.kind is Kind.COMPONENT else ():
            if _is_named(variable, name) and (rest or _is_of(variable.span, owner, declaration)):
                yield variable


def _names(tokens: Tokens) -> Iterator[str]:
    """Dotted names without their indices, and words: `a[2].b and not c` -> a.b, and, not, c."""
    name, is_part, at = "", False, 0
    while at < len(tokens):
        word = tokens[at][0]
        if is_name(word) and not is_part:
            yield name
            name = word
        elif is_name(word):
            name += f".{word}"
        is_part = word == "."
        at = behind_brackets(tokens, at) if word == "[" else at + 1
    yield name


def _is_named(variable: FlatVariable, name: str) -> bool:
    return f".{_INDEX.sub('', variable.name)}".endswith(f".{name}")


def _is_of(span: Span, owner: ClassText, declaration: Declaration) -> bool:
    """Whether a variable comes from this declaration; one that is `outer` is declared elsewhere too."""
    first, last = (owner.source.line(offset) for offset in (declaration.start, declaration.end))
    is_there = span.file == owner.source.file and span.line is not None and first <= span.line <= last
    return is_there or "outer" in declaration.prefixes


def _cure(lost: str, free: str, model: FlatModel) -> str:
    is_parameter = any(v.role is Role.PARAMETER and _is_named(v, free) for v in model.variables)
    other = f", or make {free} final" if free and is_parameter else ""
    return f"write the {lost} outside of it, with that condition as part of its own{other}"
