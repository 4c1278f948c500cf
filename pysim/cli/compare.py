"""Hold an FMU against measured frequency responses and judge it by thesis Table 1.3."""

from __future__ import annotations

import argparse
import json
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from pysim.types import Comparison


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The words behind `pysim compare`."""
    from pysim.cli._options import add_parameters, reference_hz

    parser.add_argument("model", metavar="MODEL.fmu", type=Path)
    parser.add_argument("--data", metavar="FOLDER", type=Path, required=True, help="data set with a dataset.toml")
    add_parameters(parser)
    parser.add_argument(
        "--reference-hz", metavar="HZ", type=reference_hz, default=0.1, help="whose gain is 0 dB; none: absolute (0.1)"
    )
    parser.add_argument("--json", metavar="FILE", type=Path, help="write all numbers here")
    parser.add_argument("--output", metavar="DIR", type=Path, help="write report.html and the plots here")


def run(args: argparse.Namespace) -> int:
    """Print the table; 0 when every test passes, 1 when one does not."""
    from pysim.cli._options import read_parameters
    from pysim.cli._outputs import prepare_file, prepare_folder
    from pysim.cli._progress import ProgressBar, announce_compilation
    from pysim.diagnose import compare
    from pysim.io import read_dataset, read_model, write_file
    from pysim.report import comparison_data, comparison_text

    dataset, model = read_dataset(args.data), read_model(args.model)
    overrides = read_parameters(args, model)
    if args.output:
        prepare_folder(args.output)
    if args.json:
        prepare_file(args.json, "--json")
    announce_compilation()
    with ProgressBar("stepped sines") as progress:
        comparison = compare(
            model,
            dataset,
            overrides=overrides,
            label=args.model.stem,
            reference_hz=args.reference_hz,
            progress=progress,
        )
    print(comparison_text(comparison))
    if args.json:
        write_file(args.json, json.dumps(comparison_data([comparison]), indent=1, allow_nan=False))
    if args.output:
        _write_report(args, comparison)
    return 0 if comparison.passes else 1


def _write_report(args: argparse.Namespace, comparison: Comparison) -> None:
    from pysim.cli._outputs import command_line
    from pysim.cli._pictures import write_pictures
    from pysim.io import write_file
    from pysim.report import comparison_page

    redo = command_line(
        ["compare", str(args.model), "--data", str(args.data), "--output", str(args.output)]
        + ["--reference-hz", "none" if args.reference_hz is None else f"{args.reference_hz:g}"]
        + [word for name, value in comparison.overrides.items() for word in ("--set", f"{name}={value!r}")]
    )
    pictures = write_pictures([comparison], args.output)
    text = comparison_page("A model against its measurements", [comparison], pictures=pictures, redo=redo)
    write_file(args.output / "report.html", text)
    print(f"Report: {args.output / 'report.html'}")
