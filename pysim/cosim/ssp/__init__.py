"""Systems as System Structure and Parameterization packages (SSP 1.0), for OMSimulator, libcosim and others."""

from pysim.cosim.ssp.read import read_ssp
from pysim.cosim.ssp.write import write_ssp

__all__ = ["read_ssp", "write_ssp"]
