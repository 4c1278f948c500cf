"""`python -m validation.accuracy`: write TABLE.md and its pictures anew."""

from __future__ import annotations

from pathlib import Path

from pysim.io import write_file
from pysim.present.render import render
from validation.accuracy.case import pictures
from validation.accuracy.judged import table
from validation.accuracy.models import SET, models

FOLDER = Path(__file__).parent


def text() -> str:
    """The table as Markdown."""
    head, *rows = table(models())
    lines = [f"| {' | '.join(row)} |" for row in (head, ["---"] * len(head), *rows)]
    intro = (
        f"# Four models of one pump\n\nWritten by `python -m validation.accuracy` from data set {SET}: the worst "
        "number of each kind over the tests and logs that were fitted, and over those that were held out; in bold what "
        "is beyond its limit (thesis Tables 1.3 and 1.4; one step of the reading for the steady angle).\n\n"
    )
    figures = "\n![Every number beside its limit](criteria.png)\n\n![The held-out wave](wave.png)\n"
    return intro + "\n".join(lines) + "\n" + figures


if __name__ == "__main__":
    write_file(FOLDER / "TABLE.md", text())
    for name, figure in zip(("criteria", "wave"), pictures().values(), strict=True):
        write_file(FOLDER / f"{name}.png", render(figure, "png"))
