"""An FMU whose class is at hand: its values, so that models built from the class differ in their effect alone."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path

from pysim.types import BadInput, Model, Variable
from pysim.workflow.model import model_of

_CURE = "effects are added to the class, so name a class that extends it as it was built in place of the FMU"
_SAME = 1e-9  # numbers that differ by less have been through a text


def built_in(model: Model, libraries: Sequence[Path | str]) -> dict[str, float]:
    """Parameters of an FMU whose values are not those of its class, in the variables' units.

    Args:
        model: of the FMU. Its class is in one of the libraries, and is compiled here or taken from the cache.
    Raises:
        BadInput: one that nothing can set once the model is built, another number of states, or a
            class that does not compile.
    """
    plain, class_name = model_of(model.name, libraries), model.name
    states = [len(one.abilities.states) for one in (model, plain)]
    if states[0] != states[1]:
        raise BadInput(f"{model.path.name}: has {states[0]} states, where {class_name} has {states[1]}; {_CURE}")
    declared = {v.name: v for v in plain.variables}
    values: dict[str, float] = {}
    for own in model.variables:
        other = declared.get(own.name)
        if other is None or own.start is None or not _is_written(own) or _is_same(own.start, own.unit, other):
            continue
        if {own.causality, other.causality} != {"parameter"} or own.unit != other.unit:
            raise BadInput(
                f"{model.path.name}: built with {own.name} = {_value(own)}, where {class_name} has {_value(other)}; "
                f"{_CURE}"
            )
        values[own.name] = own.start
    return values


def _is_written(v: Variable) -> bool:
    """Whether its start is a number that somebody wrote."""
    return v.causality in ("parameter", "structuralParameter") or v.variability == "constant"


def _is_same(start: float, unit: str, other: Variable) -> bool:
    return other.start is not None and other.unit == unit and math.isclose(start, other.start, rel_tol=_SAME)


def _value(v: Variable) -> str:
    return "nothing" if v.start is None else f"{v.start:g} {v.unit}".removesuffix(" 1")
