"""`pysim cosim`."""

from __future__ import annotations

import sys
import time
from pathlib import Path
from typing import TYPE_CHECKING, Any

from pysim.cli.command import DONE, Command, Given
from pysim.cli.option import Option, Role, file, number, positive
from pysim.cli.options import JSON, OUTPUT

if TYPE_CHECKING:
    from pysim.cosim import SystemFile
    from pysim.present.cosim import CoSimulation
    from pysim.types import Record


def run(given: Given) -> CoSimulation | int:
    """The system's run; or with --export-ssp its package, and no run."""
    from pysim.present.cosim import CoSimulation

    system = _read(given)
    if given.export_ssp:
        return _export(given, system)
    record, seconds = _simulated(given, system)
    parts = [(m.name, _what(m), len(m.inputs), len(m.outputs)) for m in system.system.members]
    wires = [(c.source, c.target, c.gain, c.offset) for c in system.system.connections]
    return CoSimulation(system.name, record, seconds, parts, wires)


def _is_package(path: Path) -> bool:
    return path.suffix.lower() == ".ssp"


def _read(given: Given) -> SystemFile:
    from pysim.cosim import read_system_file
    from pysim.cosim.ssp import read_ssp

    read = read_ssp if _is_package(given.system) else read_system_file
    return read(given.system, stop=given.stop, step=given.step)


def _export(given: Given, system: SystemFile) -> int:
    from pysim.cli.outputs import prepare_file
    from pysim.cosim.ssp import write_ssp

    prepare_file(given.export_ssp, "--export-ssp", (".ssp",), read=[given.system] if _is_package(given.system) else [])
    for left_out in write_ssp(system, given.export_ssp):
        print(f"pysim cosim: left out: {left_out}", file=sys.stderr)
    print(f"Written: {given.export_ssp}")
    return DONE


def _simulated(given: Given, system: SystemFile) -> tuple[Record, float]:
    """The record, and the seconds that it took."""
    from pysim.cosim import cosimulate
    from pysim.present.progress import announce_compilation
    from pysim.types import BadInput

    announce_compilation()
    start, stop = system.experiment.start, float(system.experiment.times[-1])
    begun = time.perf_counter()
    with given.progress("co-simulating") as bar:
        try:
            record = cosimulate(
                system.system,
                system.experiment,
                step=system.step,
                order=system.order,
                doubling=system.doubling,
                check=False,
                progress=lambda at: bar(round(1000 * (at - start) / (stop - start)), 1000),
            )
        except BadInput as error:  # parts that are right each, and do not go together
            raise BadInput(f"{given.system}: {error}") from error
    return record, time.perf_counter() - begun


def _what(member: Any) -> str:
    """What a member is, in a few words."""
    from pysim.cosim import Sampled
    from pysim.cosim.members import Fmu, Isolated
    from pysim.cosim.plain import own_object

    if isinstance(member, Isolated):
        return f"{_what(member.member)}, in a process of its own"
    if isinstance(member, Fmu):
        how = "stepped by our solver" if member.interface == "model-exchange" else "steps by itself"
        return (
            f"{member.model.path.name}, FMI {member.model.abilities.fmi}, {member.interface.replace('-', ' ')}: {how}"
        )
    if isinstance(member, Sampled):
        delay = f", {1e3 * member.delay:g} ms later" if member.delay else ""
        return f"{type(own_object(member.block)).__name__}, sampled every {1e3 * member.every:g} ms{delay}"
    return type(member).__name__


COMMAND = Command(
    "cosim",
    "Run a system of FMUs and controllers that a file describes.",
    run,
    options=(
        Option(("SYSTEM",), "file that describes members, wires and run", "FILE.toml|FILE.ssp", convert=Path),
        number("--stop", "SECONDS", None, "end of the run (the file's own)", convert=positive),
        number("--step", "SECONDS", None, "communication step (the file's own)", convert=positive),
        file("--export-ssp", "FILE.ssp", "write FMUs and wires as an SSP package, without a run", role=Role.PLACE),
        JSON,
        OUTPUT,
    ),
    passes=lambda result: bool(result.record.outcome.name == "DONE"),
)
