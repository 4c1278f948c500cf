"""Run a system of FMUs and controllers that a file describes."""

from __future__ import annotations

import argparse
import json
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from pysim.cosim import SystemFile
    from pysim.types import Record


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The words behind `pysim cosim`."""
    parser.add_argument("system", metavar="FILE.toml|FILE.ssp", type=Path, help="what is wired to what, and its run")
    parser.add_argument("--stop", metavar="SECONDS", type=float, help="end of the run (the file's own)")
    parser.add_argument(
        "--step", metavar="SECONDS", type=float, help="between two communication points (the file's own)"
    )
    parser.add_argument("--export-ssp", metavar="FILE.ssp", type=Path, help="write the system's FMUs and wires; no run")
    parser.add_argument("--json", metavar="FILE", type=Path, help="write how the run went here")
    parser.add_argument(
        "-o", "--output", metavar="DIR", type=Path, help="write record.csv, report.html and the plot here"
    )


def run(args: argparse.Namespace) -> int:
    """Run the system, print where each signal went; 1 when the run stops early, with what was reached written."""
    from pysim.cli.outputs import JSON, prepare_file, prepare_folder
    from pysim.types import BadInput, Outcome

    for option in ("stop", "step"):
        value = getattr(args, option)
        if value is not None and not 0 < value < float("inf"):
            raise BadInput(f"--{option} {value:g}: give a positive number of seconds")
    file = _read(args)
    if args.export_ssp:
        return _export(args, file)
    if args.output:
        prepare_folder(args.output)
    if args.json:
        prepare_file(args.json, "--json", JSON)
    record, seconds = _simulated(args.system, file)
    _write(args, file, record, seconds)
    return 0 if record.outcome is Outcome.DONE else 1


def _read(args: argparse.Namespace) -> SystemFile:
    from pysim.cosim import read_system_file
    from pysim.cosim.ssp import read_ssp

    read = read_ssp if args.system.suffix.lower() == ".ssp" else read_system_file
    return read(args.system, stop=args.stop, step=args.step)


def _export(args: argparse.Namespace, file: SystemFile) -> int:
    from pysim.cli.outputs import prepare_file
    from pysim.cosim.ssp import write_ssp

    package = [args.system] if args.system.suffix.lower() == ".ssp" else []
    prepare_file(args.export_ssp, "--export-ssp", (".ssp",), read=package)
    left_out = write_ssp(file, args.export_ssp)
    for text in left_out:
        print(f"pysim cosim: left out: {text}", file=sys.stderr)
    print(f"Written: {args.export_ssp}")
    return 0


def _simulated(path: Path, file: SystemFile) -> tuple[Record, float]:
    import time

    from pysim.cli.progress import ProgressBar, announce_compilation
    from pysim.cosim import cosimulate
    from pysim.types import BadInput

    announce_compilation()
    start, stop = file.experiment.start, float(file.experiment.times[-1])
    begun = time.perf_counter()
    with ProgressBar("co-simulating") as bar:
        try:
            record = cosimulate(
                file.system,
                file.experiment,
                step=file.step,
                order=file.order,
                doubling=file.doubling,
                check=False,
                progress=lambda at: bar(round(1000 * (at - start) / (stop - start)), 1000),
            )
        except BadInput as error:  # parts that are right each, and do not go together
            raise BadInput(f"{path}: {error}") from error
    return record, time.perf_counter() - begun


def _write(args: argparse.Namespace, file: SystemFile, record: Record, seconds: float) -> None:
    from pysim.io import write_file, write_record
    from pysim.report.cosim import cosim_data, cosim_text

    print(cosim_text(file.name, record, seconds))
    if args.json:
        write_file(args.json, json.dumps(cosim_data(file.name, record, seconds), indent=1, allow_nan=False))
    if args.output and record.time.size:
        write_record(record, args.output / "record.csv")
        _write_report(args, file, record, seconds)


def _write_report(args: argparse.Namespace, file: SystemFile, record: Record, seconds: float) -> None:
    from pysim.cli.outputs import repeating
    from pysim.io import write_file
    from pysim.plot import cosim_figure, render
    from pysim.report.cosim import cosim_page

    figure = cosim_figure(record)
    write_file(args.output / "cosim.png", render(figure, "png"))
    svg = render(figure, "svg")
    write_file(args.output / "cosim.svg", svg)
    text = cosim_page(
        file.name,
        record,
        seconds,
        parts=[(m.name, _what(m), len(m.inputs), len(m.outputs)) for m in file.system.members],
        wires=[(c.source, c.target, c.gain, c.offset) for c in file.system.connections],
        pictures={"Everything that was recorded, by unit.": svg},
        redo=repeating(args),
    )
    write_file(args.output / "report.html", text)
    print(f"Report: {args.output / 'report.html'}")


def _what(member: Any) -> str:
    """What a member is, in a few words."""
    from pysim.cosim import Sampled
    from pysim.cosim.members import Fmu, Isolated

    if isinstance(member, Isolated):
        return f"{_what(member.member)}, in a process of its own"
    if isinstance(member, Fmu):
        how = "stepped by our solver" if member.interface == "model-exchange" else "steps by itself"
        return (
            f"{member.model.path.name}, FMI {member.model.abilities.fmi}, {member.interface.replace('-', ' ')}: {how}"
        )
    if isinstance(member, Sampled):
        delay = f", {1e3 * member.delay:g} ms later" if member.delay else ""
        return f"{type(member.block).__name__}, sampled every {1e3 * member.every:g} ms{delay}"
    return type(member).__name__
