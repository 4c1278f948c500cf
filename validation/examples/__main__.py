"""`python -m validation.examples store [NAME ...]` makes stored results, `... list` names the examples."""

from __future__ import annotations

import argparse
import sys
import time
from collections.abc import Sequence

from validation.examples.catalogue import examples
from validation.examples.stored import store


def main(argv: Sequence[str] | None = None) -> int:
    """Exit code: 0 done, 1 an example could not be stored, 2 wrong use."""
    parser = argparse.ArgumentParser(prog="python -m validation.examples", description=__doc__)
    parser.add_argument("what", choices=("store", "list"))
    parser.add_argument(
        "names", metavar="NAME", nargs="*", help="examples, all by default, such as Examples.SteadyFlow"
    )
    args = parser.parse_args(argv)
    known = {example.short: example for example in examples()}
    unknown = [name for name in args.names if name not in known]
    if unknown:
        print(f"no example named {', '.join(unknown)}; there are {', '.join(known)}", file=sys.stderr)
        return 2
    failed = False
    for name in args.names or known:
        if args.what == "list":
            print(name)
            continue
        started = time.process_time()
        try:
            store(known[name])
        except LookupError as missing:
            print(f"{name}: left as it is: {missing}", flush=True)
            continue
        except Exception as error:
            failed = True
            print(f"{name}: {type(error).__name__}: {error}", file=sys.stderr, flush=True)
            continue
        size = known[name].file.stat().st_size
        print(f"{name}: {size / 1e3:.0f} kB in {time.process_time() - started:.1f} s", flush=True)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
