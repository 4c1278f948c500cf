"""The only things that cross folders: frozen, checked once, numpy and the standard library only."""

from pysim.types.errors import BadInput, SimulationError
from pysim.types.experiment import Experiment
from pysim.types.model import Abilities, Model, Variable
from pysim.types.record import Outcome, Record
from pysim.types.signal import Signal

__all__ = [
    "Abilities",
    "BadInput",
    "Experiment",
    "Model",
    "Outcome",
    "Record",
    "Signal",
    "SimulationError",
    "Variable",
]
