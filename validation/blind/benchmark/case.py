"""A few cases of the blind benchmark answered again and compared with what is stored; the targets on all of them."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence

from validation.blind.benchmark.__main__ import TABLE_SEED
from validation.blind.benchmark.answer import Answer
from validation.blind.benchmark.examine import examine
from validation.blind.benchmark.figures import figures
from validation.blind.benchmark.kept import Kept, read_kept
from validation.blind.plant import Case, cases
from validation.drawn import drawn, of_the_day
from validation.findings import Finding

SAMPLE = 6
LEAST = {"none": 300, "named": 300}
"""Cases of a kind that have to be answered for the shares to be believed."""
# Two computers differ in the last bits, and step control makes that some 1e-4 of a residual; searches end within half
# a unit of the sum of squares, which moves an error by a few percent of itself.
NEAR = {"held": 0.01, "base": 0.05, "final": 0.15, "footprint": 0.05}


def run(
    seed: int | None = None, task: Callable[[Case], Answer] = examine, kept: Kept | None = None
) -> Iterator[Finding]:
    """The sample, then the targets.

    Args:
        seed: of the sample; the day's number where None, so that every day looks at others.
        task: answers a case.
        kept: what was answered before; what this package holds where None.
    """
    table, kept = cases(TABLE_SEED), kept or read_kept()
    yield from _sampled(table, kept.answers, seed, task)
    yield from targets(table, kept)


def _sampled(
    table: Sequence[Case], answers: Mapping[str, Answer], seed: int | None, task: Callable[[Case], Answer]
) -> Iterator[Finding]:
    known = [case for case in table if case.name in answers and not answers[case.name].trouble]
    seed = of_the_day() if seed is None else seed
    yield Finding(f"stored answers, missing to a sample (seed {seed})", float(max(0, SAMPLE - len(known))), 0, "")
    for case in drawn(known, SAMPLE, seed):
        yield from compared(answers[case.name], task(case))


def compared(stored: Answer, again: Answer) -> Iterator[Finding]:
    """The same words, and numbers near those stored."""
    name = stored.case
    words = [(a.verdict, a.added) for a in (stored, again)]
    claim = f"{name}: {again.verdict or again.trouble}, stored {stored.verdict}; answers that differ"
    yield Finding(claim, float(words[0] != words[1]), 0, "")
    for number, limit in NEAR.items():
        before, now = getattr(stored, number), getattr(again, number)
        if before is not None:
            off = math.nan if now is None else abs(now - before) / max(abs(before), _FLOORS.get(number, 0.0))
            yield Finding(
                f"{name}: {number} {now if now is None else round(now, 4)}, off that stored by", off, limit, "of it"
            )


# Smaller ones are compared with these instead: a footprint of ten is nothing, and so is an error of a tenth of the
# noise. Two computers have answered a case whose error is 0.03 of the noise with errors that are 0.003 of it apart.
_FLOORS = {"base": 0.1, "final": 0.1, "footprint": 10.0}


def targets(table: Sequence[Case], kept: Kept) -> Iterator[Finding]:
    """Every figure with a target as a claim: by how many percent it is beyond."""
    for kind, least in LEAST.items():
        answered = sum(case.kind == kind and case.name in kept.answers for case in table)
        short = float(max(0, least - answered))
        yield Finding(f"cases {kind!r}: {answered} answered, short of {least} by", short, 0, "")
    for figure in figures(table, kept):
        if figure.target is not None:
            low, high = figure.target
            beyond = max(low - figure.percent, figure.percent - high, 0.0) if figure.of else math.nan
            claim = f"{figure.label}: {figure.hits} of {figure.of}, {figure.words}; beyond by"
            yield Finding(claim, beyond, 0, "%")
