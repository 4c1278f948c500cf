"""Figures and pictures of the stored answers, written into the README between its marks."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path

from pysim.io import write_file
from pysim.plot import render
from pysim.types import BadInput
from validation.blind.benchmark import tables
from validation.blind.benchmark.figures import figures, paired
from validation.blind.benchmark.kept import Kept
from validation.blind.benchmark.pictures import confusion_picture, naming_picture
from validation.blind.plant import Case

BEGIN, END = "<!-- figures: written by the command report -->", "<!-- end of figures -->"


def write_report(table: Sequence[Case], kept: Kept, folder: Path) -> tuple[Path, ...]:
    """Put the figures between the marks of `folder`/README.md, and the pictures beside it.

    Raises:
        BadInput: a README without the marks.
    """
    readme, answered = folder / "README.md", paired(table, kept.answers)
    text = readme.read_text(encoding="utf-8")
    if text.count(BEGIN) != 1 or text.count(END) != 1:
        raise BadInput(f"{readme}: the marks {BEGIN} and {END} must stand there once each")
    named = [pair for pair in answered if pair[0].kind == "named"]
    pictures = {"naming.png": naming_picture(named), "confusion.png": confusion_picture(answered)}
    for name, picture in pictures.items():
        write_file(folder / name, render(picture, "png"))
    before, after = text.split(BEGIN)[0], text.split(END)[1]
    written = "\n".join(_lines(table, kept))
    write_file(readme, f"{before}{BEGIN}\n{written}\n{END}{after}")
    return readme, *(folder / name for name in pictures)


def _lines(table: Sequence[Case], kept: Kept) -> Iterator[str]:
    answered = paired(table, kept.answers)
    named = [pair for pair in answered if pair[0].kind == "named"]
    yield from tables.provenance(answered, len(table), kept)
    yield ""
    yield from tables.figure_table(figures(table, kept))
    for title, picture, rows in (
        ("Naming over the footprint", "naming.png", tables.impossible(named)),
        ("Effect by size and noise", "", tables.sizes(named)),
        ("What was answered to what", "confusion.png", tables.confusion_table(answered)),
        ("Where effects were located", "", tables.places(paired(table, kept.places))),
        ("Ties and their next tests", "", tables.ties(paired(table, kept.followed))),
        ("Intervals", "", tables.misses(answered)),
        ("Time with one core", "", tables.cost(answered)),
        ("Time with two cores", "", tables.cost(paired(table, kept.clocked))),
    ):
        yield from ("", f"### {title}", "")
        if picture:
            yield from (f"![{title}]({picture})", "")
        yield from rows
