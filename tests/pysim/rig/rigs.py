"""The rig and the crane, built once."""

from functools import cache

import fmu_build
from pysim.io import read_model
from pysim.types import Model


@cache
def model(name: str, fmi: int = 2) -> Model:
    """A class of the library, its name without `HydraulicTestBench.`."""
    return read_model(fmu_build.build(f"HydraulicTestBench.{name}", fmi=fmi))
