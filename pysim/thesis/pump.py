"""The thesis' pump as FMUs, built from the Modelica library of this distribution."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from types import MappingProxyType

from pysim.types import Model
from pysim.workflow.model import compiled

CLASSES: Mapping[str, str] = MappingProxyType(
    {"free": "HydraulicTestBench.Pump.FreeGreyBox", "locked": "HydraulicTestBench.Pump.LockedGreyBox"}
)

SOURCES: Mapping[str, str] = MappingProxyType(
    {"free": "free grey-box set, thesis Table 4.6", "locked": "locked grey-box set, thesis Table 4.5"}
)


def pump_model(parameter_set: str, *, fmi: int = 2, output: Path | None = None) -> Model:
    """The pump with one of the thesis' parameter sets.

    Args:
        parameter_set: "free" (thesis Table 4.6) or "locked" (Table 4.5).
        fmi: 2 or 3.
        output: file to write; in the cache otherwise.
    """
    return compiled(CLASSES[parameter_set], (), output, fmi=fmi)
