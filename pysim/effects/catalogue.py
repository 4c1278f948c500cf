"""The catalogue of effects, read from the Modelica classes themselves."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from pysim.effects._classes import ClassText, Declaration, arguments
from pysim.effects._library import Libraries
from pysim.effects._numbers import number
from pysim.types import BadInput, Effect, EffectParameter

VENDOR = "__HydraulicTestBench"  # the annotation's name
STANDARD_LIBRARY = Path(__file__).resolve().parents[2] / "modelica" / "HydraulicTestBench"  # the one that comes along


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
    and `nominal` are bounds and size.

    Args:
        libraries: folders with a package.mo, or .mo files. A user's own go behind ours.
    Raises:
        BadInput: two effects of one name, or a parameter without bounds or unit; with file and class.
    """
    library = Libraries(libraries)
    found: dict[str, ClassText] = {}
    effects = []
    for text, said in _annotated(library):
        if "effect" not in said:
            continue
        name = _text(said["effect"])
        if name in found:
            raise BadInput(f"{text.file}: the effect {name} is also in {found[name].file}; rename one of the two")
        found[name] = text
        effects.append(_effect(name, text, said, library))
    return tuple(effects)


def read_pairs(*libraries: Path) -> tuple[Pair, ...]:
    """Every class that puts two effects into one slot, annotated with `pair="slot"`."""
    return tuple(
        Pair(_text(said["pair"]), text.full_name, tuple(_text(part) for part in _list(said.get("of", ""))))
        for text, said in _annotated(Libraries(libraries))
        if "pair" in said
    )


def _annotated(library: Libraries) -> Iterator[tuple[ClassText, dict[str, str]]]:
    """Classes with the annotation, and what it says."""
    for text in library.classes.values():
        said = arguments(text.annotation).get(VENDOR)
        if said is not None:
            yield text, arguments(said)


def _effect(name: str, text: ClassText, said: dict[str, str], library: Libraries) -> Effect:
    if "slot" not in said:
        raise BadInput(f'{text.file}: the effect {name} fills no slot; write slot="..." into its annotation')
    parameters = [
        _parameter(declaration, text, library)
        for declaration in text.declarations
        if "parameter" in declaration.prefixes and "final" not in declaration.prefixes
    ]
    try:
        return Effect(
            name,
            _text(said["slot"]),
            text.full_name,
            tuple(parameters),
            text.description,
            said.get("bypass", "false") == "true",
            "\n".join(text.equations),
        )
    except BadInput as error:
        raise BadInput(f"{text.file}: {error}") from error


def _parameter(declaration: Declaration, text: ClassText, library: Libraries) -> EffectParameter:
    where = f"{text.file}: {declaration.name}"
    attributes = _attributes(declaration, text, library)
    for attribute in ("min", "max", "unit"):
        if attribute not in attributes:
            raise BadInput(
                f"{where} has no {attribute}, which a fit needs; write it there, or declare constant what stays"
            )
    if not declaration.value:
        raise BadInput(f"{where} has no value; declare it with = 0 for off, or with a usual size")
    low, high, default = (number(t, where) for t in (attributes["min"], attributes["max"], declaration.value))
    off = number(attributes["start"], where) if "start" in attributes else 0.0 if default == 0 else None
    said = arguments(arguments(declaration.annotation).get(VENDOR, ""))
    try:
        return EffectParameter(
            declaration.name,
            _text(attributes["unit"]),
            low,
            high,
            number(attributes["nominal"], where) if "nominal" in attributes else max(abs(low), abs(high)) / 10,
            default,
            off,
            declaration.description,
            _text(said.get("inverse", '""')),
            _text(said.get("limits", '""')),
        )
    except BadInput as error:
        raise BadInput(f"{text.file}: {error}") from error


def _attributes(declaration: Declaration, text: ClassText, library: Libraries) -> dict[str, str]:
    """Attributes of the declaration, and those of its type where it has none of its own."""
    found, name, scope = dict(declaration.modifiers), declaration.type_name, text.full_name
    for _ in range(20):  # aliases of aliases; a ring would not compile
        base = library.resolve(name, scope)
        if base is None:
            return found
        found = {**base.modifiers, **found}
        if not base.bases:
            return found
        name, scope = base.bases[0].class_name, base.full_name
    return found


def _text(written: str) -> str:
    return written.strip().strip('"')


def _list(written: str) -> Sequence[str]:
    inside = written.strip().removeprefix("{").removesuffix("}")
    return [part for part in inside.split(",") if part.strip()]
