"""Three hundred complete models: nothing may be named, and nothing said to be missing.

`python -m validation.nulls.case [COUNT]` answers the first of them and shows every share.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator, Sequence

from validation.batch import Line, answered, file_of
from validation.findings import Finding
from validation.nulls.data import CONDITIONS, COUNT, names
from validation.shares import Share, claims

_LIMIT = 1800  # s for one case
_TOGETHER = 10


def run() -> Iterator[Finding]:
    """At most one percent named, and five percent said to be incomplete."""
    yield from claims(shares(answer_nulls()))


def answer_nulls(count: int = COUNT, workers: int | None = None) -> list[Line]:
    """Lines of the first ones; a run that was stopped goes on."""
    module = "validation.nulls.answer"
    chosen, file = names(count), file_of("nulls")
    return answered(module, chosen, file, workers=workers, limit=_LIMIT, together=_TOGETHER, say=_said)


def shares(lines: Sequence[Line]) -> Iterator[Share]:
    """Of all, then of each condition and plant without a target."""
    yield _named("an effect or a sensor error named although nothing is missing", lines, (0, 1))
    yield _incomplete("said to be incomplete although nothing is missing", lines, (0, 5))
    yield Share("cases without an answer", sum("trouble" in line for line in lines), len(lines), (0, 0))
    for part in (*CONDITIONS, "mass", "axis", "bench"):
        own = [line for line in lines if part in line["case"]]
        yield _named(f"{part}: named", own)
        yield _incomplete(f"{part}: said to be incomplete", own)


def _named(label: str, lines: Sequence[Line], target: tuple[float, float] | None = None) -> Share:
    return Share(label, sum(bool(line.get("named") or line.get("learned")) for line in lines), len(lines), target)


def _incomplete(label: str, lines: Sequence[Line], target: tuple[float, float] | None = None) -> Share:
    return Share(label, sum(not line.get("complete", False) for line in lines), len(lines), target)


def _said(line: Line) -> str:
    if "trouble" in line:
        return f"{line['case']}: {line['trouble']}"
    named = ", ".join([*line["named"], *line["learned"]]) or "nothing named"
    said = "complete" if line["complete"] else "more is missing"
    return f"{line['case']}: {named}, {said}; {line['cpu']:.1f} CPU s"


if __name__ == "__main__":
    for share in shares(answer_nulls(int(sys.argv[1]) if len(sys.argv) > 1 else COUNT)):
        print(share)
