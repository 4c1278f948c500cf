"""FMUs as members of a co-simulation."""

from pysim.cosim.members.fmu import Fmu

__all__ = ["Fmu"]
