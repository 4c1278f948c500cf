"""Say what a data set holds and what should be looked at; draft a dataset.toml for plain logs."""

from __future__ import annotations

import argparse
import json
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable

    from matplotlib.figure import Figure

    from pysim.identify.data_check import DataCheck
    from pysim.types import Dataset, MeasuredSignal


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The words behind `pysim data`."""
    actions = parser.add_subparsers(dest="action", required=True, metavar="ACTION")
    check = actions.add_parser("check", help="read a data set and print what it holds")
    check.add_argument("dataset", metavar="DATASET", type=Path, help="folder with a dataset.toml, or that file")
    _add_signals(check, "the command, second column of logs without a dataset.toml whose names tell their frequency")
    check.add_argument("--json", metavar="FILE", type=Path, help="write all numbers here")
    check.add_argument("-o", "--output", metavar="DIR", type=Path, help="write report.html and the plots here")
    describe = actions.add_parser("describe", help="draft a dataset.toml into a folder of logs that has none")
    describe.add_argument("dataset", metavar="FOLDER", type=Path, help="of logs; nothing else in it is changed")
    _add_signals(describe, "what drives the plant, by its heading, or in the order of the columns (the second)")


def _add_signals(parser: argparse.ArgumentParser, what: str) -> None:
    for option, of in (("--input", what), ("--response", "the columns behind it, one by one")):
        parser.add_argument(
            option, metavar="NAME:UNIT,...", action="append", default=[], help=f"{of}; commas or repeat"
        )


def run(args: argparse.Namespace) -> int:
    """Print what was found, or what was drafted; 0 where the data set can be read, warnings or not."""
    return _describe(args) if args.action == "describe" else _check(args)


def _describe(args: argparse.Namespace) -> int:
    """Write the draft; never over a description that is there."""
    from pysim.cli._describe import draft, draft_text, open_ends
    from pysim.cli.outputs import command_line
    from pysim.io import write_file
    from pysim.types import BadInput

    target = args.dataset / "dataset.toml"
    if not args.dataset.is_dir():
        raise BadInput(f"{args.dataset} is no folder; name the folder of the logs")
    if target.exists():
        raise BadInput(f"{target} is there already and stays as it is; remove it first where it is to be drafted anew")
    found = draft(args.dataset, _units(args.input), _units(args.response))
    write_file(target, draft_text(found))
    print(
        f"Drafted: {target}, {len(found.columns)} log{'s' * (len(found.columns) > 1)}, signals {', '.join(found.roles)}"
    )
    for remark in found.remarks:
        print(f"  {remark}")
    for what in open_ends(found):
        print(f"  to fill in: {what}")
    print(f"Look through it, then: {command_line(['data', 'check', str(args.dataset)])}")
    return 0


def _units(texts: list[str]) -> dict[str, str]:
    """Signal -> unit in the files."""
    from pysim.cli.options import names_of
    from pysim.io.units import unit_cure
    from pysim.types import UNITS, BadInput

    signals = [_signal("input", text) for text in names_of(texts)]
    for signal in signals:
        if signal.unit not in UNITS:
            raise BadInput(f"signal {signal.name}: unit = {signal.unit!r} is not known; {unit_cure(signal.unit)}")
    return {signal.name: signal.unit for signal in signals}


def _check(args: argparse.Namespace) -> int:
    from pysim.cli.outputs import JSON, prepare_file, prepare_folder
    from pysim.identify.data_check import check_dataset
    from pysim.io import write_file
    from pysim.report.data_check import data_check_data, data_check_text

    check = check_dataset(_read(args))
    if args.output:
        prepare_folder(args.output, read=[args.dataset])
    if args.json:
        prepare_file(args.json, "--json", JSON, read=[args.dataset])
    print(data_check_text(check))
    if args.json:
        write_file(args.json, json.dumps(data_check_data(check), indent=1, allow_nan=False))
    if args.output:
        _write_report(args, check)
    return 0


def _read(args: argparse.Namespace) -> Dataset:
    from pysim.cli._measurements import read_measurements
    from pysim.cli.options import names_of
    from pysim.io import read_thesis_folder
    from pysim.types import BadInput

    inputs, responses = names_of(args.input), names_of(args.response)
    if not (inputs or responses):
        return read_measurements(args.dataset)
    if len(inputs) != 1 or not responses:
        raise BadInput("logs without a dataset.toml need one --input NAME:UNIT and at least one --response NAME:UNIT")
    signals = [_signal("input", inputs[0]), *(_signal("output", text) for text in responses)]
    return read_thesis_folder(args.dataset, signals)


def _signal(role: str, text: str) -> MeasuredSignal:
    from pysim.types import BadInput, MeasuredSignal

    name, colon, unit = (part.strip() for part in text.rpartition(":"))
    if not (name and colon and unit):
        raise BadInput(f"{text}: write NAME:UNIT, as alphaCMD:%")
    return MeasuredSignal(name, role, unit, name, name)


def _write_report(args: argparse.Namespace, check: DataCheck) -> None:
    from pysim.cli.outputs import repeating
    from pysim.io import write_file
    from pysim.plot import render
    from pysim.plot.data_check import coverage_figure, sine_logs_figure, time_logs_figure
    from pysim.report.data_check import data_check_page

    logs = check.dataset.logs()
    figures: dict[str, tuple[Callable[[Dataset], Figure], str]] = {}
    if any(record.frequency is not None for record in logs):
        figures["coverage"] = (coverage_figure, "Offsets, amplitudes and frequencies of the stepped sines.")
        figures["sines"] = (sine_logs_figure, "The last two periods of stepped sines: the command, and what answered.")
    if any(record.frequency is None for record in logs):
        figures["logs"] = (time_logs_figure, "Logs over time.")
    pictures = {}
    for name, (draw, caption) in figures.items():
        figure = draw(check.dataset)
        write_file(args.output / f"{name}.png", render(figure, "png"))
        figure.set_layout_engine("none")
        pictures[caption] = render(figure, "svg")
        write_file(args.output / f"{name}.svg", pictures[caption])
    text = data_check_page(check, pictures=pictures, redo=repeating(args))
    write_file(args.output / "report.html", text)
    print(f"Report: {args.output / 'report.html'}")
