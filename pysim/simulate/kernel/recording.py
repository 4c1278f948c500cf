"""Which functions of an FMU read the variables that are recorded, and how these lie in memory."""

from __future__ import annotations

from typing import Any

import numpy as np

from pysim.simulate.kernel.layout import KIND_DOUBLE, KIND_INT, KIND_LONG, KIND_OCTET, KIND_SINGLE
from pysim.types import Model

# Type of variable -> getter and layout, FMI 2 and FMI 3.
GETTERS = {
    2: {
        "Real": ("fmi2GetReal", KIND_DOUBLE),
        "Integer": ("fmi2GetInteger", KIND_INT),
        "Enumeration": ("fmi2GetInteger", KIND_INT),
        "Boolean": ("fmi2GetBoolean", KIND_INT),
    },
    3: {
        "Float64": ("fmi3GetFloat64", KIND_DOUBLE),
        "Float32": ("fmi3GetFloat32", KIND_SINGLE),
        "Int32": ("fmi3GetInt32", KIND_INT),
        "Int64": ("fmi3GetInt64", KIND_LONG),
        "Enumeration": ("fmi3GetInt64", KIND_LONG),
        "Boolean": ("fmi3GetBoolean", KIND_OCTET),
    },
}


def row_layout(model: Model, names: tuple[str, ...], address: Any) -> dict[str, Any]:
    """What `Rows` of the kernel needs to read these variables; `address` is that of a function, by its name."""
    getters = GETTERS[model.abilities.fmi]
    groups: dict[tuple[str, int], list[int]] = {}
    for column, name in enumerate(names):
        groups.setdefault(getters[model[name].type], []).append(column)
    places = [column for columns in groups.values() for column in columns]
    return {
        "columns": len(names),
        "groups": len(groups),
        "getters": np.array([address(function) for function, _ in groups], dtype=np.int64),
        "kinds": np.array([kind for _, kind in groups], dtype=np.int64),
        "first": np.cumsum([0, *map(len, groups.values())], dtype=np.int64),
        "references": np.array([model[names[column]].reference for column in places], dtype=np.uint32),
        "places": np.array(places, dtype=np.int64),
        "buffer": np.zeros(len(names)),
    }
