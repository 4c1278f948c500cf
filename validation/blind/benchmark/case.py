"""Cases of the blind benchmark answered by this commit, and the targets on all that it has answered."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fnmatch import fnmatchcase
from zlib import crc32

from validation.batch import answered, file_of, read_lines
from validation.blind.benchmark.answer import Answer, read_answer
from validation.blind.benchmark.figures import KINDS, figures
from validation.blind.plant import Case, cases
from validation.findings import Finding
from validation.shares import claims

BATCH = "blind-benchmark"
SEED = 904
SAMPLE = 12
"""Cases that are answered where the whole benchmark was not run; always the same."""
LIMIT = 900  # s for one case: nobody waits longer for an answer


def run() -> Iterator[Finding]:
    """Answer the first cases where this commit has not, then judge all that it has answered."""
    answer_cases(choose(cases(SEED), SEED, count=SAMPLE))
    yield from claims(figures([read_answer(line) for line in read_lines(file_of(BATCH)).values()]))


def answer_cases(names: Sequence[str], workers: int | None = None) -> list[Answer]:
    """Of these cases, "seed/name"."""
    lines = answered(
        "validation.blind.benchmark.answer",
        names,
        file_of(BATCH),
        workers=workers,
        limit=LIMIT,
        say=lambda line: str(read_answer(line)),
    )
    return [read_answer(line) for line in lines]


def choose(
    table: Sequence[Case], seed: int | str, *, kinds: Sequence[str] = KINDS, names: str = "*", count: int | None = None
) -> list[str]:
    """Cases in an order that mixes all kinds by their shares, so that the first of them stand for the whole.

    Args:
        seed: of the table, with "-few" behind it where only a few sines are to be given.
        names: pattern of their names, with * and ?.
        count: the first of them; None takes all.
    """
    place: dict[str, float] = {}
    for kind in kinds:
        own = [case.name for case in table if case.kind == kind and fnmatchcase(case.name, names)]
        own.sort(key=lambda name: crc32(name.encode()))
        place |= {f"{seed}/{name}": (i + 0.5) / len(own) for i, name in enumerate(own)}
    return sorted(place, key=lambda name: place[name])[:count]
