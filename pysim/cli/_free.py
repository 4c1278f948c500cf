"""Which parameters a command may refit."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from pysim.types import Model

Bounds = Mapping[str, tuple[float, float]]


def free_parameters(
    model: Model, named: Sequence[str], bounds: Bounds, overrides: Mapping[str, float]
) -> tuple[str, ...]:
    """Those named; else those that the model gives min, max and nominal and that were not set, and those with bounds.

    Args:
        named: by `--free`.
        bounds: by `--bounds`.
        overrides: parameters that were set.
    Raises:
        BadInput: there is none.
    """
    from pysim.diagnose import identifiable
    from pysim.types import BadInput

    if named:
        return tuple(named)
    try:
        own: tuple[str, ...] = identifiable(model)
    except BadInput as error:
        if not bounds:
            raise BadInput(f"{error}, as {_example(model)}") from error
        own = ()
    free = tuple(name for name in dict.fromkeys([*own, *bounds]) if name not in overrides or name in bounds)
    if not free:
        raise BadInput(
            f"every parameter that {model.label} gives bounds is set, so none is left to refit; name with --free those "
            "to refit from there"
        )
    return free


def begun_at(model: Model, values: Mapping[str, float]) -> Model:
    """The same model, of which these parameters are refitted from other values than its own."""
    own = (replace(v, start=values[v.name]) if v.name in values else v for v in model.variables)
    return replace(model, variables=tuple(own)) if values else model


def held_as_set(model: Model, overrides: Mapping[str, float]) -> list[str]:
    """A note on parameters that are not refitted because they were set, though the model says that they may differ."""
    from pysim.diagnose import identifiable
    from pysim.types import BadInput

    try:
        held = [name for name in identifiable(model) if name in overrides]
    except BadInput:
        return []
    return [f"held as set, not refitted: {', '.join(held)}; --free refits them from there"] if held else []


def _example(model: Model) -> str:
    """The options, for a parameter of the model."""
    for v in model.variables:
        if v.causality == "parameter" and v.type in ("Real", "Float64") and v.start and math.isfinite(v.start):
            low, high = sorted((0.1 * v.start, 10 * v.start))
            return f"--free {v.name} --bounds {v.name}={low:g}:{high:g}"
    return "--free NAME --bounds NAME=LOW:HIGH"
