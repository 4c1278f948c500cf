"""Values of parameters, set from outside, as a Modelica modification."""

from collections.abc import Mapping
from itertools import accumulate
from math import isfinite

from fmu_build.errors import WrongCall
from fmu_build.text.tokens import depth_change, tokenise

Override = float | str  # a number, or Modelica text


def modification(overrides: Mapping[str, Override]) -> str:
    """`{"a.b": 1}` -> `(a(b = 1))`; nothing where there are none. Raises WrongCall for what is no value."""
    parts = []
    for name, value in overrides.items():
        _refuse_element(name)
        *outer, last = name.split(".")
        inner = f"{last} = {_value_text(name, value)}"
        for part in reversed(outer):
            inner = f"{part}({inner})"
        parts.append(inner)
    return f"({', '.join(parts)})" if parts else ""


def _refuse_element(name: str) -> None:
    array, is_element, behind = name.partition("[")
    if is_element and "'" not in name:
        cure = f"give all of {array}, as in {array}={{1, 5}}"
        if "." in behind:
            cure = "give it in a class that extends this one, in the modification of the whole array"
        raise WrongCall(f"{name} is a single element of an array, which cannot be set; {cure}")


def _value_text(name: str, value: Override) -> str:
    """A value as Modelica text; a text has to be one expression, so that it cannot change more than the value."""
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, str):
        words = [token.text for token in tokenise(value)]
        depths = [0, *accumulate(depth_change(token) for token in tokenise(value))]
        is_balanced = min(depths) == depths[-1] == 0
        is_cut = any(word in ";\"'" or (word == "," and depth == 0) for word, depth in zip(words, depths, strict=False))
        has_comment = "".join("".join(words).split()) != "".join(value.split())
        if not words or not is_balanced or is_cut or has_comment:
            raise WrongCall(f"the value set for {name}, {value}, is no single Modelica expression")
        return value
    if not isfinite(value):
        raise WrongCall(f"the value set for {name} is {value}; give a finite number")
    return str(value) if isinstance(value, int) else repr(float(value))
