"""A pump that shares no equation with the models that are fitted to it: the plant behind the blind benchmark."""

from validation.blind.plant.case import Case, Measured, measure, write_case
from validation.blind.plant.effects import BEYOND, STANDARD
from validation.blind.plant.equations import COLUMNS, run
from validation.blind.plant.nuisance import Nuisance
from validation.blind.plant.programme import FEW_SINES, UNSEEN, Test, programme
from validation.blind.plant.quantities import BOUNDS, Parameters, Strengths
from validation.blind.plant.table import cases

__all__ = [
    "BEYOND",
    "BOUNDS",
    "COLUMNS",
    "FEW_SINES",
    "STANDARD",
    "UNSEEN",
    "Case",
    "Measured",
    "Nuisance",
    "Parameters",
    "Strengths",
    "Test",
    "cases",
    "measure",
    "programme",
    "run",
    "write_case",
]
