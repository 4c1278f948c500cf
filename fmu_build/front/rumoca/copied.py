"""Records that are given to parts: rumoca 0.10.2 copies what the modification of such a record says.

Of `parameter Data k(a = 4); Pump pump(data = k);` it binds `pump.data.b` to `k.b`, but `pump.data.a` to 4, so that it
would not follow `k.a`. The 4 has one place in the text, which tells where it is from.
"""

import re
from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Any

from fmu_build.front.expression import Literal, Reference
from fmu_build.front.flat_model import FlatModel, FlatVariable
from fmu_build.front.rumoca.form.places import span_key
from fmu_build.text.classes import ClassText
from fmu_build.text.declarations import Modifier, modifiers
from fmu_build.text.lookup import Libraries
from fmu_build.text.tokens import Tokens, dotted_name

_INDEX = re.compile(r"\[[^\]]*\]")


def with_followed_records(
    model: FlatModel, flat: Mapping[str, Any], source: ClassText, classes: Libraries
) -> FlatModel:
    """The model in which such a field follows the field of the record that its own record is given."""
    places = {name: span_key(*one["binding"].values()) for name, one in flat["variables"].items() if one["binding"]}
    alike: dict[tuple[int, int, int], list[str]] = defaultdict(list)
    for name, place in places.items():
        alike[place].append(name)
    given = set(_given_names(source, classes))

    def followed(one: FlatVariable) -> FlatVariable:
        is_given = flat["variables"].get(one.name, {}).get("binding_from_modification")
        if not is_given or not isinstance(one.binding, Literal) or one.name not in places:
            return one
        original = _original(one.name, alike[places[one.name]], given)
        return replace(one, binding=Reference(one.binding.span, original)) if original else one

    return replace(model, variables=tuple(map(followed, model.variables)))


def _original(name: str, alike: Sequence[str], given: set[tuple[str, str]]) -> str:
    """Of the variables with a value from the same place, the field of the record that is given, or ""."""
    record, _, field = name.rpartition(".")
    owner, _, part = record.rpartition(".")
    for other in sorted(alike, key=len, reverse=True):
        other_record, _, other_field = other.rpartition(".")
        other_owner, _, other_part = other_record.rpartition(".")
        is_outside = owner != other_owner and f"{owner}.".startswith(f"{other_owner}." if other_owner else "")
        if is_outside and field == other_field and (_INDEX.sub("", part), _INDEX.sub("", other_part)) in given:
            return other
    return ""


def _given_names(source: ClassText, classes: Libraries) -> Iterator[tuple[str, str]]:
    """Of modifications `data = k`, the last parts of both names."""
    for here in classes.used(source):
        for declaration in here.declarations:
            yield from _pairs(declaration.name, declaration.value)
            yield from _inside(declaration.modifiers)


def _inside(given: Mapping[str, Modifier]) -> Iterator[tuple[str, str]]:
    for name, modifier in given.items():
        yield from _pairs(name, modifier.value)
        yield from _inside(modifiers(modifier.inside))


def _pairs(name: str, value: Tokens) -> Iterator[tuple[str, str]]:
    other, behind = dotted_name(value, 0)
    if other and behind == len(value):
        yield name, other.rpartition(".")[2]
