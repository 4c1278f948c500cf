"""Run FMUs fast: one compiled loop that calls the FMU's own functions."""

from pysim.simulate._base import Solver
from pysim.simulate._many import simulate_many
from pysim.simulate._native import is_compiled
from pysim.simulate._run import simulate
from pysim.simulate.esdirk import Esdirk
from pysim.simulate.rk4 import Rk4
from pysim.simulate.rk45 import Rk45
from pysim.simulate.rodas import Rodas

__all__ = ["Esdirk", "Rk4", "Rk45", "Rodas", "Solver", "is_compiled", "simulate", "simulate_many"]
