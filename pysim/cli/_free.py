"""Which parameters a command may refit."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from pysim.types import Model

Bounds = Mapping[str, tuple[float, float]]


def free_parameters(
    model: Model, named: Sequence[str], bounds: Bounds, overrides: Mapping[str, float]
) -> tuple[str, ...]:
    """Those named; else those that the model gives min, max and nominal, or that have bounds, and that were not set.

    Args:
        named: by `--free`.
        bounds: by `--bounds`.
        overrides: parameters that were set.
    Raises:
        BadInput: one that is both set and free, or none.
    """
    from pysim.diagnose import identifiable
    from pysim.types import BadInput

    for name in overrides:
        if name in named:
            raise BadInput(f"{name} is set and free; leave it out of --free")
        if name in bounds:
            raise BadInput(f"{name} is set and has bounds to refit it between; leave out one of the two")
    if named:
        return tuple(named)
    try:
        own: tuple[str, ...] = identifiable(model)
    except BadInput as error:
        if not bounds:
            raise BadInput(f"{error}, as {_example(model)}") from error
        own = ()
    free = tuple(name for name in dict.fromkeys([*own, *bounds]) if name not in overrides)
    if not free:
        raise BadInput(
            f"every parameter that {model.label} gives bounds is set, so none is left to refit; set fewer, or name "
            "others with --free"
        )
    return free


def _example(model: Model) -> str:
    """The options, for a parameter of the model."""
    for v in model.variables:
        if v.causality == "parameter" and v.type in ("Real", "Float64") and v.start and math.isfinite(v.start):
            low, high = sorted((0.1 * v.start, 10 * v.start))
            return f"--free {v.name} --bounds {v.name}={low:g}:{high:g}"
    return "--free NAME --bounds NAME=LOW:HIGH"
