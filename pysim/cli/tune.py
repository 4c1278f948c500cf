"""Gains of a PI controller from a phase margin and a crossover frequency."""

from __future__ import annotations

import argparse
import json
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from pysim.control.tuning import Gains, Plant


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The words behind `pysim tune`."""
    parser.add_argument(
        "plant", choices=["load", "speed", "own"], help="load pressure or speed of the thesis' bench; own: as told"
    )
    parser.add_argument("--numerator", metavar="X,X", help="own: coefficients from the highest power of s down")
    parser.add_argument("--denominator", metavar="X,X", help="own: the same")
    parser.add_argument("--delay", metavar="SECONDS", type=float, default=0.0, help="dead time beside it (0)")
    parser.add_argument("--phase-margin", metavar="DEG", type=float, default=60.0, help="(60)")
    parser.add_argument("--crossover", metavar="HZ", type=float, help="the fastest that keeps the margins by default")
    parser.add_argument("--gain-margin", metavar="DB", type=float, default=6.0, help="without --crossover (6)")
    parser.add_argument("--gains", metavar="K_P,T_I", action="append", default=[], help="of yours, for comparison")
    parser.add_argument("--dt", metavar="SECONDS", type=float, default=1e-3, help="of the sampled controller (0.001)")
    parser.add_argument("--json", metavar="FILE", type=Path, help="write all numbers here")
    parser.add_argument("-o", "--output", metavar="DIR", type=Path, help="write report.html and the plot here")


def run(args: argparse.Namespace) -> int:
    """Print a table; 1 where the loop that was asked for is not stable."""
    from pysim.cli.outputs import JSON, prepare_file, prepare_folder
    from pysim.control.tuning import TABLE_6_1, known_pi
    from pysim.io import write_file
    from pysim.report.tuning import tuning_data, tuning_text
    from pysim.types import BadInput

    if not 0 < args.dt < float("inf"):
        raise BadInput(f"--dt {args.dt:g}: give a positive number of seconds")
    if args.output:
        prepare_folder(args.output)
    if args.json:
        prepare_file(args.json, "--json", JSON)
    plant = _plant(args)
    tuned = _tuned(args, plant)
    loops = {"tuned": tuned}
    for label, (K_p, T_i) in TABLE_6_1.get(args.plant, {}).items():
        loops[f"{label} (Table 6.1)"] = known_pi(plant, K_p, T_i)
    for text in args.gains:
        K_p, T_i = _numbers(text, "--gains", 2)
        loops[text] = known_pi(plant, K_p, T_i)
    print(tuning_text(loops))
    if args.json:
        write_file(args.json, json.dumps(tuning_data(loops), indent=1, allow_nan=False))
    if args.output:
        _write_report(args, loops)
    return 0 if tuned.loop.stable else 1


def _plant(args: argparse.Namespace) -> Plant:
    from pysim.control.tuning import Plant, load_pressure_plant, shaft_speed_plant
    from pysim.types import BadInput

    own = args.plant == "own"
    if own != (args.numerator is not None) or own != (args.denominator is not None):
        raise BadInput("tune own takes --numerator and --denominator, and only it does; give both, or name a plant")
    if own:
        plant = Plant(_numbers(args.numerator, "--numerator"), _numbers(args.denominator, "--denominator"))
    else:
        plant = load_pressure_plant() if args.plant == "load" else shaft_speed_plant()
    return plant.delayed(args.delay)


def _tuned(args: argparse.Namespace, plant: Plant) -> Gains:
    import math

    from pysim.control.tuning import fastest_pi, tune_pi

    phase_margin = math.radians(args.phase_margin)
    if args.crossover is None:
        return fastest_pi(plant, phase_margin=phase_margin, gain_margin=10 ** (args.gain_margin / 20))
    return tune_pi(plant, crossover=2 * math.pi * args.crossover, phase_margin=phase_margin)


def _numbers(text: str, option: str, count: int | None = None) -> tuple[float, ...]:
    from pysim.types import BadInput

    try:
        found = tuple(float(word) for word in text.split(","))
    except ValueError as error:
        raise BadInput(f"{option} {text}: write numbers with commas between them ({error})") from error
    if count is not None and len(found) != count:
        raise BadInput(f"{option} {text}: {len(found)} numbers where {count} are meant; write {count}")
    return found


def _write_report(args: argparse.Namespace, loops: dict[str, Gains]) -> None:
    from pysim.cli.outputs import repeating
    from pysim.io import write_file
    from pysim.plot.tuning import tuning_figure
    from pysim.present.render import render
    from pysim.report.tuning import tuning_page

    figure = tuning_figure(loops, dt=args.dt)
    write_file(args.output / "tuning.png", render(figure, "png"))
    svg = render(figure, "svg")
    write_file(args.output / "tuning.svg", svg)
    caption = "Open loop with its crossovers, closed loop, and the sampled loop after unit steps."
    text = tuning_page(loops, pictures={caption: svg}, redo=repeating(args))
    write_file(args.output / "report.html", text)
    print(f"Report: {args.output / 'report.html'}")
