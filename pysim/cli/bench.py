"""Drive a model through a test plan and write the data set a bench would."""

from __future__ import annotations

import argparse
import json
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from pysim.bench import Plan
    from pysim.types import Dataset


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The words behind `pysim bench`."""
    from pysim.cli._any_model import WHAT, add_library
    from pysim.cli.options import add_parameters

    parser.add_argument("model", metavar="MODEL", help=WHAT)
    add_library(parser)
    parser.add_argument(
        "--plan", metavar="PLAN", required=True, help="a .toml, or a plan of this program: bench-01, thesis"
    )
    parser.add_argument("-o", "--output", metavar="FOLDER", type=Path, required=True, help="the data set; a new folder")
    parser.add_argument(
        "--seed", metavar="N", type=int, required=True, help="of the noise; the same seed, the same bytes"
    )
    parser.add_argument(
        "--truth", metavar="FILE.json", type=Path, help="write parameters and effect here, outside FOLDER"
    )
    parser.add_argument(
        "--clean", metavar="FOLDER2", type=Path, help="write the noise-free signals here, outside FOLDER"
    )
    add_parameters(parser)
    parser.add_argument(
        "--effect", metavar="NAME", default="none", help="for the truth: what the model has more (none)"
    )
    parser.add_argument(
        "--strength", metavar="NAME=VALUE", action="append", default=[], help="for the truth: how strong that is"
    )


def run(args: argparse.Namespace) -> int:
    """Write the data set; 1 when a run stops early, with nothing written."""
    from pysim.bench import read_plan, run_plan, truth_data
    from pysim.cli._any_model import read_fmu_or_class
    from pysim.cli.options import assigned, read_parameters
    from pysim.cli.outputs import prepare_file, prepare_folder
    from pysim.cli.progress import ProgressBar, announce_compilation
    from pysim.io import write_dataset, write_file

    plan, model = read_plan(args.plan), read_fmu_or_class(args.model, args.library)
    parameters, strength = read_parameters(args, model), assigned(args.strength, "--strength", "SI units")
    _check_places(args)
    for option, folder in (("--output", args.output), ("--clean", args.clean)):
        if folder is not None:
            prepare_folder(folder.parent, option)
    if args.truth:
        prepare_file(args.truth, "--truth", (".json",))
    announce_compilation()
    with ProgressBar("tests") as progress:
        data = run_plan(
            model, plan, args.seed, parameters=parameters, effect=args.effect, strength=strength, progress=progress
        )
    units = {name: unit for name, (unit, _) in plan.units.items()}
    write_dataset(args.output, data.dataset, units=units)
    if args.truth:
        write_file(args.truth, json.dumps(truth_data(data.truth), indent=1, allow_nan=False) + "\n")
    if args.clean:
        write_dataset(args.clean, data.truth.clean, units=units)
    print(_summary(args, plan, data.dataset))
    return 0


def _check_places(args: argparse.Namespace) -> None:
    """A new folder for the data set, and nothing of the truth within it."""
    from pysim.types import BadInput

    output = args.output.resolve()
    for option, path in (("--output", args.output), ("--clean", args.clean)):
        if path is not None and path.exists() and (not path.is_dir() or any(path.iterdir())):
            raise BadInput(f"{option} {path}: something is there already; choose a new folder")
    for option, path in (("--truth", args.truth), ("--clean", args.clean)):
        if path is not None and path.resolve().is_relative_to(output):
            raise BadInput(
                f"{option} {path}: inside the data set, whoever reads that would see it; choose a place outside"
            )
    if args.truth and args.clean and args.truth.resolve().is_relative_to(args.clean.resolve()):
        raise BadInput(
            f"--truth {args.truth}: inside the folder of --clean, which must be new; choose a place beside it"
        )
    if args.clean is not None and output.is_relative_to(args.clean.resolve()):
        raise BadInput(f"--clean {args.clean}: the data set would be inside it; choose a folder beside it")


def _summary(args: argparse.Namespace, plan: Plan, dataset: Dataset) -> str:
    from pysim.types import Record

    rows = sum(record.data.time.size for record in dataset.records if isinstance(record.data, Record))
    told = f"; truth in {args.truth}" if args.truth else ""
    return f"{plan.name}: {len(dataset.records)} logs, {rows} rows in {args.output}{told}"
