"""`pysim validate`."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING

from pysim.cli.command import DONE, NO, Command, Given
from pysim.cli.option import Option, switch

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from matplotlib.figure import Figure

    from pysim.cli.progress import ProgressBar
    from validation.findings import Finding
    from validation.results import CaseResult


def run(given: Given) -> int:
    """NO when one claim fails of those that could be tried."""
    from pysim.cli.outputs import prepare_file, prepare_folder
    from validation.registry import CASES
    from validation.results import FAILS, append_results
    from validation.suite import chosen, run_cases

    names = chosen(given.names, quick=given.quick)
    if given.list:
        for name in names:
            print(f"{name:<18} {'quick' if CASES[name].quick else '':<5}  {CASES[name].about}")
        return DONE
    if given.output:
        prepare_folder(given.output)
    if given.json:
        numbers = prepare_file(given.json, "--json", (".json", ".jsonl"))
        if numbers.is_file():  # not a device, such as /dev/null
            numbers.unlink()
    checkout = _checkout() if given.record else None
    show = _Show(len(names))
    results = []
    for result in run_cases(names, show):
        show.finished(result)
        results.append(result)
        if given.json:
            append_results(given.json, [result])
    if given.output:
        _write_page(given.output, results)
    if checkout:
        _record(checkout, results)
    return NO if any(result.verdict == FAILS for result in results) else DONE


class _Show:
    """What is seen while cases run: findings as they come, and a bar of the cases done."""

    def __init__(self, total: int) -> None:
        from pysim.cli.progress import ProgressBar

        self._bar: ProgressBar = ProgressBar("validate")
        self._done, self._total = 0, total

    def __call__(self, name: str, finding: Finding | None) -> None:
        from pysim.cli.terminal import draws_over
        from validation.registry import CASES

        clear = "\r\033[K" if draws_over(sys.stderr) else ""
        print(clear, end="", file=sys.stderr, flush=True)
        print(f"{name}: {CASES[name].about}" if finding is None else f"  {finding}", flush=True)

    def finished(self, result: CaseResult) -> None:
        """One more case is done."""
        self._done += 1
        end = f"FAILED, {result.error}" if result.error else {"fails": "FAILED"}.get(result.verdict, result.verdict)
        print(f"  {end} in {result.seconds:.1f} s, {result.cpu:.1f} s of CPU", flush=True)
        self._bar(self._done, self._total)


def _write_page(folder: Path, results: Sequence[CaseResult]) -> None:
    from pysim.io import write_file
    from pysim.present.render import render
    from validation.page import suite_page
    from validation.registry import CASES
    from validation.summary import full_summary

    drawn: dict[str, Mapping[str, Figure]] = {}
    for result in results:
        drawn[result.case] = {} if result.error else CASES[result.case].pictures()
        for k, figure in enumerate(drawn[result.case].values(), 1):
            write_file(folder / f"{result.case}-{k}.png", render(figure, "png"))
    write_file(folder / "report.html", suite_page(results, drawn))
    write_file(folder / "summary.md", full_summary(results, kept=False))
    print(f"wrote {folder / 'report.html'}")


def _results_file() -> Path:
    import validation

    return Path(str(validation.__file__)).parent / "recorded.jsonl"


def _checkout() -> Path:
    """The folder with the README.

    Raises:
        BadInput: this is an installed package, without one.
    """
    from pysim.types import BadInput

    root = Path(__file__).resolve().parents[3]
    if not (root / "pyproject.toml").is_file():
        raise BadInput("--record writes into a checkout and this is an installed package; use --output or --json")
    return root


def _record(root: Path, results: Sequence[CaseResult]) -> None:
    from pysim.io import write_file
    from validation.results import keep_results
    from validation.summary import between_markers, full_summary, short_summary

    kept = keep_results(_results_file(), results)
    write_file(root / "validation" / "RESULTS.md", full_summary(kept))
    readme = root / "README.md"
    write_file(readme, between_markers(readme.read_text(encoding="utf-8"), short_summary(kept)))
    print(f"recorded {len(results)} cases in {_results_file()}")


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
        switch("--record", "keep the results in the checkout, and write its summary and README anew"),
    ),
)
