"""Killed at any moment, work goes on or begins anew, and its result is that of an undisturbed run."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from types import MappingProxyType

from validation.batch import Line, answered, file_of
from validation.findings import Finding

# Kills of each kind of work; the seeds of their moments count from 1
COUNTS: Mapping[str, int] = MappingProxyType({"build": 12, "fit": 13, "diagnosis": 12})


def run() -> Iterator[Finding]:
    """Two claims per kind of work."""
    for name, count in COUNTS.items():
        cases = [f"{name}-{seed}" for seed in range(1, count + 1)]
        lines = answered("validation.kills.one", cases, file_of("kills"), workers=1, together=count, say=_said)
        told = "".join(f"; {line['case']}: {line.get('trouble') or line.get('said')}" for line in lines if _lost(line))
        yield Finding(
            f"{name}: results after {count} kills that differ{told}",
            sum(map(_lost, lines)),
            0.0,
            "runs",
            regression=True,
        )
        half = [line["half"] for line in lines if line.get("half")]
        told = f" ({half[0]})" if half else ""
        yield Finding(f"{name}: files that a kill leaves half written{told}", float(len(half)), 0.0, "files")


def _lost(line: Line) -> float:
    return float(not line.get("same", False))


def _said(line: Line) -> str:
    if "moment" not in line:
        return f"{line['case']}: {line['trouble']}"
    return f"{line['case']}, killed at {line['moment']:.2f} s: {'the same' if line['same'] else 'ANOTHER RESULT'}"
