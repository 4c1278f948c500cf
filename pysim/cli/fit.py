"""Fit parameters of a model to data sets, and say how well they are known."""

from __future__ import annotations

import argparse
import json
import sys
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from pysim.identify.greybox import Problem, Profile, Tried
    from pysim.types import Dataset, Fit, Model


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The words behind `pysim fit`."""
    from pysim.cli._any_model import add_data_and_model, add_library
    from pysim.cli.options import add_names, add_parameters, add_reference

    add_data_and_model(parser, several=True)
    add_library(parser)
    add_names(parser, "--free", what="parameters to find, bounds as the model says", required=True)
    add_parameters(parser, "where free ones begin, and what others are set to; --start and --set win")
    parser.add_argument("--tie", metavar="A=[F*]B", action="append", default=[], help="let A follow the free B")
    parser.add_argument("--start", metavar="NAME=VALUE", action="append", default=[], help="where a free one begins")
    parser.add_argument(
        "--bounds", metavar="NAME=LOW:HIGH", action="append", default=[], help="in place of the model's min and max"
    )
    parser.add_argument("--objective", choices=("noise", "time", "frequency", "combined"), default="noise")
    parser.add_argument("--optimiser", choices=("gauss-newton", "interior-point"), help="gauss-newton for noise")
    add_names(parser, "--signal", what="compare only these outputs")
    add_reference(parser)
    parser.add_argument("--starts", metavar="N", type=int, default=0, help="more searches, drawn between the bounds")
    parser.add_argument("--seed", metavar="S", type=int, help="of the draw")
    add_names(parser, "--profile", what="exact intervals")
    parser.add_argument("--isolate", action="store_true", help="worker processes: an FMU may crash")
    parser.add_argument("--json", metavar="FILE", type=Path, help="write all numbers here")
    parser.add_argument(
        "-o", "--output", metavar="DIR", type=Path, help="write report.html, parameters.toml, plots, log here"
    )


def run(args: argparse.Namespace) -> int:
    """Print the estimates; 0 when the search converged, 1 when it did not."""
    from pysim.cli._any_model import read_fmu_or_class
    from pysim.cli._measurements import read_measurements
    from pysim.cli.options import names_of
    from pysim.cli.outputs import JSON, prepare_answer, prepare_file
    from pysim.cli.progress import announce_compilation
    from pysim.identify.greybox import (
        OBJECTIVES,
        Effort,
        GaussNewton,
        InteriorPoint,
        Processes,
        Simulation,
        fit,
        profile,
    )
    from pysim.identify.greybox.checkpoint import STATE
    from pysim.io import in_model_units
    from pysim.report.fit import fit_text

    if args.output:
        read = [Path(args.model), *args.library, *([args.parameters] if args.parameters else [])]
        prepare_answer(args.output, data=args.data, read=read, beside=[args.json])
    if args.json:
        prepare_file(args.json, "--json", JSON, read=args.data)
    model = read_fmu_or_class(args.model, args.library)
    datasets = [in_model_units(read_measurements(folder), model) for folder in args.data]
    problem = _problem(args, model, datasets)
    profiled = names_of(args.profile)
    _refuse_unprofiled(problem, profiled)
    simulation = Simulation(workers=Processes()) if args.isolate else Simulation()
    log = args.output / "log" if args.output else None
    optimiser = {"gauss-newton": GaussNewton(), "interior-point": InteriorPoint(), None: None}[args.optimiser]
    announce_compilation()
    try:
        result = fit(
            problem,
            objective=OBJECTIVES[args.objective],
            optimiser=optimiser,
            simulation=simulation,
            effort=Effort(args.starts, args.seed, log=log, resume=log is not None),
            progress=_say,
        )
    except KeyboardInterrupt:
        cure = "the same command goes on where it was" if log else "with --output DIR a fit can be gone on with"
        raise KeyboardInterrupt(cure) from None
    print(fit_text(result))
    _write_numbers(args, result, [])
    if args.output:
        _write_report(args, result, datasets)
    profiles = []
    for name in profiled:
        profiles.append(profile(problem, result, name, simulation=simulation))
        print(f"Profile of {name}: 95 % from {profiles[-1].interval[0]:.5g} to {profiles[-1].interval[1]:.5g}")
        _write_numbers(args, result, profiles)
    for state in log.glob(f"*/{STATE}") if log else ():  # nothing is left to go on with; the lines stay
        state.unlink()
    return 0 if result.outcome.name == "CONVERGED" else 1


def _say(tried: Tried) -> None:
    print(f"\r{tried.search}: point {tried.tried}, cost {tried.best:.6g}   ", end="", file=sys.stderr, flush=True)


def _refuse_unprofiled(problem: Problem, names: Sequence[str]) -> None:
    """What the search for intervals would refuse, before anything is fitted."""
    from pysim.types import BadInput

    keys = problem.space.keys
    for name in names:
        if name not in keys:
            raise BadInput(f"--profile {name}: not a free parameter; choose of {', '.join(keys)}")
        if len(keys) == 1:
            raise BadInput(f"--profile {name}: it is the only free parameter; its interval needs no profile")


def _write_numbers(args: argparse.Namespace, result: Fit, profiles: Sequence[Profile]) -> None:
    """After the fit and after each profile, which may take as long again."""
    from pysim.io import json_number, write_file
    from pysim.report.fit import fit_data

    if not args.json:
        return
    found = {
        p.name: {
            "interval": [json_number(end) for end in p.interval],
            "points": [[json_number(v) for v in point] for point in p.points.tolist()],
        }
        for p in profiles
    }
    write_file(args.json, json.dumps(fit_data(result) | {"profiles": found}, indent=1, allow_nan=False))


def _problem(args: argparse.Namespace, model: Model, datasets: Sequence[Dataset]) -> Problem:
    from pysim.cli.options import bounded, chosen_reference, names_of
    from pysim.identify.greybox import Measurements, Parameter, Tie, Treatment, problem

    names, bounds = names_of(args.free), bounded(args.bounds)
    ties = [Tie(*_tie(text)) for text in args.tie]
    starts, fixed = _values(args, model, names, [tie.name for tie in ties])
    _refuse_idle([*starts, *bounds], names)
    free = [Parameter(name, starts.get(name), *bounds.get(name, (None, None))) for name in names]
    _refuse_still(datasets)
    outputs = tuple(names_of(args.signal)) or None
    data = [Measurements(one, outputs=outputs) for one in datasets]
    args.reference_hz = chosen_reference(args.reference_hz, (r for one in datasets for r in one.responses()))
    treatment = Treatment(reference_hz=args.reference_hz)
    return problem(model, data, free, fixed=fixed, ties=ties, treatment=treatment)


def _values(
    args: argparse.Namespace, model: Model, free: Sequence[str], tied: Sequence[str]
) -> tuple[dict[str, float], dict[str, float]]:
    """Where free parameters begin and what others are set to: from the file, and from the options that go before it."""
    from pysim.cli.options import assigned, parameters_of, settable

    told = settable(parameters_of(args.parameters), model) if args.parameters else {}
    starts = {name: value for name, value in told.items() if name in free}
    fixed = {name: value for name, value in told.items() if name not in free and name not in tied}
    unit = "the parameter's unit"
    return starts | assigned(args.start, "--start", unit), fixed | assigned(args.set, "--set", unit)


def _refuse_idle(given: Iterable[str], names: Sequence[str]) -> None:
    from pysim.types import BadInput

    for name in given:
        if name not in names:
            raise BadInput(f"{name} has a start or bounds but is not free; add it to --free, or use --set")


def _refuse_still(datasets: Sequence[Dataset]) -> None:
    """Logs in none of which an input moves tell nothing of what moves."""
    from pysim.diagnose.adequacy import shortcomings
    from pysim.types import BadInput

    refusals = []
    for dataset in datasets:
        if any(record.use == "fit" for record in dataset.records):
            try:
                shortcomings(dataset, ())
            except BadInput as error:
                refusals.append(error)
            else:
                return
    if refusals:
        raise refusals[0]


def _tie(text: str) -> tuple[str, str, float]:
    """A=B or A=F*B."""
    from pysim.types import BadInput

    name, _, right = (part.strip() for part in text.partition("="))
    factor, star, of = (part.strip() for part in right.rpartition("*"))
    try:
        number = float(factor) if star else 1.0
    except ValueError:
        number = None
    if not name or not of or number is None:
        raise BadInput(f"--tie {text}: write A=B or A=2.5*B")
    return name, of, number


def _write_report(args: argparse.Namespace, result: Fit, datasets: Sequence[Dataset]) -> None:
    from pysim.cli._fit_pictures import fit_pictures
    from pysim.cli.outputs import PARAMETERS, answer_folder, repeating
    from pysim.io import write_file
    from pysim.report.fit import fit_page

    lines = [f'"{name}" = {value!r}' for name, value in result.values.items() if "@" not in name]
    units = {signal.name: signal.unit for one in datasets for signal in one.signals if signal.role == "input"}
    with answer_folder(args.output, beside=[args.json, args.output / "log"]) as new:
        write_file(new / PARAMETERS, "\n".join([*lines, ""]))
        pictures = fit_pictures(result, datasets, new)
        page = fit_page(result, units=units, pictures=pictures, redo=repeating(args))
        write_file(new / "report.html", page)
    print(f"Report: {args.output / 'report.html'}; for --parameters: {args.output / PARAMETERS}")
