"""Where Modelica text that cannot be used becomes the user's mistake."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

from fmu_build.text import ClassText, Declaration, Libraries, TextError, tokenise
from fmu_build.text.declarations import Kind
from fmu_build.text.tokens import is_name
from pysim.types import BadInput


@contextmanager
def as_bad_input() -> Iterator[None]:
    """Raise BadInput for a TextError, with its file and line."""
    try:
        yield
    except TextError as error:
        raise BadInput(str(error)) from error


def known_class(name: str, library: Libraries) -> ClassText:
    """The class of a full name.

    Raises:
        BadInput: no library holds it.
    """
    text = library.full(name)
    if text is None:
        raise BadInput(f"no class {name} in the libraries; check its full name, and name its library")
    return text


def declares(class_name: str, libraries: Sequence[Path]) -> bool:
    """Whether one of the libraries holds the class.

    Raises:
        BadInput: a file of them cannot be read.
    """
    with as_bad_input():
        return Libraries(libraries).full(class_name) is not None


def with_full_names(part: str, text: ClassText, library: Libraries) -> str:
    """Modelica text with the names of classes written in full, so that it means the same elsewhere."""
    tokens = tokenise(part)
    replaced, end = "", 0
    for k, token in enumerate(tokens):
        begins = is_name(token.text) and (k == 0 or tokens[k - 1].text != ".")
        if begins and k + 1 < len(tokens) and tokens[k + 1].text == ".":
            found = library.resolve(token.text, text)
            if found is not None:
                replaced += part[end : token.start] + found.full_name
                end = token.end
    return replaced + part[end:]


def is_input(declaration: Declaration) -> bool:
    """Whether a variable is an input, by its prefix or its type."""
    return "input" in declaration.prefixes or declaration.class_name.endswith("RealInput")


def changes(declaration: Declaration, owner: ClassText, library: Libraries) -> bool:
    """Whether a component is a real number that is no parameter."""
    if declaration.prefixes & {"parameter", "constant"}:
        return False
    resolved = library.resolve(declaration.class_name, owner)
    if resolved is None:
        return declaration.class_name == "Real"
    return resolved.kind == "type" or resolved.full_name.endswith((".RealInput", ".RealOutput"))


def attributes_of(declaration: Declaration, text: ClassText, library: Libraries) -> dict[str, str]:
    """Attributes of the declaration, and those of its type where it has none of its own."""
    found = _written(declaration)
    base = library.resolve(declaration.class_name, text)
    for one in library.ancestry(base) if base is not None else ():
        for extended in one.of_kind(Kind.EXTENDS):
            found = {**_written(extended), **found}
    return found


def _written(declaration: Declaration) -> dict[str, str]:
    return {name: declaration.text(modifier.value) for name, modifier in declaration.modifiers.items()}
