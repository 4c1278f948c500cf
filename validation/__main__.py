"""`python -m validation NAME ...`, `--all` or `--list`."""

from __future__ import annotations

import argparse
import sys
import time
from collections.abc import Sequence

from validation.registry import CASES


def main(argv: Sequence[str] | None = None) -> int:
    """Run cases and print what they find: 0 when every claim holds, 1 when one fails, 2 for wrong use."""
    parser = argparse.ArgumentParser(prog="validation", description="Redo published and independent results.")
    parser.add_argument("names", metavar="NAME", nargs="*", help="cases to run")
    parser.add_argument("--all", action="store_true", help="run every case")
    parser.add_argument("--list", action="store_true", help="say what there is")
    try:
        args = parser.parse_args(argv)
    except SystemExit as end:
        return int(end.code or 0)
    if args.list:
        print("\n".join(f"{name:<16} {case.about}" for name, case in CASES.items()))
        return 0
    names = list(CASES) if args.all else args.names
    unknown = [name for name in names if name not in CASES]
    if unknown or not names:
        wrong = f"no case named {', '.join(unknown)}" if unknown else "name a case, or --all"
        print(f"validation: {wrong}; there are {', '.join(CASES)}", file=sys.stderr)
        return 2
    verdicts = [_run(name) for name in names]  # one that fails does not hide the next
    return 0 if all(verdicts) else 1


def _run(name: str) -> bool:
    """One case; whether all its claims hold."""
    print(f"{name}: {CASES[name].about}", flush=True)
    started, good = time.monotonic(), True
    for finding in CASES[name].run():
        print(f"  {finding}", flush=True)
        good &= finding.holds or bool(finding.skipped)
    print(f"  {'done' if good else 'FAILED'} in {time.monotonic() - started:.1f} s", flush=True)
    return good


if __name__ == "__main__":
    sys.exit(main())
