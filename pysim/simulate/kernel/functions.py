"""The FMI functions that the kernel calls: by the fields of its structure `Fmu`, and by the types of variables."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from pysim.simulate.kernel.layout import (
    KIND_DOUBLE,
    KIND_INT,
    KIND_INT8,
    KIND_INT16,
    KIND_LONG,
    KIND_OCTET,
    KIND_SINGLE,
    KIND_UINT8,
    KIND_UINT16,
    KIND_UINT32,
    KIND_UINT64,
)
from pysim.types import Model

# Field -> function, FMI 2 and FMI 3.
FUNCTIONS = {
    "free_instance": ("fmi2FreeInstance", "fmi3FreeInstance"),
    "instantiate": ("fmi2Instantiate", "fmi3InstantiateModelExchange"),
    "reset": ("fmi2Reset", "fmi3Reset"),
    "enter_initialisation": ("fmi2EnterInitializationMode", "fmi3EnterInitializationMode"),
    "exit_initialisation": ("fmi2ExitInitializationMode", "fmi3ExitInitializationMode"),
    "set_time": ("fmi2SetTime", "fmi3SetTime"),
    "set_states": ("fmi2SetContinuousStates", "fmi3SetContinuousStates"),
    "get_states": ("fmi2GetContinuousStates", "fmi3GetContinuousStates"),
    "get_nominals": ("fmi2GetNominalsOfContinuousStates", "fmi3GetNominalsOfContinuousStates"),
    "get_derivatives": ("fmi2GetDerivatives", "fmi3GetContinuousStateDerivatives"),
    "get_indicators": ("fmi2GetEventIndicators", "fmi3GetEventIndicators"),
    "set_reals": ("fmi2SetReal", "fmi3SetFloat64"),
    "get_directional": ("fmi2GetDirectionalDerivative", "fmi3GetDirectionalDerivative"),
    "completed_step": ("fmi2CompletedIntegratorStep", "fmi3CompletedIntegratorStep"),
    "enter_event_mode": ("fmi2EnterEventMode", "fmi3EnterEventMode"),
    "update_discrete": ("fmi2NewDiscreteStates", "fmi3UpdateDiscreteStates"),
    "enter_continuous_mode": ("fmi2EnterContinuousTimeMode", "fmi3EnterContinuousTimeMode"),
}
SETUP = "fmi2SetupExperiment"
MATRICES, PARAMETER_COLUMN = "htbMatrices", "htbParameterColumn"  # of our own FMUs, not of the standard

# Type of variable -> the end of its functions' names, and how it lies in memory; FMI 2 and FMI 3.
TYPES: dict[int, dict[str, tuple[str, int]]] = {
    2: {
        "Real": ("Real", KIND_DOUBLE),
        "Integer": ("Integer", KIND_INT),
        "Enumeration": ("Integer", KIND_INT),
        "Boolean": ("Boolean", KIND_INT),
    },
    3: {
        "Float64": ("Float64", KIND_DOUBLE),
        "Float32": ("Float32", KIND_SINGLE),
        "Int8": ("Int8", KIND_INT8),
        "UInt8": ("UInt8", KIND_UINT8),
        "Int16": ("Int16", KIND_INT16),
        "UInt16": ("UInt16", KIND_UINT16),
        "Int32": ("Int32", KIND_INT),
        "UInt32": ("UInt32", KIND_UINT32),
        "Int64": ("Int64", KIND_LONG),
        "UInt64": ("UInt64", KIND_UINT64),
        "Enumeration": ("Int64", KIND_LONG),
        "Boolean": ("Boolean", KIND_OCTET),
    },
}


def access(model: Model, names: Sequence[str], verb: str, address: Callable[[str], int]) -> dict[str, Any]:
    """What `Access` of the kernel points to, to read or set these variables.

    Args:
        verb: "Get" or "Set".
        address: of a function of the FMU, by its name.
    """
    fmi = model.abilities.fmi
    groups: dict[tuple[str, int], list[int]] = {}
    for place, name in enumerate(names):
        groups.setdefault(TYPES[fmi][model[name].type], []).append(place)
    places = [place for members in groups.values() for place in members]
    return {
        "groups": len(groups),
        "functions": np.array([address(f"fmi{fmi}{verb}{ending}") for ending, _ in groups], dtype=np.int64),
        "kinds": np.array([kind for _, kind in groups], dtype=np.int64),
        "first": np.cumsum([0, *map(len, groups.values())], dtype=np.int64),
        "references": np.array([model[names[place]].reference for place in places], dtype=np.uint32),
        "places": np.array(places, dtype=np.int64),
    }
