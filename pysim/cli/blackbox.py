"""Fit a transfer function to every frequency response of a data set."""

from __future__ import annotations

import argparse
import json
import re
from collections.abc import Sequence
from itertools import count
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from pysim.identify.blackbox import FittedResponse, Structure

_LONGEST = 60  # characters of a label in a file name


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The words behind `pysim blackbox`."""
    parser.add_argument("dataset", metavar="DATASET", type=Path, help="folder with a dataset.toml")
    parser.add_argument(
        "--poles", metavar="N", type=int, required=True, help="how many; with --orders, the most to try"
    )
    parser.add_argument("--zeros", metavar="M", type=int, default=0, help="how many (0)")
    parser.add_argument("--dead-time", metavar="S", type=float, default=0.0, help="known, or the smallest to try (0 s)")
    parser.add_argument("--dead-time-max", metavar="S", type=float, help="estimate a dead time of up to this")
    parser.add_argument("--stable", action="store_true", help="allow stable poles only")
    parser.add_argument(
        "--weights",
        choices=("covariance", "uniform", "relative"),
        default="",
        help="by the noise of each point (where it is known), all alike (elsewhere), or in proportion to the gain",
    )
    parser.add_argument("--orders", choices=("suggest",), help="compare all structures up to --poles, take the best")
    parser.add_argument(
        "--test",
        metavar="O/A",
        type=_test,
        action="append",
        default=[],
        help="only this offset/amplitude, as --test=-25/10; repeat",
    )
    parser.add_argument("--signal", metavar="NAME", help="the responding signal, where the logs hold several")
    parser.add_argument("--json", metavar="FILE", type=Path, help="write all numbers here")
    parser.add_argument("-o", "--output", metavar="DIR", type=Path, help="write report.html and the plots here")


def _test(text: str) -> tuple[float, float]:
    """Offset and amplitude."""
    try:
        offset, amplitude = (float(word) for word in text.split("/"))
    except ValueError:
        raise argparse.ArgumentTypeError(f"{text!r}: write offset/amplitude in the command's unit, as 25/10") from None
    return offset, amplitude


def run(args: argparse.Namespace) -> int:
    """Print every fit; 0 when all searches came to an end, 1 when one gave up."""
    from pysim.cli._measurements import read_measurements
    from pysim.cli.outputs import JSON, prepare_file, prepare_folder
    from pysim.cli.progress import ProgressBar
    from pysim.identify.blackbox import Structure, fit_dataset
    from pysim.io import write_file
    from pysim.report.blackbox import blackbox_data, blackbox_text

    structure = Structure(args.poles, args.zeros, args.dead_time, args.dead_time_max, args.stable)
    _refuse_contradictions(args, structure)
    if args.output:
        prepare_folder(args.output, read=[args.dataset])
    if args.json:
        prepare_file(args.json, "--json", JSON, read=[args.dataset])
    dataset = read_measurements(args.dataset)
    with ProgressBar("responses") as progress:
        fitted = fit_dataset(
            dataset,
            structure,
            weights=args.weights,
            suggest=args.orders == "suggest",
            output=args.signal,
            tests=args.test,
            progress=progress,
        )
    print(blackbox_text(fitted))
    if args.json:
        write_file(args.json, json.dumps(blackbox_data(fitted, dataset=dataset.name), indent=1, allow_nan=False))
    if args.output:
        _write_report(args, dataset.name, fitted)
    return 0 if all(one.fit.converged for one in fitted) else 1


def _refuse_contradictions(args: argparse.Namespace, structure: Structure) -> None:
    from pysim.types import BadInput

    if args.orders and (structure.zeros or structure.dead_time):
        raise BadInput(
            "--orders suggest: --zeros and --dead-time fix what is to be found; leave them out (--dead-time-max allows "
            "a dead time)"
        )
    if args.orders and not structure.poles:
        raise BadInput("--orders suggest: --poles 0 leaves nothing to compare; give the most poles to try")


def _write_report(args: argparse.Namespace, name: str, fitted: Sequence[FittedResponse]) -> None:
    from pysim.cli.outputs import repeating
    from pysim.io import write_file
    from pysim.plot import blackbox_figure, render
    from pysim.report.blackbox import blackbox_page

    pictures: list[bytes] = []
    for one, stem in zip(fitted, _stems([one.label for one in fitted]), strict=True):
        figure = blackbox_figure(one)
        write_file(args.output / f"{stem}.png", render(figure, "png"))
        figure.set_layout_engine("none")  # found by the first drawing
        pictures.append(render(figure, "svg"))
        write_file(args.output / f"{stem}.svg", pictures[-1])
    write_file(args.output / "report.html", blackbox_page(name, fitted, pictures=pictures, redo=repeating(args)))
    print(f"Report: {args.output / 'report.html'}")


def _stems(labels: Sequence[str]) -> list[str]:
    """Names of files on any system, one per label and none twice: a test may have been repeated."""
    from pysim.io import same_file

    stems: dict[str, str] = {}
    for label in labels:
        plain = "blackbox_" + re.sub(r"[^\w+.-]+", "_", label)[:_LONGEST]
        again = (plain if k == 1 else f"{plain}_{k}" for k in count(1))
        stem = next(stem for stem in again if same_file(stem) not in stems)
        stems[same_file(stem)] = stem
    return list(stems.values())
