"""Code generation: OdeModel -> model.c and modelDescription.xml, from one variable table."""

from fmu_build.emit.c_source import c_source
from fmu_build.emit.description import GENERATION_TOOL, Description, model_identifier
from fmu_build.emit.fmi2 import fmi2_description
from fmu_build.emit.fmi3 import fmi3_build_description, fmi3_description
from fmu_build.emit.table import complete_table

__all__ = [
    "GENERATION_TOOL",
    "Description",
    "c_source",
    "complete_table",
    "fmi2_description",
    "fmi3_build_description",
    "fmi3_description",
    "model_identifier",
]
