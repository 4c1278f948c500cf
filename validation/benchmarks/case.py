"""What a fit costs, as ratios of one run: every aim is a claim."""

from __future__ import annotations

from collections.abc import Iterator

from validation.benchmarks.suite import BENCHMARKS, run_one
from validation.findings import Finding


def run() -> Iterator[Finding]:
    """A finding per number that has an aim; the others are printed."""
    for name in BENCHMARKS:
        for found in run_one(name):
            if found.aim is None:
                print(f"{name}: {found.what}: {found.value:.3g} {found.unit}", flush=True)
            else:
                yield Finding(f"{name}: {found.what}", found.value, found.aim, found.unit, found.skipped)
