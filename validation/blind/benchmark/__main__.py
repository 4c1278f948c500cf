"""Answer cases of the blind benchmark by this commit, and show the figures."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence


def main(argv: Sequence[str] | None = None) -> int:
    """0 when done, 2 for wrong use."""
    from pysim.types import BadInput
    from validation.blind.benchmark.case import TABLE_SEED
    from validation.blind.benchmark.examine import examine
    from validation.blind.benchmark.record import page, write_record
    from validation.blind.benchmark.runs import KINDS, LIMIT, answer_cases, choose, folder_of
    from validation.blind.plant import cases
    from validation.commit import this_commit

    parser = argparse.ArgumentParser(prog="python -m validation.blind.benchmark", description=__doc__)
    parser.add_argument("--kinds", nargs="+", choices=KINDS, default=KINDS, help="of cases (all)")
    parser.add_argument("--names", metavar="PATTERN", default="*", help="of cases, with * and ? (all)")
    parser.add_argument("--count", metavar="N", type=int, help="only the first N, of all kinds mixed (all)")
    parser.add_argument("--seed", metavar="S", type=int, default=TABLE_SEED, help=f"of the table ({TABLE_SEED})")
    parser.add_argument("--workers", metavar="N", type=int, default=2, help="processes, of one thread each (2)")
    parser.add_argument("--limit", metavar="S", type=float, default=LIMIT, help=f"seconds for one case ({LIMIT:g})")
    parser.add_argument("--record", action="store_true", help="keep the figures in the checkout, by commit")
    try:
        args = parser.parse_args(argv)
    except SystemExit as end:
        return int(end.code or 0)
    table, commit = cases(args.seed), this_commit()
    chosen = choose(table, kinds=args.kinds, names=args.names, count=args.count)
    try:
        answers = answer_cases(
            chosen, examine, folder_of(commit, args.seed), commit, workers=args.workers, limit=args.limit
        )
    except BadInput as error:
        print(f"benchmark: {error}", file=sys.stderr)
        return 2
    print("\n".join(page(table, answers, commit, args.seed)))
    if args.record:
        print(f"wrote {write_record(table, answers, commit, args.seed)}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
