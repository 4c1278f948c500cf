"""The rig's FMU as a member."""

from __future__ import annotations

from collections.abc import Mapping

from pysim.cosim.members import Fmu
from pysim.simulate import Rodas, Solver
from pysim.types import Model

_NONE: Mapping[str, float] = {}


def rig_member(
    model: Model, *, interface: str = "", solver: Solver | None = None, parameters: Mapping[str, float] = _NONE
) -> Fmu:
    """LoadCircuit.Rig as the member "rig", for `rig_system`.

    The one output that follows a command at once is the pulses' speed, by its sign. But a sign changes by an event, and
    between two samples the controller has no use for it: here it is seen with the next step, and there is no algebraic
    loop from speed to command to speed.

    Args:
        model: an FMU of LoadCircuit.Rig, or of a class that extends it.
        interface, solver: as of Fmu.
        parameters: of the model.
    """
    solver = Rodas() if solver is None else solver
    own = {"alphaCMD_t": 0.0, **parameters}
    return Fmu("rig", model, interface=interface, solver=solver, parameters=own, feedthrough="none")
