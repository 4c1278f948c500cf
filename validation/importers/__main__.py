"""`python -m validation.importers`: write COMPATIBILITY.md anew."""

from __future__ import annotations

from pathlib import Path

from pysim.io import write_file
from validation.importers.case import compatibility
from validation.importers.try_one import EVALUATORS, IMPORTERS
from validation.results import newest, read_results, this_machine

FILE = Path(__file__).with_name("COMPATIBILITY.md")
_KEPT = Path(__file__).parents[1] / "recorded.jsonl"


def text() -> str:
    """The table as Markdown."""
    head = ["class", "version", "options", "inputs", *IMPORTERS, *EVALUATORS, "checker"]
    rows = [[cell.partition(": ")[2] or cell for cell in row] for row in compatibility()]
    lines = [f"| {' | '.join(row)} |" for row in (head, ["---"] * len(head), *rows)]
    intro = (
        "# Compatibility of exported FMUs\n\n"
        f"Written by `python -m validation.importers` on {this_machine()}. Numbers are the largest difference of any "
        "output from the stored results in `reference/`, as a share of its range; of partials, those of derivatives "
        "and of the Jacobian from ours.\n\n"
    )
    return intro + "\n".join(lines) + "\n" + _windows()


def _windows() -> str:
    """What the last recorded run of the case `wine` found; nothing where there is none."""
    last = newest(read_results(_KEPT)).get("wine")
    found = [finding for finding in last.findings if not finding.skipped] if last else []
    told = "; ".join(f"{finding.claim}: {finding.value:.2g} {finding.unit}".strip() for finding in found)
    return f"\nWindows: {told} ({last.date[:10]}, case `wine`).\n" if last and told else ""


if __name__ == "__main__":
    write_file(FILE, text())
