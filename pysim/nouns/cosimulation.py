"""FMUs and controllers wired together and stepped."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from pysim.nouns.common import Input, signal_of
from pysim.nouns.controller import PlainBlock, step_arguments
from pysim.nouns.model import Model, model
from pysim.nouns.run import Run
from pysim.present.progress import Progress, showing
from pysim.types import BadInput, Experiment, ProgressEvent
from pysim.types import Model as Compiled

if TYPE_CHECKING:
    from pysim.cosim.members import Fmu
    from pysim.cosim.system import Part

_SAID = 100  # times that a run says how far it is, at most
_BLOCK = ("inputs", "outputs", "step", "state", "restore")


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
        members: name -> an .fmu, a model, a block or member of `pysim.cosim`, or a plain object with `step(t, ...)`,
            whose arguments after the time are its inputs. A controller is sampled every `dt`, or every `dt` of its own.
        dt: s between two communication points.
        stop: end of the run, s.
        wires: "member.output" -> "member.input", or a row of them where it drives several.
        inputs: "member.input" -> number, pairs (s, value), a row of values, a pandas column, or a function of time.
        record: "member.port"; all outputs and driven inputs by default.
        check: False gives back what a run that failed has reached, in place of an error.
        progress: see `pysim.present.progress.showing`.
    Raises:
        BadInput: an unknown name, units that differ, an input that nothing drives, or an algebraic loop.
        SimulationError: a member failed; `.record` is the part that was reached.
    """
    from pysim.cosim import Connection, Sampled, System
    from pysim.cosim import cosimulate as stepped

    if not dt > 0 or not stop >= dt:
        raise BadInput(
            f"cosimulate: dt = {dt:g} s and stop = {stop:g} s; give a stop of at least one dt, above zero",
            argument="stop",
        )
    pairs = [(a, one) for a, b in wires.items() for one in ([b] if isinstance(b, str) else b)]
    driven = {name: signal_of(value, stop, name) for name, value in (inputs or {}).items()}
    targets = {*(target for _, target in pairs), *driven}
    parts = _parts(members, pairs, targets, dt)
    plain = [one.block for one in parts if isinstance(one, Sampled) and isinstance(one.block, PlainBlock)]
    system = System(tuple(parts), tuple(Connection(*pair, *_conversion(parts, *pair)) for pair in pairs))
    names = tuple(record) or (*system.outputs, *driven)
    times = np.asarray(dt * np.arange(round(stop / dt) + 1), dtype=np.float64)
    every = -(-times.size // _SAID)
    with showing(progress, "co-simulation") as say:

        def heard(time: float) -> None:
            if round(time / dt) % every == 0:
                say(ProgressEvent(f"at {time:.3g} of {stop:g} s"))

        experiment = Experiment(times, names, driven, rates=_rates(parts, driven))
        try:
            done = stepped(system, experiment, step=dt, check=check, progress=heard)
        finally:
            for block in plain:
                block.end()
    return Run(done, " + ".join(members))


def _parts(members: Mapping[str, Any], pairs: Sequence[tuple[str, str]], targets: set[str], dt: float) -> list[Part]:
    """The members, FMUs first, as those know the units of what is wired to them."""
    from pysim.cosim import Sampled

    found: dict[str, Part] = {}
    plain: dict[str, Any] = {}
    for name, one in members.items():
        if isinstance(one, str | Path | Model | Compiled):
            found[name] = _fmu(name, one, targets)
        elif isinstance(one, Sampled) or hasattr(one, "can_rollback"):
            found[name] = one
        elif all(hasattr(one, attribute) for attribute in _BLOCK):
            found[name] = Sampled(name, one, getattr(one, "dt", None) or dt)
        else:
            step_arguments(name, one)
            plain[name] = one
    units = {f"{n}.{p.name}": p.unit for n, part in found.items() for p in (*part.inputs, *part.outputs)}
    for _ in plain:  # a unit goes from wire to wire, through as many controllers as there are
        for source, target in pairs:
            known = units.get(source) or units.get(target)
            if known:
                units.setdefault(source, known)
                units.setdefault(target, known)
    for name, one in plain.items():
        own = {port.partition(".")[2]: unit for port, unit in units.items() if port.partition(".")[0] == name}
        block = PlainBlock(name, one, _outputs(name, one, pairs), own)
        block.begin()
        found[name] = Sampled(name, block, block.dt or dt)
    return [found[name] for name in members]


def _outputs(name: str, one: Any, pairs: Sequence[tuple[str, str]]) -> list[str]:
    """Names of what a controller returns: those it lists itself, else those that wires begin with."""
    listed = getattr(one, "outputs", None)
    if listed:
        return [str(each) for each in listed]
    wired = [source.partition(".")[2] for source, _ in pairs if source.partition(".")[0] == name]
    return list(dict.fromkeys(wired)) or ["u"]


def _fmu(name: str, one: Any, targets: set[str]) -> Fmu:
    """An FMU whose inputs that nothing drives keep their start values."""
    from pysim.cosim.members import Fmu

    noun = one if isinstance(one, Model) else model(one)
    compiled = noun.compiled
    idle = {
        v.name: v.start or 0.0
        for v in compiled.variables
        if v.causality == "input" and f"{name}.{v.name}" not in targets and not v.name.startswith("probe.")
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


def _rates(parts: Sequence[Part], driven: Mapping[str, Any]) -> dict[str, str]:
    """Inputs of FMUs that take the exact rate of a driven one."""
    from pysim.cosim.members import Fmu

    return {
        f"{part.name}.{rate}": f"{part.name}.{name}"
        for part in parts
        if isinstance(part, Fmu)
        for rate, name in part.model.rate_inputs(
            n.partition(".")[2] for n in driven if n.partition(".")[0] == part.name
        ).items()
    }
