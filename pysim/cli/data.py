"""Read a data set, say what it holds and what should be looked at: `pysim data check`."""

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
    for option, what in (
        ("--input", "the command, second column of logs without a dataset.toml whose names tell their frequency"),
        ("--response", "the columns behind it, one by one"),
    ):
        check.add_argument(option, metavar="NAME:UNIT", action="append", default=[], help=what)
    check.add_argument("--json", metavar="FILE", type=Path, help="write all numbers here")
    check.add_argument("--output", metavar="DIR", type=Path, help="write report.html and the plots here")


def run(args: argparse.Namespace) -> int:
    """Print what was found; 0 where the data set can be read, warnings or not."""
    from pysim.cli._outputs import prepare_file, prepare_folder
    from pysim.identify.data_check import check_dataset
    from pysim.io import write_file
    from pysim.report.data_check import data_check_data, data_check_text

    check = check_dataset(_read(args))
    if args.output:
        _refuse_inside(args, "--output", args.output)
        prepare_folder(args.output)
    if args.json:
        _refuse_inside(args, "--json", args.json)
        prepare_file(args.json, "--json")
    print(data_check_text(check))
    if args.json:
        write_file(args.json, json.dumps(data_check_data(check), indent=1, allow_nan=False))
    if args.output:
        _write_report(args, check)
    return 0


def _read(args: argparse.Namespace) -> Dataset:
    from pysim.io import read_dataset, read_thesis_folder
    from pysim.types import BadInput

    if not (args.input or args.response):
        if args.dataset.is_dir() and not (args.dataset / "dataset.toml").exists():
            raise BadInput(
                f"{args.dataset} holds no dataset.toml; name the folder that does, or write one, or tell what logs of "
                "stepped sines hold with --input NAME:UNIT --response NAME:UNIT"
            )
        return read_dataset(args.dataset)
    if len(args.input) != 1 or not args.response:
        raise BadInput("logs without a dataset.toml need one --input NAME:UNIT and at least one --response NAME:UNIT")
    signals = [_signal("input", args.input[0]), *(_signal("output", text) for text in args.response)]
    return read_thesis_folder(args.dataset, signals)


def _signal(role: str, text: str) -> MeasuredSignal:
    from pysim.types import BadInput, MeasuredSignal

    name, colon, unit = (part.strip() for part in text.rpartition(":"))
    if not (name and colon and unit):
        raise BadInput(f"{text}: write NAME:UNIT, as alphaCMD:%")
    return MeasuredSignal(name, role, unit, name, name)


def _refuse_inside(args: argparse.Namespace, option: str, path: Path) -> None:
    """Nothing is written into what was measured."""
    from pysim.types import BadInput

    folder = args.dataset if args.dataset.is_dir() else args.dataset.parent
    if path.resolve().is_relative_to(folder.resolve()):
        raise BadInput(f"{option} {path}: inside the data set, which is never written to; choose a place outside")


def _write_report(args: argparse.Namespace, check: DataCheck) -> None:
    from pysim.cli._outputs import command_line
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
    words = ["data", "check", str(args.dataset), *(w for text in args.input for w in ("--input", text))]
    words += [*(w for text in args.response for w in ("--response", text)), "--output", str(args.output)]
    text = data_check_page(check, pictures=pictures, redo=command_line(words))
    write_file(args.output / "report.html", text)
    print(f"Report: {args.output / 'report.html'}")
