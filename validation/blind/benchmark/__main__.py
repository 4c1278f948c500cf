"""`python -m validation.blind.benchmark run | again | locate | follow | clock | carry | report`."""

from __future__ import annotations

import argparse
import os
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from validation.blind.benchmark.store import Store
    from validation.blind.benchmark.workers import Task

TABLE_SEED = 1


def main(argv: Sequence[str] | None = None) -> int:
    """0 when done, 1 where older answers do not stand, 2 for wrong use."""
    parser = argparse.ArgumentParser(prog="python -m validation.blind.benchmark", description=__doc__)
    commands = parser.add_subparsers(dest="command", required=True)
    _add_run(commands.add_parser("run", help="answer the cases that the store does not hold of this code"))
    _add_run(commands.add_parser("again", help="answer what an older code has answered, and keep that apart"))
    _add_run(commands.add_parser("locate", help="of cases with one effect, only look where it is, and keep that apart"))
    _add_run(commands.add_parser("follow", help="of cases with one effect: where they end in a tie, run the next test"))
    _add_run(commands.add_parser("clock", help="time cases with two cores each, one after the other"))
    _add_carry(commands.add_parser("carry", help="let an older code's answers count where a sample comes out the same"))
    report = commands.add_parser("report", help="write the figures and pictures into README.md")
    report.add_argument("--store", metavar="DIR", type=Path, help="folder of answers; that of this package")
    try:
        args = parser.parse_args(argv)
    except SystemExit as end:
        return int(end.code or 0)
    return {"report": _report, "carry": _carry}.get(args.command, _run)(args)


def _add_run(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--kinds", metavar="KIND,...", default="", help="none, named, beyond, left-out, pair; all")
    parser.add_argument("--names", metavar="PATTERN", default="*", help="of the cases, with * and ?")
    parser.add_argument("--sample", metavar="N", type=int, help="so many of them at random")
    parser.add_argument("--seed", metavar="S", type=int, default=0, help="of the sample (0)")
    parser.add_argument("--shard", metavar="K/N", default="1/1", help="the K-th of N equal parts")
    _add_processes(parser)


def _add_carry(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--of", metavar="COMMAND", choices=("run", "locate", "follow"), default="run", help="run (run)")
    parser.add_argument("--from", dest="older", metavar="CODE", required=True, help="fingerprint of the older code")
    parser.add_argument("--but", metavar="PATTERN", action="append", default=[], help="cases that may change; repeat")
    parser.add_argument("--sample", metavar="N", type=int, default=30, help="cases to answer again (30)")
    parser.add_argument("--seed", metavar="S", type=int, required=True, help="by which they are drawn")
    parser.add_argument("--anew", metavar="DIR", type=Path, help="what the older code answers on this computer")
    _add_processes(parser)


def _add_processes(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--workers", metavar="N", type=int, help="processes of one thread each (2; clock: 1 of 2)")
    parser.add_argument("--limit", metavar="S", type=float, default=900.0, help="seconds for one case (900)")
    parser.add_argument("--store", metavar="DIR", type=Path, help="folder of answers; that of this package")


@dataclass(frozen=True)
class _Work:
    """What a command does with a case, where it keeps that, by which code, and in how many processes."""

    task: Task
    store: Store
    code: str
    workers: int


def _work(command: str, args: argparse.Namespace) -> _Work:
    for name in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS", "NUMBA_NUM_THREADS"):
        os.environ[name] = "1"  # the processes are the parallel part
    from validation.blind.benchmark.clock import CORES, clock_case
    from validation.blind.benchmark.examine import examine
    from validation.blind.benchmark.fingerprint import fingerprint
    from validation.blind.benchmark.follow import follow_case
    from validation.blind.benchmark.place import locate_case
    from validation.blind.benchmark.store import AGAIN, ANSWERS, CLOCKED, FOLLOWED, PLACES, Store

    task, folder = {
        "run": (examine, ANSWERS),
        "again": (examine, AGAIN),
        "locate": (locate_case, PLACES),
        "follow": (follow_case, FOLLOWED),
        "clock": (clock_case, CLOCKED),
    }[command]
    workers = args.workers or (2 // CORES if command == "clock" else 2)
    return _Work(task, Store(args.store or folder), fingerprint(places=command == "locate"), workers)


def _run(args: argparse.Namespace) -> int:
    work = _work(args.command, args)
    from pysim.types import BadInput
    from validation.blind.benchmark.carry import standing
    from validation.blind.benchmark.follow import ties
    from validation.blind.benchmark.kept import read_kept
    from validation.blind.benchmark.runs import Choice, run
    from validation.blind.plant import cases

    kinds = tuple(kind.strip() for kind in args.kinds.split(",") if kind.strip())
    try:
        choice = Choice(kinds, args.names, args.sample, args.seed, _shard(args.shard))
    except BadInput as error:
        print(f"benchmark: {error}", file=sys.stderr)
        return 2
    table = list(cases(TABLE_SEED))
    if args.command in ("locate", "follow"):
        table = [case for case in table if case.kind == "named"]
    if args.command == "again":
        kept = read_kept()
        older = {name for name, answer in kept.answers.items() if answer.code != work.code}
        table = [case for case in table if case.name in older or case.name in kept.before]
    chosen = choice.of(table)
    if args.command == "follow":
        chosen = ties(chosen, read_kept().answers)
    counts = standing(work.store, work.code).counts
    run(chosen, work.store, work.task, work.code, counts=counts, workers=work.workers, limit=args.limit, say=_say)
    return 0


def _carry(args: argparse.Namespace) -> int:
    work = _work(args.of, args)
    from pysim.types import BadInput
    from validation.blind.benchmark.carry import Draw, carry
    from validation.blind.benchmark.store import Store
    from validation.blind.plant import cases

    table, draw = cases(TABLE_SEED), Draw(args.older, args.sample, args.seed, tuple(args.but))
    anew = Store(args.anew) if args.anew else None
    try:
        alike = carry(
            table, work.store, work.task, draw, work.code, anew=anew, workers=work.workers, limit=args.limit, say=_say
        )
    except BadInput as error:
        print(f"benchmark: {error}", file=sys.stderr)
        return 2
    return 0 if alike else 1


def _shard(text: str) -> tuple[int, int]:
    from pysim.types import BadInput

    k, slash, n = text.partition("/")
    if not (slash and k.isdigit() and n.isdigit()):
        raise BadInput(f"--shard {text}: give the part and their number, such as 1/4")
    return int(k), int(n)


def _report(args: argparse.Namespace) -> int:
    from validation.blind.benchmark.kept import read_kept
    from validation.blind.benchmark.report import write_report
    from validation.blind.benchmark.store import ANSWERS, Store
    from validation.blind.plant import cases

    table = cases(TABLE_SEED)
    store = Store(args.store or ANSWERS)
    store.tidy(table)
    for path in write_report(table, read_kept(store), store.folder.parent):
        print(path)
    return 0


def _say(line: str) -> None:
    print(line, flush=True)


if __name__ == "__main__":
    sys.exit(main())
