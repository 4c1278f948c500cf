"""Every data set of a folder: the right names in order, and an error on the withheld log that no step makes larger."""

from __future__ import annotations

import math
import os
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path

from validation.findings import Finding
from validation.mismatch.answer import Answer, answer
from validation.mismatch.judge import RISE, judged
from validation.mismatch.tasks import Task, read_task

ENVIRONMENT = "MISMATCH_MEASUREMENTS"
"""Names the folder that holds the data sets; they are not part of this distribution."""
MISMATCH = tuple(f"mismatch-{k:02d}" for k in range(1, 13))
BENCH = tuple(f"bench-{k:02d}" for k in range(1, 17))
SETS = (*((name, True) for name in (*MISMATCH, *BENCH)), *((name, False) for name in BENCH))


def run(
    sets: Sequence[tuple[str, bool]] = SETS,
    ask: Callable[[Task], Answer] = answer,
) -> Iterator[Finding]:
    """Set by set.

    Args:
        sets: names, and whether the diagnosis is given the noise that the set specifies.
        ask: a diagnosis.
    """
    folder = Path(os.environ.get(ENVIRONMENT, ""))
    for name, specified in sets:
        what = name if specified else f"{name} without its noise"
        if folder == Path() or not (folder / name).is_dir():
            skipped = f"no such data set in the environment's {ENVIRONMENT}"
            yield Finding(f"{what}: right names", math.nan, 0, "", skipped=skipped)
            continue
        task = read_task(folder, name, specified=specified)
        found = judged(task, ask(task))
        named = ", ".join(found.answer.effects) or "nothing"
        if found.wrong is not None:
            claim = f"{what}: named {named}; wrong: {'; '.join(found.wrong) or 'nothing'}"
            yield Finding(claim, float(len(found.wrong)), 0, "")
        steps = " -> ".join(f"{error:.4g}" for error in found.errors)
        yield Finding(f"{what}: error on the log withheld {steps}; largest rise", found.rise, RISE, "times")
