"""Run a model and write what it did as .csv or .npz."""

from __future__ import annotations

import argparse
import json
import sys
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from pysim.types import Experiment, Model, Record

_STOP = 1.0  # s, where neither the command line nor the FMU says it
_ROWS = 500  # rows of a run, where the command line does not say it
_MOST_ROWS = 10_000_000  # of a run; more is a slip of the keyboard, and would fill the memory


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The words behind `pysim simulate`."""
    from pysim.cli._any_model import WHAT, add_library
    from pysim.cli._inputs import add_inputs
    from pysim.cli.options import add_names, add_parameters

    parser.add_argument("model", metavar="MODEL", help=WHAT)
    add_library(parser)
    parser.add_argument("--stop", metavar="SECONDS", type=float, help="end of the run (the FMU's own, else 1)")
    parser.add_argument("--step", metavar="SECONDS", type=float, help="time between rows (a 500th of the run)")
    add_names(parser, "--record", what="variables (all outputs)")
    add_inputs(parser)
    add_parameters(parser)
    parser.add_argument(
        "--solver", choices=("rodas", "rk45"), default="rodas", help="for stiff models or for others (rodas)"
    )
    parser.add_argument(
        "-o", "--output", metavar="FILE", type=Path, help=".csv or .npz to write; else csv to standard output"
    )
    parser.add_argument("--json", metavar="FILE", type=Path, help="write record and statistics here")


def run(args: argparse.Namespace) -> int:
    """Simulate; 1 when the run stops early, with what was reached written all the same."""
    from pysim.cli._any_model import read_fmu_or_class
    from pysim.cli._inputs import input_files
    from pysim.cli.outputs import JSON, prepare_file
    from pysim.cli.progress import simulating
    from pysim.simulate import Rk45, Rodas, simulate
    from pysim.types import Outcome

    model = read_fmu_or_class(args.model, args.library)
    experiment = _experiment(args, model)
    if args.output:
        prepare_file(args.output, "--output", (".csv", ".npz"), read=input_files(args))
    if args.json:
        prepare_file(args.json, "--json", JSON)
    with simulating():
        record = simulate(model, experiment, solver=Rodas() if args.solver == "rodas" else Rk45(), check=False)
    _write(args, record)
    if record.outcome is not Outcome.DONE:
        print(f"pysim simulate: {model.name} stopped early: {record.message}", file=sys.stderr)
        return 1
    return 0


def _experiment(args: argparse.Namespace, model: Model) -> Experiment:
    import numpy as np

    from pysim.cli._inputs import read_inputs
    from pysim.cli.options import names_of, read_parameters
    from pysim.types import BadInput, Experiment

    stop = model.stop_time or _STOP if args.stop is None else args.stop
    step = stop / _ROWS if args.step is None else args.step
    if not (0 < step <= stop < float("inf")):
        raise BadInput(f"--stop {stop:g} --step {step:g}: the step must be positive and not beyond the stop")
    if stop / step > _MOST_ROWS:
        raise BadInput(
            f"--stop {stop:g} --step {step:g}: {stop / step:.3g} rows are more than {_MOST_ROWS:,}; widen the step"
        )
    times = np.append(np.arange(0.0, stop - step / 2, step), stop)
    inputs = read_inputs(args, model)
    recorded = _recorded(model, names_of(args.record))
    return Experiment(times, recorded, inputs, read_parameters(args, model), rates=model.rate_inputs(inputs))


def _recorded(model: Model, names: list[str]) -> tuple[str, ...]:
    """The variables asked for, else every output, else every state."""
    outputs = tuple(variable.name for variable in model.variables if variable.causality == "output")
    return tuple(names) or outputs or model.abilities.states


def _write(args: argparse.Namespace, record: Record) -> None:
    from pysim.io import record_data, record_text, write_file, write_record

    if args.json:
        write_file(args.json, json.dumps(record_data(record), indent=1, allow_nan=False))
    if args.output:
        write_record(record, args.output)
    else:
        sys.stdout.write(record_text(record))
