"""Whether an experiment fits a system: said before anything runs."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence

import numpy as np

from pysim.cosim.sampled import Sampled
from pysim.cosim.system import System
from pysim.types import BadInput, Experiment

# A time belongs to a communication point this close to it, as a share of the step.
_NEAR = 1e-6


def check_experiment(system: System, experiment: Experiment, *, solves_loops: bool) -> None:
    """Check all names, that every input is driven once, and that loops can be solved.

    Raises:
        BadInput: it does not fit.
    """
    if not isinstance(system, System) or not isinstance(experiment, Experiment):
        raise BadInput(f"co-simulation: got {system!r} and {experiment!r}; give System(...) and Experiment(...)")
    for name in (*experiment.inputs, *experiment.rates):
        system.port("input", name)
        if name in system.drivers:
            raise BadInput(
                f"experiment: {name} has a signal and is driven by {system.drivers[name].source}; remove one of them"
            )
    for name in experiment.record:
        if name not in system.inputs:
            system.port("output", name)
    _check_driven(system, experiment)
    if system.loops and not solves_loops:
        ways = "; ".join(" -> ".join(loop) for loop in system.loops)
        raise BadInput(
            f"system: algebraic loop {ways}; give a sampled block among them a delay, remove a connection, or take "
            "order=Iterated(), which solves it"
        )


def _check_driven(system: System, experiment: Experiment) -> None:
    free = undriven(system, experiment)
    if free:
        outputs = ", ".join(system.outputs) or "there are none"
        raise BadInput(
            f"system: nothing drives {', '.join(free)}; connect an output ({outputs}), give the experiment a signal, "
            f"inputs={{{free[0]!r}: Signal.constant(...)}}, or an FMU a value of that name among its parameters"
        )


def undriven(system: System, experiment: Experiment) -> list[str]:
    """Inputs without a start that no connection and no signal drives."""
    driven = {*system.drivers, *experiment.inputs, *experiment.rates}
    return [name for name, port in system.inputs.items() if name not in driven and port.start is None]


def unheard(system: System, recorded: Collection[str]) -> dict[str, list[str]]:
    """Controller -> its outputs that no connection begins at, and that are not named to be recorded."""
    heard = {*recorded, *(connection.source for connection in system.connections)}
    return {
        part.name: [name for name in (f"{part.name}.{port.name}" for port in part.outputs) if name not in heard]
        for part in system.members
        if isinstance(part, Sampled)
    }


def check_heard(system: System, recorded: Collection[str], idle: Sequence[str] = ()) -> None:
    """Check that each controller has an output that goes somewhere.

    Args:
        recorded: outputs that were named to be recorded.
        idle: inputs that nothing drives, for the message.
    Raises:
        BadInput: one has none.
    """
    silent = unheard(system, recorded)
    for part in system.members:
        lost = silent.get(part.name)
        if lost and len(lost) == len(part.outputs):
            where = f"one that nothing drives, {', '.join(idle)}" if idle else "an input"
            raise BadInput(
                f"system: {', '.join(lost)} goes nowhere, so {part.name} does nothing; connect it to {where}, or name "
                "it in record, where it is only to be recorded"
            )


def overrides_of(system: System, experiment: Experiment) -> Mapping[str, Mapping[str, float]]:
    """The experiment's overrides by member.

    Raises:
        BadInput: of no member, or of a block.
    """
    by_member: dict[str, dict[str, float]] = {member.name: {} for member in system.members}
    for name, value in experiment.overrides.items():
        member, _, parameter = name.partition(".")
        if member not in by_member or not parameter:
            raise BadInput(
                f"experiment: override {name!r} is of no member; write one of {', '.join(by_member)}, a dot, a name"
            )
        by_member[member][parameter] = float(value)
    for part in system.members:
        if isinstance(part, Sampled) and by_member[part.name]:
            raise BadInput(
                f"experiment: {part.name} is a block and takes no overrides; make the block with other settings"
            )
    return by_member


def tick_of(time: float, start: float, step: float, what: str = "time", *, least: int = 0) -> int:
    """The number of the communication point at a time, s.

    Raises:
        BadInput: there is none.
    """
    exact = float((time - start) / step)
    number = float(np.rint(exact))
    if not abs(exact - number) <= _NEAR or number < least:
        raise BadInput(
            f"{what} {time:.12g} s is no whole number of steps of {step:g} s from {start:g} s ({exact:.6g}); take a "
            "step that divides it"
        )
    return int(number)


def ticks(experiment: Experiment, step: float) -> list[int]:
    """The communication points of the experiment's times.

    Raises:
        BadInput: a time lies between two, or two at one.
    """
    exact = (experiment.times - experiment.start) / step
    numbers = np.rint(exact)
    for time in experiment.times[np.abs(exact - numbers) > _NEAR]:
        tick_of(float(time), experiment.start, step)  # says so
    if np.any(np.diff(numbers) < 1):
        raise BadInput(f"experiment: its times lie closer than the step of {step:g} s; take a smaller step")
    return [int(number) for number in numbers]
