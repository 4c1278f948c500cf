"""`pysim multisine`."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import replace
from fnmatch import fnmatch
from typing import TYPE_CHECKING

from pysim.cli.command import Command, Given
from pysim.cli.option import choice, number, text
from pysim.cli.options import DATASETS, JSON, OUTPUT, SIGNAL

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from pysim.present.multisine import Approximations
    from pysim.types import MeasuredRecord, Record

_KINDS = ("multisine", "other")


def run(given: Given) -> Approximations:
    """What was found for each test."""
    from pysim.identify.multisine import approximations, local_polynomial_approximation
    from pysim.present.multisine import Approximations, named

    _refuse_idle(given)
    records, columns = _read(given)
    title = f"Best linear approximation of {given.dataset[0].name}"
    if _is_arbitrary(given):
        band = None if given.band is None else (given.band[0], given.band[1])
        found = [(one.origin, local_polynomial_approximation(one, columns, band=band)) for one in records]
        return Approximations(title, tuple(found))
    excited = None if given.lines is None else _harmonics(given.lines)
    how = {"method": given.method, "start": given.start, "count": given.periods, "drop": given.drop}
    return Approximations(title, named(approximations(records, columns, given.period, excited=excited, **how)))


def _is_arbitrary(given: Given) -> bool:
    return given.period is None or given.method == "arbitrary"


def _refuse_idle(given: Given) -> None:
    """Options that the way the logs are taken has no use for."""
    from pysim.types import BadInput

    if given.period is None and given.method not in ("auto", "arbitrary"):
        raise BadInput(f"--method {given.method}: needs the period of the multisine; write --period SECONDS")
    idle = ("start", "periods", "drop", "lines") if _is_arbitrary(given) else ("band",)
    cure = "goes with --period SECONDS and a method for it" if _is_arbitrary(given) else "goes without a period"
    for option in idle:
        if given.typed[option] is not None:
            raise BadInput(f"--{option} {cure}; leave one of them out")
    if given.records != "*" and not _is_dataset(given):
        raise BadInput("--records chooses among the logs of a data set; name the files that are to be taken instead")


def _is_dataset(given: Given) -> bool:
    return len(given.dataset) == 1 and given.dataset[0].suffix.lower() not in (".csv", ".npz")


def _read(given: Given) -> tuple[list[Record], tuple[str, ...]]:
    """Records, each called by its file, and the columns to use."""
    from pysim.identify.columns import the_column
    from pysim.io import read_dataset, read_record
    from pysim.io.prepare import refuse_missing_in
    from pysim.types import BadInput, Record

    if _is_dataset(given):
        dataset = read_dataset(given.dataset[0])
        logs = [log for log in dataset.logs() if fnmatch(log.source, given.records)]
        logs = [log for log in logs if log.kind in _KINDS] if given.records == "*" else logs
        if not logs:
            what = f"no log of kind {' or '.join(_KINDS)}" if given.records == "*" else f"no log called {given.records}"
            raise BadInput(f"{given.dataset[0]}: there is {what}; name the logs to take, --records PATTERN")
        _refuse_forgotten_period(given, logs)
        wanted = (("input", given.input), ("output", given.signal))
        columns = tuple(the_column(dataset, logs[0], role, name) for role, name in wanted)
        for log in logs:
            if isinstance(log.data, Record):
                refuse_missing_in(dataset, log, log.data, columns)
        records = [replace(log.data, origin=log.source) for log in logs if isinstance(log.data, Record)]
    else:
        if not (given.input and given.signal):
            raise BadInput("multisine: records do not tell what is input; write --input NAME --signal NAME")
        columns = (given.input, given.signal)
        records = [replace(read_record(path), origin=str(path)) for path in given.dataset]
    return records, columns if given.reference is None else (*columns, given.reference)


def _refuse_forgotten_period(given: Given, logs: list[MeasuredRecord]) -> None:
    """Between the lines of a multisine there is nothing that a method for any signal could use."""
    from pysim.types import BadInput

    periodic = next((log.source for log in logs if log.kind == "multisine"), None)
    if periodic and given.period is None and given.method == "auto":
        raise BadInput(
            f"{periodic} is a multisine; write its period, --period SECONDS, or --method arbitrary to take it as any "
            "signal"
        )


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


def _methods() -> Iterable[str]:
    from pysim.identify.multisine import METHODS

    return (*METHODS, "arbitrary")


COMMAND = Command(
    "multisine",
    "Find the best linear approximation from multisine logs, with noise, even and odd distortion beside it.",
    run,
    options=(
        replace(DATASETS, about="data set, or records as .csv or .npz", read=None),
        number("--period", "SECONDS", None, "period of the multisine; none for any broadband signal"),
        text("--input", "NAME", "input (the only one)"),
        SIGNAL,
        text("--reference", "NAME", "known command, if the input is measured or in a loop"),
        text("--records", "PATTERN", "only logs of this name, as multisine/*.txt", default="*"),
        number("--start", "SECONDS", None, "first period (found in the command)"),
        number("--periods", "N", None, "number of periods to take of each log (all)", convert=int),
        choice(
            "--method",
            "auto",
            _methods,
            "robust: several realisations; fast: lines left free; smooth: local polynomial over periods; arbitrary: "
            "local polynomial without periods; auto: what the logs allow",
        ),
        number("--drop", "N", None, "periods to leave out instead of estimating the transient", convert=int),
        text("--lines", "LIST", "excited harmonics, as 1,3,7-99:2 (found in the command)"),
        number("--band", "HZ", None, "lowest and highest line, without a period", nargs=2),
        JSON,
        OUTPUT,
    ),
)
