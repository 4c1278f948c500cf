"""Frequency responses from the stepped-sine logs of a data set."""

from __future__ import annotations

import argparse
import json
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from pysim.identify import MeasuredResponse


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The words behind `pysim frf`."""
    from pysim.cli._options import add_reference

    parser.add_argument("dataset", metavar="DATASET", type=Path, help="folder with a dataset.toml")
    parser.add_argument("--signal", metavar="NAME", help="the responding signal, where the logs hold several")
    add_reference(parser)
    parser.add_argument(
        "--settle", metavar="SECONDS", type=float, default=0.5, help="left out after the sine starts, at least (0.5)"
    )
    parser.add_argument(
        "--settle-periods", metavar="N", type=float, default=1.0, help="the same, in periods of the sine (1)"
    )
    parser.add_argument("--json", metavar="FILE", type=Path, help="write all numbers here")
    parser.add_argument("-o", "--output", metavar="DIR", type=Path, help="write report.html and the plots here")


def run(args: argparse.Namespace) -> int:
    """Print a table per offset and amplitude."""
    from pysim.cli._measurements import read_measurements
    from pysim.cli._options import chosen_reference
    from pysim.cli._outputs import JSON, prepare_file, prepare_folder
    from pysim.identify import Window, measured_responses
    from pysim.io import write_file
    from pysim.report.frf import frf_data, frf_text

    window = Window(args.settle_periods, args.settle)
    if args.output:
        prepare_folder(args.output, read=[args.dataset])
    if args.json:
        prepare_file(args.json, "--json", JSON, read=[args.dataset])
    dataset = read_measurements(args.dataset)
    responses = measured_responses(dataset, output=args.signal, window=window)
    args.reference_hz = chosen_reference(args.reference_hz, (one.response for one in responses))
    print(frf_text(responses, args.reference_hz))
    if args.json:
        data = frf_data(responses, args.reference_hz, dataset=dataset.name)
        write_file(args.json, json.dumps(data, indent=1, allow_nan=False))
    if args.output:
        _write_report(args, dataset.name, responses)
    return 0


def _write_report(args: argparse.Namespace, name: str, responses: Sequence[MeasuredResponse]) -> None:
    from pysim.cli._outputs import repeating
    from pysim.io import write_file
    from pysim.plot import frf_figure, render
    from pysim.report.frf import frf_page

    figure = frf_figure(responses, args.reference_hz)
    write_file(args.output / "frf.png", render(figure, "png"))
    svg = render(figure, "svg")
    write_file(args.output / "frf.svg", svg)
    pictures = {"Magnitude, phase and harmonics; bars: 95 percent intervals; filled: beyond the noise.": svg}
    text = frf_page(responses, args.reference_hz, dataset=name, pictures=pictures, redo=repeating(args))
    write_file(args.output / "report.html", text)
    print(f"Report: {args.output / 'report.html'}")
