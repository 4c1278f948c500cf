"""Hold a model against measurements and judge it by thesis Tables 1.3 and 1.4; with --refit also refitted."""

from __future__ import annotations

import argparse
import json
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from pysim.types import Comparison, Dataset


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The words behind `pysim compare`."""
    from pysim.cli._any_model import add_data_and_model
    from pysim.cli._subject import add_fitted, add_results
    from pysim.cli.options import add_parameters, add_reference

    add_data_and_model(parser)
    parser.add_argument("--refit", action="store_true", help="refit within the bounds too, and say where it fails")
    add_fitted(parser)
    add_parameters(parser)
    add_reference(parser)
    add_results(parser, ", with --refit parameters.toml")


def run(args: argparse.Namespace) -> int:
    """Print the table; 0 when every test is within the limits, 1 when one is not or could not be simulated.

    Frequency responses are compared by driving the model through the tests they stand for. Logs over time are
    compared sample by sample, in units of their noise.
    """
    from pysim.cli._measurements import read_measurements
    from pysim.cli._subject import prepare_results

    dataset = read_measurements(args.data)
    prepare_results(args)
    if not args.refit:
        _refuse_idle(args)
    if args.refit or args.records or args.story or not dataset.responses():
        return _story(args)
    if dataset.logs():
        print(_beside(dataset))
    return _responses(args, dataset)


def _beside(dataset: Dataset) -> str:
    """What of a data set with tables is not compared."""
    return (
        f"Compared are tables of frequency responses alone ({len(dataset.responses())}), not the logs over time beside "
        f"them ({len(dataset.logs())}): --refit takes the logs, or give them a data set of their own.\n"
    )


def _refuse_idle(args: argparse.Namespace) -> None:
    """Nothing is free where nothing is refitted."""
    from pysim.types import BadInput

    for option in ("free", "bounds"):
        if getattr(args, option):
            raise BadInput(f"--{option}: nothing is refitted without --refit; add that, or leave --{option} out")


def _story(args: argparse.Namespace) -> int:
    """Every record beside the model as it is, and refitted where that is asked for."""
    from pysim.cli._story import finish, unfold
    from pysim.cli._subject import read_subject
    from pysim.cli.progress import announce_compilation
    from pysim.diagnose import against
    from pysim.report.diagnosis import evidence_text
    from pysim.report.diagnosis_words import comparison_sentence

    given = read_subject(args, refits=args.refit)
    announce_compilation()
    found = unfold(
        given,
        args,
        lambda story, journal: against(
            given.subject,
            refitted=args.refit,
            progress=lambda told: None if told.text.startswith("verdict:") else story(told),  # of a diagnosis
            journal=journal,
        ),
    )
    answer = comparison_sentence(found)
    print(answer, evidence_text(found), sep="\n\n")
    finish(found, given, args, question="How far is the model from its measurements?", answer=answer)
    last = found.error[-1]
    return 0 if last.passes and last.criteria else 1


def _responses(args: argparse.Namespace, dataset: Dataset) -> int:
    from pysim.cli._subject import read_base
    from pysim.cli.options import chosen_reference, read_parameters
    from pysim.cli.progress import ProgressBar, announce_compilation
    from pysim.diagnose import compare
    from pysim.io import in_model_units, write_file
    from pysim.report import comparison_data, comparison_text

    args.reference_hz = chosen_reference(args.reference_hz, dataset.responses())
    model = read_base(args)
    overrides = read_parameters(args, model)
    announce_compilation()
    with ProgressBar("stepped sines") as progress:
        comparison = compare(
            model,
            in_model_units(dataset, model),
            overrides=overrides,
            label=Path(args.model).stem if args.model.lower().endswith(".fmu") else args.model,
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
    from pysim.cli._pictures import write_pictures
    from pysim.cli.outputs import answer_folder, repeating, results_beside
    from pysim.io import write_file
    from pysim.report import comparison_page

    with answer_folder(args.output, beside=results_beside(args)) as new:
        pictures = write_pictures([comparison], new)
        text = comparison_page(
            "A model against its measurements", [comparison], pictures=pictures, redo=repeating(args)
        )
        write_file(new / "report.html", text)
    print(f"Report: {args.output / 'report.html'}")
