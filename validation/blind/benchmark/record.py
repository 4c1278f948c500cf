"""What one commit has answered, as a page of Markdown; the records in this folder's `records` are such pages."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from datetime import UTC, datetime
from pathlib import Path

from pysim.io import write_file
from validation.blind.benchmark import tables
from validation.blind.benchmark.answer import Answer
from validation.blind.benchmark.figures import figures, paired
from validation.blind.plant import Case
from validation.results import this_machine

_RECORDS = Path(__file__).parent / "records"


def write_record(table: Sequence[Case], answers: Mapping[str, Answer], commit: str, seed: int) -> Path:
    """Keep the page as records/commit-seed-n.md, and give its path."""
    path = _RECORDS / f"{commit}-seed-{seed}.md"
    path.parent.mkdir(exist_ok=True)
    write_file(path, "\n".join([*page(table, answers, commit, seed), ""]))
    return path


def page(table: Sequence[Case], answers: Mapping[str, Answer], commit: str, seed: int) -> Iterator[str]:
    """Its lines."""
    pairs, day = paired(table, answers), datetime.now(UTC).date().isoformat()
    yield f"# Blind benchmark by commit {commit}"
    yield ""
    yield f"{len(pairs)} of {len(table)} cases of the table with seed {seed}, {day}, on {this_machine()}."
    for title, rows in (
        ("Figures", tables.figure_table(figures(pairs))),
        ("Effect by size and noise", tables.sizes(pairs)),
        ("What was answered to what", tables.confusion(pairs)),
        ("Intervals", tables.misses(pairs)),
        ("Time with one core", tables.times(pairs)),
    ):
        yield from ("", f"## {title}", "", *rows)
