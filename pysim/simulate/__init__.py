"""Run FMUs fast: a kernel in C that calls the FMU's own functions."""

from pysim.simulate._base import Solver
from pysim.simulate._check import check_override, value_objection
from pysim.simulate._messages import Mailbox
from pysim.simulate._pool import one_blas_thread
from pysim.simulate._request import Take
from pysim.simulate._run import simulate, simulate_many
from pysim.simulate.esdirk import Esdirk
from pysim.simulate.fmu_states import FmuState, FmuStates
from pysim.simulate.fmu_values import FmuValues, is_number
from pysim.simulate.kernel.build import build_kernel, kernel_is_built
from pysim.simulate.rk4 import Rk4
from pysim.simulate.rk45 import Rk45
from pysim.simulate.rodas import Rodas
from pysim.simulate.rounding import rounding
from pysim.simulate.runs import Runs, open_runs
from pysim.simulate.sensitivity.orbit import Orbit, Orbits, OrbitStack
from pysim.simulate.sensitivity.periodic import Periodic, periodic_many
from pysim.simulate.sensitivity.sensitivities import Sensitivities, sensitivities, sensitivities_many
from pysim.simulate.stepwise import (
    SavedStep,
    StepFailed,
    Stepwise,
    Wires,
    can_be_saved,
    is_smooth,
    open_stepwise,
)

__all__ = [
    "Esdirk",
    "FmuState",
    "FmuStates",
    "FmuValues",
    "Mailbox",
    "Orbit",
    "OrbitStack",
    "Orbits",
    "Periodic",
    "Rk4",
    "Rk45",
    "Rodas",
    "Runs",
    "SavedStep",
    "Sensitivities",
    "Solver",
    "StepFailed",
    "Stepwise",
    "Take",
    "Wires",
    "build_kernel",
    "can_be_saved",
    "check_override",
    "is_number",
    "is_smooth",
    "kernel_is_built",
    "one_blas_thread",
    "open_runs",
    "open_stepwise",
    "periodic_many",
    "rounding",
    "sensitivities",
    "sensitivities_many",
    "simulate",
    "simulate_many",
    "value_objection",
]
