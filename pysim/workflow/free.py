"""Which parameters may be refitted."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace

from pysim.types import BadInput, Model

Bounds = Mapping[str, tuple[float, float]]  # parameter -> lowest and highest; of what is known, mean and s.d.


def free_parameters(model: Model, named: Sequence[str], bounds: Bounds, values: Mapping[str, float]) -> tuple[str, ...]:
    """Those named; else those that the model suggests and that were not set, and those with bounds.

    Args:
        named: by the user.
        bounds: parameter -> lower and upper bound.
        values: parameters that were set.
    Raises:
        BadInput: there is none.
    """
    if named:
        return tuple(named)
    own = suggested(model)
    if not own and not bounds:
        raise BadInput(
            f"{model.label} gives no parameter min, max and nominal; name those to refit, and their bounds: "
            f"{_example(model)}"
        )
    free = tuple(name for name in dict.fromkeys([*own, *bounds]) if name not in values or name in bounds)
    if not free:
        raise BadInput(
            f"every parameter that {model.label} gives bounds is set, so none is left to refit; free those to refit "
            "from there"
        )
    return free


def suggested(model: Model) -> tuple[str, ...]:
    """Parameters that the model gives min, max and nominal: what it says may differ from one unit to the next."""
    return tuple(
        v.name
        for v in model.variables
        if v.causality == "parameter"
        and v.type in ("Real", "Float64")
        and None not in (v.min, v.max, v.nominal, v.start)
    )


def begun_at(model: Model, values: Mapping[str, float]) -> Model:
    """The same model, of which these parameters are refitted from other values than its own."""
    own = (replace(v, start=values[v.name]) if v.name in values else v for v in model.variables)
    return replace(model, variables=tuple(own)) if values else model


def _example(model: Model) -> str:
    """What frees a parameter of the model, in a terminal and in Python."""
    said = "on page Model, --free {0} --bounds {0}={1}:{2}, in Python .free({0}=({1}, {2}))".format
    for v in model.variables:
        if v.causality == "parameter" and v.type in ("Real", "Float64") and v.start and math.isfinite(v.start):
            return said(v.name, *(f"{end:g}" for end in sorted((0.1 * v.start, 10 * v.start))))
    return said("NAME", "LOW", "HIGH")
