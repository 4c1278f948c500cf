"""Runs and slopes of every model that runs by itself, and of FMUs of others, against FMPy's CVODE."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import cache

from fmu_build import CannotCompile
from pysim.types import BadInput
from validation.examples.catalogue import REFUSED
from validation.findings import Finding
from validation.kernel.compared import Compared, compared
from validation.kernel.subjects import FOLDER, Subject, foreign, own

TIMES, SLOPES = 10.0, 0.01  # tolerances, or errors of CVODE; of the largest slope of a signal by a parameter
HEAD = ("model", "Rodas", "Esdirk", "CVODE", "tighter", "CVODE", "slopes", "exact", "events", "calls", "signal", "by")


def notes() -> Sequence[str]:
    """The table, a line per subject."""
    rows = (row(found) for found in map(result, subjects()) if isinstance(found, Compared))
    return tuple(" | ".join(cells) for cells in (HEAD, *rows))


def run() -> Iterator[Finding]:
    """Claims about each subject: by the solver of plain runs, by that of runs with slopes, tighter, and the slopes."""
    for subject in subjects():
        yield from findings(subject)
    if not foreign():
        claim = "FMUs of others"
        yield Finding(claim, float("nan"), TIMES, "", skipped=f"no folder with them in the environment's {FOLDER}")


def findings(subject: Subject) -> Iterator[Finding]:
    """Of one subject."""
    found, claim = result(subject), f"{subject.name} to {subject.stop:g} s"
    if isinstance(found, str):
        yield Finding(claim, float("nan"), TIMES, "tolerances", skipped=found)
        return
    errors = (
        ("Rodas", found.rodas, found.cvode),
        ("Esdirk", found.esdirk, found.cvode),
        ("both, tighter", found.tight, found.cvode_tight),
    )
    for name, value, cvode in errors:
        words = f"{claim} by {name} (CVODE at this tolerance: {cvode:.3g}), worst {found.worst}"
        yield Finding(words, value, TIMES * max(1.0, cvode), "tolerances")
    if found.by:
        yield Finding(f"{claim}: slopes by {', '.join(found.by)}", found.slopes, SLOPES, "of the largest")


def subjects() -> tuple[Subject, ...]:
    """Ours, then those of others."""
    return (*own(), *foreign())


@cache
def result(subject: Subject) -> Compared | str:
    """What was found, or why it cannot be tried here."""
    try:
        return compared(subject)
    except LookupError as missing:
        return str(missing)
    except CannotCompile as error:
        if subject.name not in REFUSED:
            raise
        return f"for OpenModelica only: {REFUSED[subject.name]} ({error.message})"
    except BadInput as refused:
        if subject.example is not None:
            raise
        return str(refused)


def row(found: Compared) -> tuple[str, ...]:
    """A line of the table."""
    runs = (found.rodas, found.esdirk, found.cvode, found.tight, found.cvode_tight)
    numbers = (f"{value:.3g}" for value in (*runs, found.slopes))
    counts = ("yes" if found.exact else "no", str(found.events), str(found.derivatives))
    return (found.name, *numbers, *counts, found.worst, ", ".join(found.by))
