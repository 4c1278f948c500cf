"""FMUs and controllers wired together and stepped."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from pysim.nouns.common import Input, signal_of
from pysim.nouns.model import Model, model
from pysim.nouns.run import Run
from pysim.present.progress import Progress, showing
from pysim.types import BadInput, Experiment, Note, NoteCode, ProgressEvent, SimulationError
from pysim.types import Model as Compiled
from pysim.types.kinds import mapping_of, names_of, number_of

if TYPE_CHECKING:
    from pysim.cosim.members import Fmu
    from pysim.cosim.system import Part

_SAID = 100  # times that a run says how far it is, at most


def cosimulate(
    members: Mapping[str, Any],
    *,
    dt: float,
    stop: float,
    wires: Mapping[str, str | Sequence[str]],
    inputs: Mapping[str, Input] | None = None,
    record: Sequence[str] = (),
    check: bool = True,
    progress: Progress = None,
) -> Run:
    """Run models and controllers together from 0 to `stop`.

    Args:
        members: name -> an .fmu, a model, a block or member of `pysim.cosim`, or a controller: an object with
            `step(t, ...)`, or a function f(t, ...), whose arguments after the time are its inputs. It is sampled every
            `dt`, or every `dt` of its own. The run steps a copy of it, which `controllers` of the run has at the end.
        dt: s between two communication points.
        stop: end of the run, s, a whole number of `dt`.
        wires: "member.output" -> "member.input", or a row of them where it drives several.
        inputs: "member.input" -> number, pairs (s, value), a row of values, a pandas column, or a function of time.
            A step jumps at a communication point. Between two points an input is a line, or its mean for an FMU that
            takes none.
        record: "member.port"; all outputs and driven inputs by default.
        check: False gives back what a run that failed has reached, in place of an error.
        progress: see `pysim.present.progress.showing`.
    Raises:
        BadInput: an unknown name, units that differ, an input that nothing drives, or an algebraic loop.
        SimulationError: a member failed; `.record` is the part that was reached.
    """
    from pysim.cosim import Connection, System
    from pysim.cosim import Run as Stepped
    from pysim.cosim._prepare import check_heard, tick_of, unheard
    from pysim.cosim.plain import own_object

    dt, stop = number_of(dt, "dt"), number_of(stop, "stop")
    members, wires, record = mapping_of(members, "members"), mapping_of(wires, "wires"), names_of(record, "record")
    if not dt > 0 or not stop >= dt:
        raise BadInput(
            f"cosimulate: dt = {dt:g} s and stop = {stop:g} s; give a stop of at least one dt, above zero",
            argument="stop",
        )
    pairs = [(a, one) for a, b in wires.items() for one in names_of(b, "wires")]
    times = dt * np.arange(tick_of(stop, 0.0, dt, "cosimulate: stop =", least=1) + 1.0)
    driven = {name: signal_of(value, stop, name, times) for name, value in mapping_of(inputs, "inputs").items()}
    targets = {*(target for _, target in pairs), *driven}
    parts = _parts(members, pairs, targets, dt)
    system = System(tuple(parts), tuple(Connection(*pair, *_conversion(parts, *pair)) for pair in pairs))
    idle = _idle(parts, targets)
    check_heard(system, record, idle)
    names = tuple(record) or (*system.outputs, *driven)
    said = 0
    with showing(progress, "co-simulation") as say:

        def heard(time: float) -> None:
            nonlocal said
            if (part := int(_SAID * time / stop)) > said:
                said = part
                say(ProgressEvent(f"at {time:.3g} of {stop:g} s"))

        experiment = Experiment(times, names, driven, rates=_rates(parts, driven, targets))
        run = Stepped(system, experiment, step=dt)
        try:
            with run:
                run.advance(progress=heard)
                done = run.record()
        except SimulationError as error:
            if check:
                raise
            done = error.record
    controllers = {name: own_object(block) for name, block in run.blocks.items()}
    notes: tuple[Note, ...] = ()
    if idle and (lost := [output for own in unheard(system, record).values() for output in own]):
        told = {"outputs": ", ".join(lost), "inputs": ", ".join(idle), "output": lost[0], "input": idle[0]}
        notes = (Note(NoteCode.NOT_WIRED, told),)
    return Run(done, " + ".join(members), notes, controllers)


def _idle(parts: Sequence[Part], targets: set[str]) -> list[str]:
    """Inputs of FMUs that nothing drives, but for rates, which come with what they are the rate of."""
    from pysim.cosim.members import Fmu

    found = []
    for part in parts:
        if isinstance(part, Fmu):
            names = [port.name for port in part.inputs if not port.name.startswith("probe.")]
            rates = part.model.rate_inputs(names)
            found += [f"{part.name}.{n}" for n in names if n not in rates and f"{part.name}.{n}" not in targets]
    return found


def _parts(members: Mapping[str, Any], pairs: Sequence[tuple[str, str]], targets: set[str], dt: float) -> list[Part]:
    """The members, of which a plain controller has its ports and units from the wires."""
    from pysim.cosim import Sampled
    from pysim.cosim.plain import sampled, wired

    found: list[Any] = []
    for name, one in members.items():
        if isinstance(one, str | Path | Model | Compiled):
            found.append(_fmu(name, one, targets))
        elif isinstance(one, Sampled) or hasattr(one, "can_rollback"):
            found.append(one)
        else:
            found.append(sampled(name, one, getattr(one, "dt", None) or dt))
    return list(wired(found, pairs))


def _fmu(name: str, one: Any, targets: set[str]) -> Fmu:
    """An FMU whose inputs that nothing drives keep their start values."""
    from pysim.cosim.members import Fmu

    noun = one if isinstance(one, Model) else model(one)
    compiled = noun.compiled
    idle = {
        port.name: compiled[port.name].start or 0.0
        for port in Fmu(name, compiled).inputs
        if f"{name}.{port.name}" not in targets and not port.name.startswith("probe.")
    }
    return Fmu(name, compiled, parameters={**idle, **noun.values})


def _conversion(parts: Sequence[Part], source: str, target: str) -> tuple[float | None, float]:
    """Factor and offset between the units of two ports; none where they agree, or where the system refuses them."""
    from pysim.cosim.connection import signal_conversion

    ends = [
        next((p.unit for part in parts for p in ports(part) if f"{part.name}.{p.name}" == name), None)
        for name, ports in ((source, lambda part: part.outputs), (target, lambda part: part.inputs))
    ]
    if None in ends or ends[0] == ends[1]:
        return None, 0.0
    found = signal_conversion(str(ends[0]), str(ends[1]))
    return (None, 0.0) if found is None else found


def _rates(parts: Sequence[Part], driven: Mapping[str, Any], targets: set[str]) -> dict[str, str]:
    """Inputs of FMUs that take the exact rate of a driven one, but for those that have a wire of their own."""
    from pysim.cosim.members import Fmu

    return {
        f"{part.name}.{rate}": f"{part.name}.{name}"
        for part in parts
        if isinstance(part, Fmu)
        for rate, name in part.model.rate_inputs(
            n.partition(".")[2] for n in driven if n.partition(".")[0] == part.name
        ).items()
        if f"{part.name}.{rate}" not in targets
    }
