"""`pysim simulate`."""

from __future__ import annotations

import json
import math
import sys
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from pysim.cli.command import DONE, NO, Command, Given
from pysim.cli.option import Role, choice, names, number, text
from pysim.cli.options import JSON, LIBRARY, MODEL_FIRST, OUTPUT, PARAMETERS, SET, point_in_place, read_parameters

if TYPE_CHECKING:
    from pysim.types import Experiment, Model, Record, Signal

_STOP = 1.0  # s, where neither the command line nor the FMU says it
_OUTPUT = ".csv or .npz to write; else csv to standard output"
_ROWS = 500  # rows of a run, where the command line does not say it
_MOST_ROWS = 10_000_000  # of a run; more is a slip of the keyboard, and would fill the memory


def run(given: Given) -> int:
    """Simulate; NO when the run stops early, with what was reached written all the same."""
    from pysim.cli.outputs import prepare_file
    from pysim.present.progress import simulating
    from pysim.simulate import Rk45, Rodas, simulate
    from pysim.types import Outcome

    model: Model = given.model
    experiment = _experiment(given, model)
    if given.output:
        files = [Path(words.partition("=")[2].strip()) for words in given.input]
        prepare_file(given.output, "--output", read=[path for path in files if path.is_file()])
    with simulating():
        record = simulate(model, experiment, solver=Rodas() if given.solver == "rodas" else Rk45(), check=False)
    _write(given, record)
    if record.outcome is not Outcome.DONE:
        print(f"pysim simulate: {model.name} stopped early: {record.message}", file=sys.stderr)
        return NO
    return DONE


def _experiment(given: Given, model: Model) -> Experiment:
    from pysim.types import BadInput, Experiment, rows_every
    from pysim.workflow import recorded_of

    stop = model.stop_time or _STOP if given.stop is None else given.stop
    step = stop / _ROWS if given.step is None else given.step
    if not (0 < step <= stop < float("inf")):
        raise BadInput(f"--stop {stop:g} --step {step:g}: the step must be positive and not beyond the stop")
    if stop / step > _MOST_ROWS:
        raise BadInput(
            f"--stop {stop:g} --step {step:g}: {stop / step:.3g} rows are more than {_MOST_ROWS:,}; widen the step"
        )
    inputs = _inputs(given, model)
    recorded = recorded_of(model, given.record)
    times, rates = rows_every(step, 0.0, stop), model.rate_inputs(inputs)
    return Experiment(times, recorded, inputs, read_parameters(given, model), rates=rates)


def _write(given: Given, record: Record) -> None:
    from pysim.io import record_data, record_text, write_file, write_record

    if given.json:
        write_file(given.json, json.dumps(record_data(record), indent=1, allow_nan=False))
    if given.output:
        write_record(record, given.output)
    else:
        sys.stdout.write(record_text(record))


def _inputs(given: Given, model: Model) -> dict[str, Signal]:
    """Input -> signal, in the input's unit.

    Raises:
        BadInput: no NAME=, an unknown name, a number that is not finite, or a file that holds no signal.
    """
    from pysim.types import BadInput

    signals = {}
    for words in given.input:
        name, equals, value = (part.strip() for part in words.partition("="))
        if not (name and equals and value):
            raise BadInput(f"--input {words}: write NAME=NUMBER or NAME=FILE.csv")
        if name in signals:
            raise BadInput(f"--input {words}: {name} is driven already; give each input once")
        signals[model[name].name] = _signal(words, value)
    return signals


def _signal(words: str, value: str) -> Signal:
    from pysim.io import read_signal
    from pysim.types import BadInput, Signal

    try:
        number = float(value)
    except ValueError:
        if point_in_place(value) and not Path(value).exists():
            raise BadInput(f"--input {words}: write the number with a point: {value.replace(',', '.')}") from None
        return read_signal(Path(value), f"--input {words}")
    if not math.isfinite(number):
        raise BadInput(f"--input {words}: {value} is not finite; write a number in the input's unit")
    return Signal.constant(number)


INPUT = text(
    "--input",
    "NAME=VALUE",
    "drive an input by a constant or by FILE.csv with columns time (s) and value, straight lines between; repeat",
    repeated=True,
)

COMMAND = Command(
    "simulate",
    "Run a model and write what it did as .csv or .npz.",
    run,
    options=(
        MODEL_FIRST,
        LIBRARY,
        number("--stop", "SECONDS", None, "end of the run (the FMU's own, else 1)"),
        number("--step", "SECONDS", None, "time between rows (a 500th of the run)"),
        names("--record", "variables (all outputs)"),
        INPUT,
        SET,
        PARAMETERS,
        choice("--solver", "rodas", ("rodas", "rk45"), "rodas for stiff models, rk45 for others"),
        replace(OUTPUT, about=_OUTPUT, metavar="FILE", role=Role.FILE, suffixes=(".csv", ".npz")),
        replace(JSON, about="write record and statistics here"),
    ),
)
