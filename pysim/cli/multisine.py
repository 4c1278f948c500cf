"""Find the best linear approximation from multisine logs, with noise, even and odd distortion beside it."""

from __future__ import annotations

import argparse
import json
import re
from collections.abc import Sequence
from fnmatch import fnmatch
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from pysim.types import BestLinearApproximation, Dataset, MeasuredRecord, Record

_METHODS = ("auto", "robust", "fast", "smooth", "arbitrary")
_KINDS = ("multisine", "other")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The words behind `pysim multisine`."""
    parser.add_argument("data", metavar="DATASET", type=Path, help="data set, or records as .csv or .npz", nargs="+")
    parser.add_argument("--period", metavar="SECONDS", type=float, help="of the multisine; none: any broadband signal")
    parser.add_argument("--input", metavar="NAME", help="what excites; the only input by default")
    parser.add_argument("-o", "--output", metavar="DIR", type=Path, help="write report.html and the plots here")
    parser.add_argument("--signal", metavar="NAME", help="the responding signal, where the logs hold several")
    parser.add_argument("--reference", metavar="NAME", help="known command, where the input is measured or in a loop")
    parser.add_argument("--records", metavar="PATTERN", default="*", help="only logs of this name, as multisine/*.txt")
    parser.add_argument("--start", metavar="SECONDS", type=float, help="first period (found in the command)")
    parser.add_argument("--periods", metavar="N", type=int, help="how many of each log (all)")
    parser.add_argument(
        "--method",
        choices=_METHODS,
        default="auto",
        help="robust: several realisations; fast: lines left free; smooth: local polynomial over periods; arbitrary: "
        "local polynomial without periods (what the logs allow)",
    )
    parser.add_argument("--drop", metavar="N", type=int, help="leave out periods, in place of estimating the transient")
    parser.add_argument("--lines", metavar="LIST", help="excited harmonics, as 1,3,7-99:2 (found in the command)")
    parser.add_argument("--band", metavar="HZ", type=float, nargs=2, help="lowest and highest line, without a period")
    parser.add_argument("--json", metavar="FILE", type=Path, help="write all numbers here")


def run(args: argparse.Namespace) -> int:
    """Print what was found for each test."""
    from pysim.cli.outputs import JSON, prepare_file, prepare_folder
    from pysim.io import write_file
    from pysim.report.multisine import multisine_data, multisine_text

    _refuse_idle(args)
    records, columns = _read(args)
    if args.output:
        prepare_folder(args.output, read=args.data)
    if args.json:
        prepare_file(args.json, "--json", JSON, read=args.data)
    found = _analyse(args, records, columns)
    print("\n\n".join(multisine_text(name, bla) for name, bla in found))
    if args.json:
        data = [multisine_data(name, bla) for name, bla in found]
        write_file(args.json, json.dumps({"approximations": data}, indent=1, allow_nan=False))
    if args.output:
        _write_report(args, found)
    return 0


def _is_arbitrary(args: argparse.Namespace) -> bool:
    return args.period is None or args.method == "arbitrary"


def _refuse_idle(args: argparse.Namespace) -> None:
    """Options that the way the logs are taken has no use for."""
    from pysim.types import BadInput

    if args.period is None and args.method not in ("auto", "arbitrary"):
        raise BadInput(f"--method {args.method}: needs the period of the multisine; write --period SECONDS")
    idle = ("start", "periods", "drop", "lines") if _is_arbitrary(args) else ("band",)
    cure = "goes with --period SECONDS and a method for it" if _is_arbitrary(args) else "goes without a period"
    for option in idle:
        if getattr(args, option) is not None:
            raise BadInput(f"--{option} {cure}; leave one of them out")
    if args.records != "*" and not _is_dataset(args):
        raise BadInput("--records chooses among the logs of a data set; name the files that are to be taken instead")


def _is_dataset(args: argparse.Namespace) -> bool:
    return len(args.data) == 1 and args.data[0].suffix.lower() not in (".csv", ".npz")


def _read(args: argparse.Namespace) -> tuple[list[Record], tuple[str, ...]]:
    """Records, each called by its file, and the columns to use."""
    from dataclasses import replace

    from pysim.io import read_dataset, read_record
    from pysim.types import BadInput, Record

    if _is_dataset(args):
        dataset = read_dataset(args.data[0])
        logs = [log for log in dataset.logs() if fnmatch(log.source, args.records)]
        logs = [log for log in logs if log.kind in _KINDS] if args.records == "*" else logs
        if not logs:
            what = f"no log of kind {' or '.join(_KINDS)}" if args.records == "*" else f"no log called {args.records}"
            raise BadInput(f"{args.data[0]}: there is {what}; name the logs to take, --records PATTERN")
        _refuse_forgotten_period(args, logs)
        columns = tuple(_column(args, dataset, logs[0], role) for role in ("input", "output"))
        records = [replace(log.data, origin=log.source) for log in logs if isinstance(log.data, Record)]
    else:
        if not (args.input and args.signal):
            raise BadInput("multisine: records do not tell what is input; write --input NAME --signal NAME")
        columns = (args.input, args.signal)
        records = [replace(read_record(path), origin=str(path)) for path in args.data]
    return records, columns if args.reference is None else (*columns, args.reference)


def _refuse_forgotten_period(args: argparse.Namespace, logs: list[MeasuredRecord]) -> None:
    """Between the lines of a multisine there is nothing that a method for any signal could use."""
    from pysim.types import BadInput

    periodic = next((log.source for log in logs if log.kind == "multisine"), None)
    if periodic and args.period is None and args.method == "auto":
        raise BadInput(
            f"{periodic} is a multisine; write its period, --period SECONDS, or --method arbitrary to take it as any "
            "signal"
        )


def _column(args: argparse.Namespace, dataset: Dataset, log: MeasuredRecord, role: str) -> str:
    """The one asked for, or the only one of that role."""
    from pysim.types import BadInput

    option, wanted = ("--input", args.input) if role == "input" else ("--signal", args.signal)
    if wanted:
        return str(wanted)
    names = dataset.columns(log, role)
    if len(names) != 1:
        raise BadInput(f"{log.source}: its {role}s are {', '.join(names) or 'none'}; choose one with {option} NAME")
    return names[0]


def _analyse(
    args: argparse.Namespace, records: list[Record], columns: tuple[str, ...]
) -> list[tuple[str, BestLinearApproximation]]:
    """A result per test with its name, where the records are periodic, else one per record."""
    from pysim.io import shown_value

    if _is_arbitrary(args):
        return [(record.origin, _arbitrary(args, record, columns)) for record in records]
    found: list[tuple[str, BestLinearApproximation]] = []
    for bla in _periodic(args, records, columns):
        test = bla.test
        offset, rms = shown_value(test.offset, test.input_unit, ".4g"), shown_value(test.rms, test.input_unit, ".3g")
        name = f"{test.input} around {offset}, rms {rms}"
        found.append((name if all(name != other for other, _ in found) else f"{name}, {bla.origin}", bla))
    return found


def _periodic(
    args: argparse.Namespace, records: list[Record], columns: tuple[str, ...]
) -> list[BestLinearApproximation]:
    """Realisations of the same test are put together."""
    from pysim.identify import multisine

    methods = {
        "auto": multisine.best_linear_approximation,
        "robust": multisine.robust_approximation,
        "fast": multisine.fast_approximation,
        "smooth": multisine.smooth_approximation,
    }
    cuts = [multisine.periods_of([r], args.period, columns, start=args.start, count=args.periods) for r in records]
    transient = None if args.drop is None else multisine.DropPeriods(args.drop)
    excited = None if args.lines is None else _harmonics(args.lines)
    tests = multisine.grouped_realisations(cuts, excited=excited)
    return [methods[args.method](periods, excited=excited, transient=transient) for periods in tests]


def _harmonics(text: str) -> NDArray[np.intp]:
    """1,3,7-99:2 as numbers; the last of a range counts."""
    import numpy as np

    from pysim.types import BadInput

    found: set[int] = set()
    for part in text.split(","):
        match = re.fullmatch(r"\s*(\d+)(?:-(\d+)(?::([1-9]\d*))?)?\s*", part)
        if match is None:
            raise BadInput(f"--lines {text}: {part!r} is no harmonic; write numbers and ranges, as 1,3,7-99:2")
        first, last, step = match.groups()
        found |= set(range(int(first), int(last or first) + 1, int(step or 1)))
    return np.array(sorted(found), dtype=np.intp)


def _arbitrary(args: argparse.Namespace, record: Record, columns: tuple[str, ...]) -> BestLinearApproximation:
    from pysim.identify.multisine import local_polynomial_approximation

    band = None if args.band is None else (args.band[0], args.band[1])
    return local_polynomial_approximation(record, columns, band=band)


def _write_report(args: argparse.Namespace, found: Sequence[tuple[str, BestLinearApproximation]]) -> None:
    from pysim.cli.outputs import repeating
    from pysim.io import write_file
    from pysim.plot import multisine_figure, render
    from pysim.report.multisine import multisine_page

    pictures = []
    for i, (name, bla) in enumerate(found, start=1):
        figure = multisine_figure([bla], [name])
        write_file(args.output / f"multisine_{i}.png", render(figure, "png"))
        svg = render(figure, "svg")
        write_file(args.output / f"multisine_{i}.svg", svg)
        caption = f"{name}: gain with its 95 percent band, and the levels beside it; points are single lines."
        pictures.append((caption, svg))
    title = f"Best linear approximation of {args.data[0].name}"
    text = multisine_page(title, found, pictures=pictures, redo=repeating(args))
    write_file(args.output / "report.html", text)
    print(f"Report: {args.output / 'report.html'}")
