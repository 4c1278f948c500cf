"""Code generation: OdeModel -> model.c and modelDescription.xml, from one variable table."""

from .c_source import c_source
from .description import Description, model_identifier
from .fmi2 import fmi2_description
from .fmi3 import fmi3_build_description, fmi3_description
from .table import complete_table

__all__ = [
    "Description",
    "c_source",
    "complete_table",
    "fmi2_description",
    "fmi3_build_description",
    "fmi3_description",
    "model_identifier",
]
