"""Answer cases of the blind benchmark by this commit, one by one, and show the figures of these cases."""

from __future__ import annotations

import argparse
import sys

from fmu_build.version import this_commit
from pysim.types import BadInput
from validation.blind.benchmark.case import SEED, answer_cases, choose
from validation.blind.benchmark.figures import KINDS, page
from validation.blind.plant import cases

parser = argparse.ArgumentParser(prog="python -m validation.blind.benchmark", description=__doc__)
parser.add_argument("cases", metavar="SEED/NAME", nargs="*", help="these cases, in this order (those that follow)")
parser.add_argument("--seeds", metavar="S", type=int, nargs="+", default=[SEED], help=f"of the tables ({SEED})")
parser.add_argument("--kinds", nargs="+", choices=KINDS, default=KINDS, help="of cases (all)")
parser.add_argument("--names", metavar="PATTERN", default="*", help="of cases, with * and ? (all)")
parser.add_argument("--count", metavar="N", type=int, help="of each seed the first N, of all kinds mixed (all)")
parser.add_argument("--few", action="store_true", help="give waves, chirp and only eight of the 65 sines")
parser.add_argument("--workers", metavar="N", type=int, help="processes, of one thread each (one for each core)")
args = parser.parse_args()
chosen = args.cases or [
    name
    for seed in args.seeds
    for name in choose(
        cases(seed), f"{seed}-few" if args.few else seed, kinds=args.kinds, names=args.names, count=args.count
    )
]
try:
    found = answer_cases(chosen, args.workers)
except BadInput as error:
    sys.exit(f"benchmark: {error}")
print("\n".join(page(found, f"Blind benchmark by commit {this_commit()}")))
