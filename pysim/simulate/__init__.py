"""Run FMUs fast: one compiled loop that calls the FMU's own functions."""

from pysim.simulate._base import Solver
from pysim.simulate._many import simulate_many
from pysim.simulate._run import simulate
from pysim.simulate.esdirk import Esdirk
from pysim.simulate.native.compiled import is_compiled
from pysim.simulate.rk4 import Rk4
from pysim.simulate.rk45 import Rk45
from pysim.simulate.rodas import Rodas
from pysim.simulate.sensitivity.orbit import Orbit
from pysim.simulate.sensitivity.periodic import Periodic, periodic_many
from pysim.simulate.sensitivity.sensitivities import Sensitivities, sensitivities, sensitivities_many

__all__ = [
    "Esdirk",
    "Orbit",
    "Periodic",
    "Rk4",
    "Rk45",
    "Rodas",
    "Sensitivities",
    "Solver",
    "is_compiled",
    "periodic_many",
    "sensitivities",
    "sensitivities_many",
    "simulate",
    "simulate_many",
]
