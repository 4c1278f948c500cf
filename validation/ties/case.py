"""Ties that the diagnosis gave, each settled by its proposed test on the virtual plant.

`python -m validation.ties.case [COUNT]` answers the first of them and shows every share.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator, Sequence

from validation.batch import Line, answered, file_of
from validation.findings import Finding
from validation.shares import Share, claims
from validation.ties.answer import COUNT, names

_LIMIT = 600  # s for one plant
_TOGETHER = 10
_LEAST = 10  # ties


def run() -> Iterator[Finding]:
    """At least ten ties, and eight of ten settled."""
    lines = answer_ties()
    ties = sum(bool(line.get("tie")) for line in lines)
    yield Finding(f"ties among {len(lines)} plants: {ties}; missing to {_LEAST}", max(0, _LEAST - ties), 0, "")
    yield from claims(shares(lines))


def answer_ties(count: int = COUNT, workers: int | None = None) -> list[Line]:
    """Lines of the first plants; a run that was stopped goes on."""
    module = "validation.ties.answer"
    chosen, file = names(count), file_of("ties")
    return answered(module, chosen, file, workers=workers, limit=_LIMIT, together=_TOGETHER, say=_said)


def shares(lines: Sequence[Line]) -> Iterator[Share]:
    """Of ties that came with a test, and of those without."""
    ties = [line for line in lines if line.get("tie")]
    asked = [line for line in ties if line["test"]]
    yield Share("ties settled for the right effect by their test", _count(asked, "settled"), len(asked), (80, 100))
    yield Share("right effect named first once the test was run", _count(asked, "right"), len(asked))
    yield Share("ties that came without a test", len(ties) - len(asked), len(ties))
    yield Share("plants without an answer", _count(lines, "trouble"), len(lines), (0, 0))


def _count(lines: Sequence[Line], key: str) -> int:
    return sum(bool(line.get(key)) for line in lines)


def _said(line: Line) -> str:
    if "trouble" in line:
        return f"{line['case']}: {line['trouble']}"
    if not line["tie"]:
        return f"{line['case']}: {', '.join(line['named']) or 'nothing'}, no tie; {line['cpu']:.1f} CPU s"
    if not line["test"]:
        return f"{line['case']}: {line['tie']}, no test; {line['cpu']:.1f} CPU s"
    end = "settled" if line["settled"] else f"NOT settled: {', '.join(line['after'])}; tied {line['tied'] or '-'}"
    return f"{line['case']}: {line['tie']}; {line['test']} {end}; {line['cpu']:.1f} CPU s"


if __name__ == "__main__":
    for share in shares(answer_ties(int(sys.argv[1]) if len(sys.argv) > 1 else COUNT)):
        print(share)
