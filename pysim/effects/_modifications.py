"""Values of parameters as Modelica modifications, put into those that are there already."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from pysim.effects._tokens import Token, closing, split, tokenise, written

# Parameter or component -> its value, or those of what is in it.
Tree = dict[str, "float | Tree"]

_WORDS = {"final", "each", "redeclare", "replaceable"}


def with_values(modifications: Sequence[str], values: Mapping[str, float]) -> list[str]:
    """The modifications with parameters set; a value that is there already gives way, other attributes stay.

    Args:
        modifications: as they stand in an extends clause, without commas: "a(min=0)=1", "redeclare Class part".
        values: by full name with dots.
    """
    tree: Tree = {}
    for name, value in values.items():
        *path, last = name.split(".")
        here = tree
        for part in path:
            below = here.setdefault(part, {})
            assert isinstance(below, dict), f"{part} is a parameter and a component"
            here = below
        here[last] = float(value)
    return _merged(modifications, tree)


def _merged(modifications: Sequence[str], tree: Tree) -> list[str]:
    rest, found = dict(tree), []
    for text in modifications:
        name = _name(text)
        found.append(_set(text, rest.pop(name)) if name in rest else text)
    return found + [_set(name, value) for name, value in rest.items()]


def _name_at(tokens: Sequence[Token]) -> int:
    """Index of the name that is modified: behind the class, where one is redeclared."""
    k = 0
    while tokens[k].text in _WORDS:
        k += 1
    if any(token.text == "redeclare" for token in tokens[:k]):
        while tokens[k + 1].text == ".":
            k += 2
        if tokens[k + 1].text == "(":
            k = closing(tokens, k + 1)
        k += 1
    return k


def _name(text: str) -> str:
    tokens = tokenise(text)
    return tokens[_name_at(tokens)].text


def _set(text: str, value: float | Tree) -> str:
    """One modification with a value, or with values in its bracket."""
    tokens = tokenise(text)
    k = _name_at(tokens)
    has_bracket = k + 1 < len(tokens) and tokens[k + 1].text == "("
    end = closing(tokens, k + 1) if has_bracket else k
    if not isinstance(value, dict):
        return f"{text[: tokens[end].end]}={value!r}"
    inside = [written(text, part) for part in split(tokens[k + 2 : end], ",") if part] if has_bracket else []
    return f"{text[: tokens[k].end]}({', '.join(_merged(inside, value))}){text[tokens[end].end :]}"
