"""Laws that no catalogue holds: learned at their places, and the error on a wave that nobody was given."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fnmatch import fnmatchcase

from validation.batch import answered, file_of, read_lines
from validation.findings import Finding
from validation.learned.answer import Answer, read_answer
from validation.learned.cases import CASES
from validation.learned.figures import shares
from validation.shares import claims

SAMPLE = ("damping.position-large-1", "valve.notch-large-1", "friction.position-large-1", "cushion.unreached-large-1")
"""Cases that are answered where the whole table was not."""
_BATCH = "learned"
_LIMIT = 1800  # s for one case
_TOGETHER = 15  # so that the plant is compiled for all of them


def run() -> Iterator[Finding]:
    """Answer a sample where this commit has not, then judge all that it has answered."""
    answer_cases(SAMPLE)
    yield from claims(shares([read_answer(line) for line in read_lines(file_of(_BATCH)).values()]))


def answer_cases(patterns: Sequence[str] = ("*",), workers: int | None = None) -> list[Answer]:
    """Of the cases of these names, with * and ?; a run that was stopped goes on."""
    chosen = [case.name for case in CASES if any(fnmatchcase(case.name, pattern) for pattern in patterns)]
    lines = answered(
        "validation.learned.answer",
        chosen,
        file_of(_BATCH),
        workers=workers,
        limit=_LIMIT,
        together=_TOGETHER,
        say=lambda line: str(read_answer(line)),
    )
    return [read_answer(line) for line in lines]
