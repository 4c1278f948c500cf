"""FMUs as members of a co-simulation, in this process or in one of their own."""

from pysim.cosim.members.fmu import Fmu
from pysim.cosim.members.isolated import Isolated

__all__ = ["Fmu", "Isolated"]
