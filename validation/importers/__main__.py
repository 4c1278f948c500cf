"""`python -m validation.importers`: write COMPATIBILITY.md anew."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from pysim.io import write_file
from validation.importers.case import compatibility, exports, subjects
from validation.importers.try_one import EULER_STEP
from validation.results import this_machine

FILE = Path(__file__).with_name("COMPATIBILITY.md")


def text() -> str:
    """The tables as Markdown."""
    intro = (
        "# Compatibility of exported FMUs\n\n"
        f"Written by `python -m validation.importers` on {this_machine()}. Numbers are the largest difference of any "
        "output from the stored results in `reference/`, as a share of its range; of partials, those of derivatives "
        f'and of the Jacobian from ours. Euler\'s steps are {5e5 * EULER_STEP:g} us; "extrapolated" is with a run at '
        "twice the step, which takes the error of first order.\n\n"
    )
    columns = [f"{exported.name}, FMI {fmi}" for exported, fmi in subjects()]
    about = _table(["class", "version", "options", "inputs", "checker"], exports())
    return intro + about + "\n" + _table(["importer and kind", *columns], compatibility())


def _table(head: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    return "".join(f"| {' | '.join(row)} |\n" for row in (head, ["---"] * len(head), *rows))


if __name__ == "__main__":
    write_file(FILE, text())
