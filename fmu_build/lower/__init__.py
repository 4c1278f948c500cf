"""Lowering: FlatModel -> OdeModel."""

from fmu_build.lower.lowering import lower
from fmu_build.lower.ode_model import OdeModel

__all__ = ["OdeModel", "lower"]
