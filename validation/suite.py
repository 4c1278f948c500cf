"""Run cases one after another; what stops one does not stop the next."""

from __future__ import annotations

import difflib
import os
import time
import traceback
from collections.abc import Callable, Iterator, Sequence
from datetime import UTC, datetime

from fmu_build.version import this_commit
from pysim.types import BadInput
from validation.findings import Finding
from validation.registry import CASES
from validation.results import CaseResult, this_machine
from validation.seeds import seeds_drawn


def chosen(names: Sequence[str], *, quick: bool) -> list[str]:
    """The cases to run: those named, or all; the quick ones of them if `quick`.

    Raises:
        BadInput: there is no case of that name.
    """
    unknown = [name for name in names if name not in CASES]
    if unknown:
        near = difflib.get_close_matches(unknown[0], CASES, n=1)
        hint = f"did you mean {near[0]}?" if near else "pysim validate --list names them"
        raise BadInput(f"no case named {unknown[0]}; {hint}")
    return [name for name in names or CASES if CASES[name].quick or not quick]


def run_cases(names: Sequence[str], watch: Callable[[str, Finding | None], None]) -> Iterator[CaseResult]:
    """Run the cases in this order.

    Args:
        watch: told of every case as it starts (no finding), and of each of its findings as it comes.
    """
    for name in names:
        watch(name, None)
        yield _run_case(name, watch)


def _run_case(name: str, watch: Callable[[str, Finding | None], None]) -> CaseResult:
    commit, case, started, before, error = this_commit(), CASES[name], time.monotonic(), _cpu(), ""
    date = datetime.now(UTC).strftime("%Y-%m-%dT%H:%M:%SZ")
    findings: list[Finding] = []
    try:
        with seeds_drawn() as seeds:
            for finding in case.run():
                findings.append(finding)
                watch(name, finding)
    except Exception as stop:  # whatever it is, the page has to say so, and the other cases are still to be run
        traceback.print_exc()
        error = f"{type(stop).__name__}: {stop}".splitlines()[0][:300]
    seconds, cpu = time.monotonic() - started, _cpu() - before
    return CaseResult(
        name, case.about, case.group, date, seconds, cpu, this_machine(), tuple(findings), error, commit, seeds.text
    )


def _cpu() -> float:
    """s used so far, by this process and by those it started that have ended."""
    return sum(os.times()[:4])
