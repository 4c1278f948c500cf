"""`pysim validate`."""

from __future__ import annotations

from collections.abc import Sequence
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING

from pysim.cli.command import DONE, NO, Command, Given
from pysim.cli.option import Option, switch

if TYPE_CHECKING:
    from validation.findings import Finding
    from validation.results import CaseResult

_CLONE = Path(__file__).resolve().parents[3]  # where there is one


def run(given: Given) -> int:
    """NO when one claim fails of those that could be tried."""
    _check_clone()
    from pysim.cli.outputs import prepare_file, prepare_folder
    from validation.page import write_page
    from validation.registry import CASES
    from validation.results import FAILS, append_results
    from validation.suite import chosen, run_cases
    from validation.summary import record

    names = chosen(given.names, quick=given.quick)
    if given.list:
        for name in names:
            print(f"{name:<18} {'quick' if CASES[name].quick else '':<5}  {CASES[name].about}")
        return DONE
    if given.output:
        prepare_folder(given.output)
    if given.record:
        _check_commit()
    if given.json:
        numbers = prepare_file(given.json, "--json", (".json", ".jsonl"))
        if numbers.is_file():  # not a device, such as /dev/null
            numbers.unlink()
    results = _recorded(names) if given.record and not given.names else []
    if results:
        print(f"this commit recorded {len(results)} of {len(names)} cases before; name them to run them again")
    names = [name for name in names if name not in {result.case for result in results}]
    show = _Show(len(names))
    for result in run_cases(names, show):
        show.finished(result)
        results.append(result)
        if given.json:
            append_results(given.json, [result])
        if given.record:
            print(f"  recorded in {record(_CLONE, [result])}")
    if given.output:
        write_page(given.output, results)
        print(f"wrote {given.output / 'report.html'}")
    return NO if any(result.verdict == FAILS for result in results) else DONE


class _Show:
    """What is seen while cases run: findings as they come, and how many cases are done."""

    def __init__(self, total: int) -> None:
        self._done, self._total = 0, total

    def __call__(self, name: str, finding: Finding | None) -> None:
        from validation.registry import CASES

        print(f"{name}: {CASES[name].about}" if finding is None else f"  {finding}", flush=True)

    def finished(self, result: CaseResult) -> None:
        """One more case is done."""
        self._done += 1
        end = f"FAILED, {result.error}" if result.error else {"fails": "FAILED"}.get(result.verdict, result.verdict)
        skipped = result.count("skipped")
        end += f" ({skipped} of {len(result.findings)} claims skipped)" if skipped else ""
        took = f"{result.seconds:.1f} s, {result.cpu:.1f} s of CPU"
        print(f"  {end} in {took} ({self._done} of {self._total})", flush=True)


def _check_clone() -> None:
    """Raise BadInput where the cases are not there."""
    from pysim.types import BadInput

    if find_spec("validation") is None:
        raise BadInput(
            "the cases and their data are not installed with the package; clone the project and type "
            "`python3 run.py validate` in its folder"
        )


def _recorded(names: Sequence[str]) -> list[CaseResult]:
    """What this commit recorded of these cases, so that a run that was stopped goes on."""
    from fmu_build.version import this_commit
    from validation.results import read_results

    commit, kept = this_commit(), read_results(_CLONE / "validation" / "recorded.jsonl")
    return [result for result in kept if result.commit == commit and result.case in names]


def _check_commit() -> None:
    """Raise BadInput where a record could not say which code it is of."""
    from fmu_build.version import this_commit
    from pysim.types import BadInput

    commit = this_commit()
    if not commit or commit.endswith("-dirty"):
        what = "the checkout differs from its commit" if commit else "this is no clone of the repository"
        raise BadInput(f"--record: a record carries the commit it is of, and {what}; commit first, then record")


COMMAND = Command(
    "validate",
    "Redo what is claimed and published, case by case.",
    run,
    options=(
        Option(("NAMES",), "cases to run, all by default", "NAME", nargs="*"),
        switch("--quick", "only cases that take seconds, under 2 min of CPU in all"),
        switch("--list", "say which cases there are, and run none"),
        Option(("-o", "--output"), "write report.html, summary.md and pictures here", "DIR", convert=Path),
        Option(("--json",), "write all numbers here, a line of JSON per case", "FILE", convert=Path),
        switch("--record", "keep the results in the checkout; a run of all cases that was stopped goes on"),
    ),
)
