"""A model with effects in its slots, as Modelica text."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from fmu_build.text import ClassText, Libraries, class_text, with_values
from fmu_build.text.declarations import Kind
from fmu_build.text.tokens import split
from pysim.effects._text import as_bad_input, known_class, with_full_names
from pysim.effects.catalogue import Pair, input_signal, read_pairs
from pysim.types import BadInput, Effect


@dataclass(frozen=True)
class Variant:
    """A class to compile, and where each effect's parameters are in it.

    Args:
        class_name: of the class in `text`.
        text: the Modelica class.
        places: effect name -> the name ahead of its parameters' names in the compiled model.
    """

    class_name: str
    text: str
    places: dict[str, str]

    def parameter(self, effect: str, name: str) -> str:
        """Full name of an effect's parameter in the compiled model."""
        return f"{self.places[effect]}.{name}"


def variant(
    base_class: str,
    effects: Sequence[Effect],
    libraries: Sequence[Path],
    *,
    name: str = "PumpVariant",
    values: Mapping[str, float] | None = None,
    comment: str = "",
) -> Variant:
    """Extend a model by effects, all slots in one extends clause.

    A base that only extends another with modifications is unrolled to the class that declares the slots, because the
    compiler passes over a redeclaration of an inherited slot. Two or more effects of one slot are put together by a
    pair of the libraries, in the order given. An effect's inputs are bound to the signals that their annotations name.

    Args:
        base_class: full name, such as "HydraulicTestBench.Pump.FreeGreyBox".
        effects: any, each once; none gives the base itself.
        libraries: where the base, the effects and the pairs are.
        name: of the new class.
        values: parameters to set, by their full names in the new class.
        comment: lines ahead of the class, without the slashes.
    Raises:
        BadInput: an unknown base, a slot it does not have, an effect twice, or two in a slot that no pair serves.
    """
    names = [effect.name for effect in effects]
    if len(set(names)) < len(names):
        raise BadInput(f"variant of {base_class}: an effect is named twice among {', '.join(names)}; name each once")
    slots = list(dict.fromkeys(effect.slot for effect in effects))
    with as_bad_input():
        base, modifications = _unrolled(base_class, slots, Libraries(libraries))
    pairs = read_pairs(*libraries) if len(slots) < len(effects) else ()
    inner: list[str] = []
    places: dict[str, str] = {}
    for slot in slots:
        own = [effect for effect in effects if effect.slot == slot]
        filling = _filling(slot, own, pairs, inner, places)
        with as_bad_input():
            bound = _bound_inputs(slot, own, places, Libraries(libraries))
        modifications = [*modifications, f"redeclare {filling} {slot}{bound}"]
    with as_bad_input():
        modifications = with_values(modifications, values or {})
    about = f"{base_class.rpartition('.')[2]} with {', '.join(names) or 'no effect'}"
    extends = [(base, modifications)]
    text = class_text(name, description=about, comment=comment, classes=inner, extends=extends)
    return Variant(name, text, places)


def variant_text(base_class: str, effects: Sequence[Effect], libraries: Sequence[Path]) -> str:
    """The text alone of `variant`."""
    return variant(base_class, effects, libraries).text


def _filling(
    slot: str, effects: Sequence[Effect], pairs: Sequence[Pair], inner: list[str], places: dict[str, str]
) -> str:
    """Class to put into the slot; classes it needs go to `inner`, where the effects' parameters are to `places`."""
    if len(effects) == 1:
        places[effects[0].name] = slot
        return effects[0].class_name
    own = next((p for p in pairs if p.slot == slot and set(p.of) == {e.name for e in effects}), None)
    if own is not None:
        places.update({effect.name: slot for effect in effects})
        return own.class_name
    pair = next((p for p in pairs if p.slot == slot and not p.of), None)
    if pair is None:
        both = " and ".join(effect.name for effect in effects)
        raise BadInput(
            f'{both} share the slot {slot}, and no class puts them together; write one annotated with pair="{slot}"'
        )
    first, place = effects[0].class_name, ""
    for k, effect in enumerate(effects[1:], start=1):
        name = f"{slot[0].upper()}{slot[1:]}{k}"
        about = f"{effects[k - 1].name if k == 1 else 'the former'} and {effect.name}"
        parts = (f"redeclare {first} first", f"redeclare {effect.class_name} second")
        inner.append(class_text(name, description=about, extends=[(pair.class_name, parts)]))
        first = name
    for k, effect in enumerate(reversed(effects)):
        last = k == len(effects) - 1
        place = ".".join([slot, *["first"] * (k - last), "first" if last else "second"])
        places[effect.name] = place
    return first


def _bound_inputs(slot: str, effects: Sequence[Effect], places: Mapping[str, str], library: Libraries) -> str:
    """The slot's modification that gives the effects' inputs: `(second(p = chamber1.p))`; "" where they have none."""
    parts = []
    for effect in effects:
        text = library.full(effect.class_name)
        signals = {d.name: input_signal(d) for d in text.of_kind(Kind.COMPONENT)} if text else {}
        bound = ", ".join(f"{name} = {signal}" for name, signal in signals.items() if signal)
        for part in reversed(places[effect.name].split(".")[1:]):
            bound = f"{part}({bound})" if bound else ""
        parts += [bound] if bound else []
    return f"({', '.join(parts)})" if parts else ""


def _unrolled(base_class: str, slots: Sequence[str], library: Libraries) -> tuple[str, list[str]]:
    """The class that declares the slots, and the modifications on the way to it with full names."""
    text = known_class(base_class, library)
    modifications: list[str] = []
    while not all(_declares(text, slot) for slot in slots):
        missing = next(slot for slot in slots if not _declares(text, slot))
        bases = list(text.of_kind(Kind.EXTENDS))
        parent = library.resolve(bases[0].class_name, text) if len(bases) == 1 else None
        if parent is None or not text.is_plain:
            raise BadInput(
                f"{base_class} has no replaceable part {missing}, or {text.full_name} declares more beside the class "
                "that has it; name a class that declares its slots itself"
            )
        here = [text.text(part) for part in split(bases[0].arguments, ",")]
        modifications = [with_full_names(part, text, library) for part in here] + modifications
        text = parent
    return text.full_name, modifications


def _declares(text: ClassText, slot: str) -> bool:
    return any(d.name == slot and "replaceable" in d.prefixes for d in text.declarations)
