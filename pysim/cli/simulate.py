"""Run an FMU and write what it did as a csv file."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from pysim.types import Model, Record


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The words behind `pysim simulate`."""
    from pysim.cli._options import add_parameters

    parser.add_argument("model", metavar="MODEL.fmu", type=Path)
    parser.add_argument("--stop", metavar="SECONDS", type=float, default=1.0, help="end of the run (1)")
    parser.add_argument("--step", metavar="SECONDS", type=float, help="time between rows (a 500th of the run)")
    parser.add_argument("--record", metavar="NAME", action="append", default=[], help="variable; all outputs if none")
    add_parameters(parser)
    parser.add_argument("--output", metavar="FILE.csv", type=Path, help="file to write; standard output if none")


def run(args: argparse.Namespace) -> int:
    """Simulate with the inputs at their start values; 1 when the run stops early."""
    import numpy as np

    from pysim.cli._options import read_parameters
    from pysim.io import read_model
    from pysim.simulate import simulate
    from pysim.types import BadInput, Experiment, Outcome

    model = read_model(args.model)
    step = args.stop / 500 if args.step is None else args.step
    if not (0 < step <= args.stop < float("inf")):
        raise BadInput(f"--stop {args.stop:g} --step {step:g}: the step must be positive and not beyond the stop")
    times = np.append(np.arange(0.0, args.stop - step / 2, step), args.stop)
    experiment = Experiment(times, _recorded(model, args.record), overrides=read_parameters(args, model))
    record = simulate(model, experiment, check=False)
    text = _as_csv(record)
    if args.output:
        args.output.write_text(text, encoding="utf-8")
    else:
        sys.stdout.write(text)
    if record.outcome is not Outcome.DONE:
        print(f"pysim simulate: {model.name} stopped early: {record.message}", file=sys.stderr)
        return 1
    return 0


def _recorded(model: Model, names: list[str]) -> tuple[str, ...]:
    """The variables asked for, else every output, else every state."""
    outputs = tuple(variable.name for variable in model.variables if variable.causality == "output")
    return tuple(names) or outputs or model.abilities.states


def _as_csv(record: Record) -> str:
    head = ",".join(["time [s]", *(f"{name} [{unit}]" for name, unit in zip(record.names, record.units, strict=True))])
    rows = (",".join(repr(float(x)) for x in (t, *row)) for t, row in zip(record.time, record.values, strict=True))
    return "\n".join([head, *rows, ""])
