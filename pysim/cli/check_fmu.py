"""Try FMUs as a strict importer would, and name their faults."""

from __future__ import annotations

import argparse
import json
from pathlib import Path


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The words behind `pysim check-fmu`."""
    parser.add_argument("files", metavar="FILE.fmu", type=Path, nargs="+", help="of any tool, FMI 2 or 3")
    parser.add_argument("--strict", action="store_true", help="what is doubtful counts as failing")
    parser.add_argument("--json", metavar="FILE", type=Path, help="write all findings here")
    parser.add_argument("-o", "--output", metavar="DIR", type=Path, help="write report.html here")


def run(args: argparse.Namespace) -> int:
    """Print the findings; 0 when nothing fails, and with --strict nothing is doubtful either; 1 otherwise."""
    from pysim.cli.outputs import JSON, prepare_file, prepare_folder
    from pysim.cli.progress import ProgressBar
    from pysim.fmu_check import DOUBTFUL, check_fmu
    from pysim.io import check_binary, read_model, write_file
    from pysim.present.page import page
    from pysim.report.fmu_check import fmu_check_data, fmu_check_parts, fmu_check_text

    if args.output:
        prepare_folder(args.output)
    if args.json:
        prepare_file(args.json, "--json", JSON)
    reports = []
    for file in args.files:
        model = read_model(file, faulty=True)
        own = model.abilities.stepping
        check_binary(model, own.library if own and not model.abilities.model_exchange else model.abilities.library)
        with ProgressBar(file.stem) as progress:
            reports.append(check_fmu(file, progress=progress))
        print(fmu_check_text(reports[-1]), flush=True)
    if args.json:
        write_file(args.json, json.dumps([fmu_check_data(report) for report in reports], indent=1, allow_nan=False))
    if args.output:
        parts = [part for report in reports for part in fmu_check_parts(report)]
        write_file(args.output / "report.html", page("FMUs under check", "As a strict importer would try them.", parts))
    good = all(report.passes and not (args.strict and report.count(DOUBTFUL)) for report in reports)
    return 0 if good else 1
