"""Whatever a file holds, its reader gives an answer or one sentence."""

from __future__ import annotations

import tempfile
import traceback
from collections.abc import Iterator
from pathlib import Path

from validation.findings import Finding
from validation.readers.kinds import KINDS, REFUSED, Kind
from validation.readers.spoiled import spoiled

COUNT = 10_000  # inputs a reader
SEED = 1  # of the first input; the others count on


def run() -> Iterator[Finding]:
    """For each reader, how many of the inputs end otherwise."""
    for name, kind in KINDS.items():
        right = kind.right()
        taken, wrong = 0, dict[str, int]()
        for seed in range(SEED, SEED + COUNT):
            fault = trouble(kind, spoiled(right, seed))
            taken += fault is None
            if fault:
                wrong.setdefault(fault, seed)
        told = "".join(f"; {fault} (seed {seed})" for fault, seed in list(wrong.items())[:5])
        claim = f"{name}: {COUNT} spoiled inputs, {taken} of them taken, that end in neither an answer nor a sentence"
        yield Finding(claim + told, float(len(wrong)), 0.0, "kinds of faults")


def trouble(kind: Kind, data: bytes) -> str | None:
    """What is wrong with how a reader ends: None where it takes the input, "" where it refuses in a sentence."""
    with tempfile.TemporaryDirectory() as folder:
        try:
            kind.read(data, Path(folder))
        except REFUSED as error:
            return (
                ""
                if str(error).strip() and len(str(error).splitlines()) == 1
                else f"not one sentence: {str(error)[:80]!r}"
            )
        except Exception as error:
            place = traceback.extract_tb(error.__traceback__)[-1]
            return f"{type(error).__name__} in {Path(place.filename).name}, line {place.lineno}"
    return None
