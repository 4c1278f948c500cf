"""The page of best linear approximations."""

from __future__ import annotations

from collections.abc import Sequence

from pysim.present.multisine.answer import Approximations, heads, table_rows, verdicts
from pysim.present.page import cell, heading, items, paragraph, pictures, table
from pysim.present.page import page as whole_page
from pysim.present.render import Drawing


def page(result: Approximations, drawings: Sequence[Drawing], redo: str) -> str:
    """Verdicts, pictures and a table per approximation."""
    parts = [heading("Best linear approximation")]
    for name, bla in result.found:
        parts += [paragraph(f"{name}, {bla.method}."), items(verdicts(bla))]
    parts += pictures(drawings)
    parts.append(
        paragraph(
            "Levels are mean squares of one realisation over its periods, divided by the input's power on a line; they "
            "add up. Even and odd parts are means over neighbouring lines that were not excited. A dash is below what "
            "the noise lets see.",
            note=True,
        )
    )
    for name, bla in result.found:
        rows = [[cell(text) for text in row] for row in table_rows(bla)]
        parts.append(table(f"{name}: some of {bla.frequency.size} lines, ± for 95 percent", heads(bla), rows))
    lead = "How much of the response is linear, how much noise, how much distortion, line by line."
    return whole_page(result.title, lead, parts, redo)
