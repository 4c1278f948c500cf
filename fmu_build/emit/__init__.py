"""Code generation: OdeModel -> model.c and modelDescription.xml, from one variable table."""

from .c_source import c_source
from .table import complete_table

__all__ = ["c_source", "complete_table"]
