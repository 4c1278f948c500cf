"""How a run begins: members are started, their initial values go round until they rest, the first point is done."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import partial

from pysim.cosim._core import Core
from pysim.cosim._fault import Fault, fault
from pysim.cosim._prepare import overrides_of
from pysim.cosim.gauss_seidel import stepping_order
from pysim.cosim.member import Setup
from pysim.types import BadInput, Experiment, Outcome


def start(core: Core, experiment: Experiment, step: float) -> None:
    """Start all members, those first that drive others, and make the row consistent at the first point.

    Raises:
        BadInput: an override that its member does not have.
        Fault: a member could not be started, or the initial values do not settle.
    """
    _first_values(core)
    members = {member.name: member for member in core.layout.members}
    overrides = overrides_of(core.system, experiment)
    for name in stepping_order(core.system, list(members)):
        core.row.carry(core.layout.wires_to(name))
        _guarded(name, partial(members[name].start, _setup(core, experiment, step, name, overrides[name])))
    if not core.exchange.settle(experiment.start, len(members) + 2, exact=not core.system.loops):
        why = "their initial values go round in a circle and do not settle"
        raise Fault(", ".join(members), why, Outcome.NOT_CONVERGED)
    for name, member in members.items():
        _guarded(name, member.begin)
    core.exchange.at(0, experiment.start)


def _first_values(core: Core) -> None:
    """What ports say of their start, and signals; blocks have set theirs already."""
    system, layout, row = core.system, core.layout, core.row.array
    for member in layout.members:
        for port in member.outputs:
            row[layout.outputs[f"{member.name}.{port.name}"]] = port.start or 0.0
    for name, slot in layout.inputs.items():
        row[slot] = system.inputs[name].start or 0.0
    if layout.signals:
        row[len(layout.outputs) : layout.sources.stop] = core.signals.at(0)


def _setup(core: Core, experiment: Experiment, step: float, name: str, overrides: Mapping[str, float]) -> Setup:
    place = core.layout.places[name]
    return Setup(
        time=experiment.start,
        stop=float(experiment.times[-1]),
        step=step,
        inputs=core.row.part(place.inputs),
        rates=core.row.part(place.rates),
        outputs=core.row.part(place.outputs),
        overrides=overrides,
    )


def _guarded(name: str, call: Callable[[], None]) -> None:
    """Call; what a member raises is its fault, but for the user's mistakes."""
    try:
        call()
    except BadInput:
        raise
    except Exception as error:
        raise fault(name, error) from error
