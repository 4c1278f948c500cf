"""Fit the friction of a shaft (thesis Eq. 5.38) to logs of its speed and torques."""

from __future__ import annotations

import argparse
import json
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from pysim.identify.friction import FrictionFit


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The words behind `pysim friction`."""
    parser.add_argument("dataset", metavar="DATASET", type=Path, help="folder with a dataset.toml")
    parser.add_argument("--speed", metavar="COLUMN", required=True, help="speed of the shaft")
    parser.add_argument("--supply", metavar="COLUMN", required=True, help="torque or pressure of the supply motor")
    parser.add_argument("--supply-gain", metavar="K", type=float, default=1.0, help="torque over pressure, m3/rad")
    parser.add_argument("--load", metavar="COLUMN", help="torque or pressure of the load motor, against the motion")
    parser.add_argument("--load-gain", metavar="K", type=float, default=1.0, help="torque over pressure, m3/rad")
    parser.add_argument("--inertia", metavar="J", type=float, required=True, help="of motors and shaft, kg.m2")
    parser.add_argument(
        "--pulses", metavar="N", type=_pulses, default=10, help="per revolution; none: a continuous speed (10)"
    )
    parser.add_argument("--cutoff-hz", metavar="HZ", type=float, default=5.0, help="of the zero-phase filter (5)")
    parser.add_argument("--json", metavar="FILE", type=Path, help="write all numbers here")
    parser.add_argument("-o", "--output", metavar="DIR", type=Path, help="write report.html and the plots here")


def _pulses(text: str) -> int | None:
    """Pulses per revolution, or None."""
    if text == "none":
        return None
    if not text.isdecimal() or int(text) < 1:
        raise argparse.ArgumentTypeError(f"{text!r} is no number of pulses; write one above 0, or none")
    return int(text)


def run(args: argparse.Namespace) -> int:
    """Print the parameters with their intervals; 0 when that is done."""
    from pysim.cli._outputs import JSON, prepare_file, prepare_folder
    from pysim.io import write_file
    from pysim.report import friction_data, friction_text

    if args.output:
        prepare_folder(args.output, read=[args.dataset])
    if args.json:
        prepare_file(args.json, "--json", JSON, read=[args.dataset])
    fit, thesis = _fits(args)
    print(friction_text(fit))
    if args.json:
        data = friction_data(fit) | {"by_filter": None if thesis is None else friction_data(thesis)}
        write_file(args.json, json.dumps(data, indent=1, allow_nan=False))
    if args.output:
        _write_report(args, fit, thesis)
    return 0


def _fits(args: argparse.Namespace) -> tuple[FrictionFit, FrictionFit | None]:
    """By pulses, with the thesis' way beside it where the log allows it; or by filter alone."""
    import math

    from pysim.cli._measurements import read_measurements
    from pysim.identify.friction import ShaftColumns, filtered_samples, fit_friction, pulse_samples, shaft_tests
    from pysim.types import BadInput

    if not (math.isfinite(args.inertia) and args.inertia >= 0):
        raise BadInput(f"--inertia {args.inertia}: write the moment of inertia in kg.m2, 0 or above")
    columns = ShaftColumns(args.speed, args.supply, args.load, args.supply_gain, args.load_gain)
    tests = shaft_tests(read_measurements(args.dataset), columns)
    if args.pulses is None:
        return fit_friction([filtered_samples(t, args.inertia, cutoff_hz=args.cutoff_hz) for t in tests]), None
    fit = fit_friction([pulse_samples(test, args.inertia, pulses=args.pulses) for test in tests])
    try:
        filtered = [filtered_samples(test, args.inertia, cutoff_hz=args.cutoff_hz) for test in tests]
    except BadInput:  # an uneven log does without the comparison
        return fit, None
    return fit, fit_friction(filtered, weighted=False)


def _write_report(args: argparse.Namespace, fit: FrictionFit, thesis: FrictionFit | None) -> None:
    from pysim.cli._outputs import repeating
    from pysim.io import write_file
    from pysim.plot import friction_figure, render
    from pysim.report import friction_page

    figure = friction_figure(fit)
    write_file(args.output / "friction.png", render(figure, "png"))
    figure.set_layout_engine("none")
    caption = "Friction torque over speed, all speeds and those near standstill; grey: speeds that no sample has."
    load = f" and {args.load}" if args.load else ""
    about = f"{args.dataset}: {args.speed} against {args.supply}{load}, inertia {args.inertia:g} kg.m2."
    text = friction_page(
        fit,
        thesis,
        about=about,
        pictures={caption: render(figure, "svg")},
        redo=repeating(args),
    )
    write_file(args.output / "report.html", text)
    print(f"Report: {args.output / 'report.html'}")
