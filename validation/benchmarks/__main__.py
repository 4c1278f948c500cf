"""`python -m validation.benchmarks [NAME ...] [--pairs N] [--full]`: measure, and print the table with its aims."""

from __future__ import annotations

import argparse
from collections.abc import Sequence

from validation.benchmarks.measurement import Measurement
from validation.benchmarks.suite import BENCHMARKS, PAIRS, run_one


def main(argv: Sequence[str] | None = None) -> int:
    """0 where every aim is met or was not measured, else 1."""
    parser = argparse.ArgumentParser(prog="python -m validation.benchmarks", description=__doc__)
    parser.add_argument("names", metavar="NAME", nargs="*", help=f"all by default: {', '.join(BENCHMARKS)}")
    parser.add_argument("--pairs", type=int, default=PAIRS, help=f"turns of what is timed ({PAIRS})")
    parser.add_argument("--full", action="store_true", help="all rows of ten-million, which takes as long as it takes")
    args = parser.parse_args(argv)
    unknown = [name for name in args.names if name not in BENCHMARKS]
    if unknown:
        parser.error(f"no benchmark named {', '.join(unknown)}; there are {', '.join(BENCHMARKS)}")
    good = True
    print(f"{'':13} {'value':>9} {'aim':>6}")
    for name in args.names or BENCHMARKS:
        for found in run_one(name, pairs=args.pairs, full=args.full and name == "ten-million"):
            print(row(name, found), flush=True)
            good &= bool(found.skipped) or found.aim is None or found.value <= found.aim
    return 0 if good else 1


def row(name: str, found: Measurement) -> str:
    """A line of the table."""
    value = "skipped" if found.skipped else f"{found.value:.3g}"
    aim = "" if found.aim is None else f"{found.aim:g}"
    return f"{name:13} {value:>9} {aim:>6} {found.unit} {found.what}{f' ({found.skipped})' if found.skipped else ''}"


if __name__ == "__main__":
    raise SystemExit(main())
