"""Redo what is claimed and published, case by case."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from matplotlib.figure import Figure

    from pysim.cli.progress import ProgressBar
    from validation.findings import Finding
    from validation.results import CaseResult


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The words behind `pysim validate`."""
    parser.add_argument("names", metavar="NAME", nargs="*", help="cases to run, all by default")
    parser.add_argument("--quick", action="store_true", help="only cases that take seconds, under 2 min of CPU in all")
    parser.add_argument("--list", action="store_true", help="say which cases there are, and run none")
    parser.add_argument(
        "-o", "--output", metavar="DIR", type=Path, help="write report.html, summary.md and pictures here"
    )
    parser.add_argument("--json", metavar="FILE", type=Path, help="write all numbers here, a line of JSON per case")
    parser.add_argument(
        "--record", action="store_true", help="keep the results in the checkout, and write its summary and README anew"
    )


def run(args: argparse.Namespace) -> int:
    """0 when every claim that could be tried holds, 1 when one fails."""
    from pysim.cli.outputs import prepare_file, prepare_folder
    from validation.registry import CASES
    from validation.results import FAILS, append_results
    from validation.suite import chosen, run_cases

    names = chosen(args.names, quick=args.quick)
    if args.list:
        for name in names:
            print(f"{name:<18} {'quick' if CASES[name].quick else '':<5}  {CASES[name].about}")
        return 0
    if args.output:
        prepare_folder(args.output)
    if args.json:
        numbers = prepare_file(args.json, "--json", (".json", ".jsonl"))
        if numbers.is_file():  # not a device, such as /dev/null
            numbers.unlink()
    checkout = _checkout() if args.record else None
    show = _Show(len(names))
    results = []
    for result in run_cases(names, show):
        show.finished(result)
        results.append(result)
        if args.json:
            append_results(args.json, [result])
    if args.output:
        _write_page(args.output, results)
    if checkout:
        _record(checkout, results)
    return 1 if any(result.verdict == FAILS for result in results) else 0


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
    from pysim.plot import render
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

    root = Path(__file__).resolve().parents[2]
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
