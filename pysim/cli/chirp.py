"""Responses of tops, bottoms and their mean from chirp logs."""

from __future__ import annotations

import argparse
import json
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from pysim.identify.chirp import ChirpAnalysis
    from pysim.types import Dataset, FrequencyResponse

_UNITS = "%,%"  # of command and response, where none are told


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The words behind `pysim chirp`."""
    parser.add_argument("data", metavar="DATASET|LOG", type=Path, help="folder with a dataset.toml, or a single log")
    parser.add_argument(
        "--columns", metavar="TIME,COMMAND,RESPONSE", help="of a single log, in its order; the first must be time"
    )
    parser.add_argument("--units", metavar="UNIT,UNIT", help="of command and response there (%%,%%)")
    parser.add_argument("--signal", metavar="NAME", help="the responding signal, where the logs hold several")
    parser.add_argument(
        "--level", type=float, help="what tops and bottoms count from, in the response's SI unit (the command's offset)"
    )
    parser.add_argument("--json", metavar="FILE", type=Path, help="write all numbers here")
    parser.add_argument("-o", "--output", metavar="DIR", type=Path, help="write report.html and the plots here")


def run(args: argparse.Namespace) -> int:
    """Print a table per chirp."""
    from pysim.cli.outputs import JSON, prepare_file, prepare_folder
    from pysim.identify.chirp import chirp_responses
    from pysim.io import write_file
    from pysim.report.chirp import chirp_data, chirp_text

    if args.output:
        prepare_folder(args.output, read=[args.data])
    if args.json:
        prepare_file(args.json, "--json", JSON, read=[args.data])
    dataset = _read(args)
    analyses = chirp_responses(dataset, output=args.signal, level=args.level)
    print(chirp_text(analyses))
    if args.json:
        write_file(args.json, json.dumps(chirp_data(analyses, dataset=dataset.name), indent=1, allow_nan=False))
    if args.output:
        _write_report(args, dataset, analyses)
    return 0


def _read(args: argparse.Namespace) -> Dataset:
    from pysim.cli._measurements import read_measurements
    from pysim.io import read_single_log
    from pysim.types import BadInput

    if args.data.is_dir() or args.data.suffix == ".toml":
        for option in ("columns", "units"):
            if getattr(args, option):
                raise BadInput(f"--{option}: {args.data} is a data set, whose dataset.toml says that; leave it out")
        return read_measurements(args.data)
    if not args.columns:
        raise BadInput(
            f"{args.data}: is no data set; for a single log name its columns: --columns time,command,response"
        )
    columns, units = (tuple(word.strip() for word in text.split(",")) for text in (args.columns, args.units or _UNITS))
    return read_single_log(args.data, "chirp", columns, units)


def _stepped(dataset: Dataset, analysis: ChirpAnalysis) -> FrequencyResponse | None:
    """The stepped sines around the chirp's offset with its amplitude, where the data set has some."""
    from pysim.identify import measured_responses
    from pysim.types.record_kind import STEPPED_SINE

    point = (analysis.command.offset, analysis.command.amplitude)
    near = 0.02 * analysis.command.amplitude
    if not any(record.kind == STEPPED_SINE.name for record in dataset.logs()):
        return None
    for one in measured_responses(dataset, output=analysis.output):
        test = one.response.test
        if abs(test.offset - point[0]) < near and abs(test.amplitude - point[1]) < near:
            return one.response
    return None


def _write_report(args: argparse.Namespace, dataset: Dataset, analyses: Sequence[ChirpAnalysis]) -> None:
    from pysim.cli.outputs import repeating
    from pysim.io import write_file
    from pysim.plot import chirp_figure, render
    from pysim.report.chirp import chirp_page

    pictures = {}
    for i, one in enumerate(analyses):
        figure = chirp_figure(one, _stepped(dataset, one))
        name = "chirp" if len(analyses) == 1 else f"chirp_{i + 1}"
        write_file(args.output / f"{name}.png", render(figure, "png"))
        svg = render(figure, "svg")
        write_file(args.output / f"{name}.svg", svg)
        pictures[f"{one.source}: tops, bottoms and their mean with its 95 percent interval."] = svg
    text = chirp_page(analyses, dataset=dataset.name, pictures=pictures, redo=repeating(args))
    write_file(args.output / "report.html", text)
    print(f"Report: {args.output / 'report.html'}")
