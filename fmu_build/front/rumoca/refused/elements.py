"""Refuses arrays of which rumoca 0.10.2 would take or lay out the elements along the wrong dimension.

In `r.a[1]`, of an array of parts r, it takes all of `r[1].a` instead of the first element of each `a`; in `r[2:3].a[1]`
all of `r[2].a`. In `connect` it does the same. `{... for i in 1:3, j in 1:2}`, which has two rows, becomes a vector, or
an array of three rows.
"""

from collections.abc import Iterator
from itertools import chain

from fmu_build.front.rumoca.refused.constants import names_used
from fmu_build.text.classes import ClassText
from fmu_build.text.lookup import Libraries, is_use
from fmu_build.text.tokens import Tokens, bracket, is_name, split


def refuse_mixed_indices(source: ClassText, classes: Libraries) -> None:
    """Look through the class, all classes that make it up, and the functions they call.

    Raises:
        TextError: elements of the wrong parts would be taken; says what to write instead.
    """
    for here in chain(classes.used(source), classes.reached(source, _parts_and_functions)):
        tokens = here.own_tokens
        for at, token in enumerate(tokens):
            elements = list(split(bracket(tokens, at, "{")[1:-1], ","))
            if len(elements) > 1 and len(list(split(elements[0], "for"))) > 1:
                raise here.error(
                    "the compiler would lay out an array with several iterators along the wrong dimensions; nest them, "
                    "as in {{a[i, j] for j in 1:2} for i in 1:3}",
                    token.start,
                )
            path = list(_path(tokens, at)) if at == 0 or tokens[at - 1].text != "." else []
            several = _several(path, here, classes) if any(indices for _, indices in path[1:]) else ""
            if several:
                raise here.error(
                    f"the compiler would take wrong elements for an index behind {several}, which is an array of "
                    f"parts; write a loop, in which each part of {several} has its own index",
                    token.start,
                )


def _parts_and_functions(here: ClassText) -> list[str]:
    return [one.class_name for one in here.declarations if is_use(one)] + sorted(names_used(here.words))


def _path(tokens: Tokens, at: int) -> Iterator[tuple[str, Tokens]]:
    """`a[2].b` at a place: a with its indices, b with none."""
    while at < len(tokens) and is_name(tokens[at].text):
        indices = bracket(tokens, at + 1, "[")
        yield tokens[at].text, indices
        at += 1 + len(indices)
        if at >= len(tokens) or tokens[at].text != ".":
            return
        at += 1


def _several(path: list[tuple[str, Tokens]], here: ClassText, classes: Libraries) -> str:
    """The name of an array of parts, of which several are meant, and behind which an index stands; "" for none."""
    owner: ClassText | None = here
    several = ""
    for name, indices in path:
        if several and any(token.text not in "[:,]" for token in indices):
            return several
        found = next(classes.elements(name, owner), None) if owner is not None else None
        if found is None:
            return ""
        where, element = found
        is_one = indices and all(_is_one(index, here, classes) for index in split(indices[1:-1], ","))
        several = name if element.dimensions and not is_one else several
        owner = classes.resolve(element.class_name, where)
    return ""


def _is_one(index: Tokens, here: ClassText, classes: Libraries) -> bool:
    """Whether an index is no range and no array."""
    texts = [token.text for token in index]
    is_array = len(index) == 1 and any(element.dimensions for _, element in classes.elements(texts[0], here))
    return ":" not in texts and texts[:1] != ["{"] and not is_array
