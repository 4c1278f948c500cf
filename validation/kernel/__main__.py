"""`python -m validation.kernel [NAME ...]`: the table, a line per model; what is stored is not made again."""

from __future__ import annotations

import argparse
from collections.abc import Sequence

from validation.kernel.case import HEAD, findings, result, row, subjects

_WIDTHS = (36, 9, 9, 9, 9, 9, 9, 5, 6, 8, 34, 0)


def main(argv: Sequence[str] | None = None) -> int:
    """0 where every claim holds, 1 where one does not."""
    parser = argparse.ArgumentParser(prog="python -m validation.kernel", description=__doc__)
    parser.add_argument("names", metavar="NAME", nargs="*", help="part of a model's name; all models by default")
    names = parser.parse_args(argv).names
    bad = 0
    print(_line(HEAD))
    for subject in subjects():
        if names and not any(name in subject.name for name in names):
            continue
        found = result(subject)
        print(f"{subject.name:36} skipped: {found}" if isinstance(found, str) else _line(row(found)), flush=True)
        for finding in findings(subject):
            if not finding.skipped and not finding.holds:
                bad += 1
                print(f"    {finding}", flush=True)
    return 1 if bad else 0


def _line(cells: Sequence[str]) -> str:
    return " ".join(f"{cell:{width}}" for cell, width in zip(cells, _WIDTHS, strict=True))


if __name__ == "__main__":
    raise SystemExit(main())
