"""The part of a page that holds our comparison of the pump beside the thesis' own."""

from __future__ import annotations

from pysim.present.page import heading, items, table
from pysim.thesis.explanation import differences, explain
from pysim.types import Comparison

_TABLES = {"free": "4.8", "locked": "4.7"}
_CAVEATS: dict[str, tuple[str, ...]] = {
    "free": (),
    "locked": (
        "At 75/20 and -75/20 the volume of a chamber (Eq. 3.5) reaches zero inside the stroke with this set, 21.1 cm3 "
        "against 21.5 cm3 swept. The model has a floor there; what the thesis' program did is not known.",
    ),
}


def against_the_thesis(comparison: Comparison) -> list[str]:
    """Our numbers beside the thesis' own, and why they differ."""
    printed = _TABLES[comparison.label]
    rows = differences(comparison, printed)
    head = ["offset %", "amplitude %"]
    for name, unit in (("mean", "dB"), ("max", "dB"), ("mean", "deg"), ("max", "deg")):
        head += [f"{name} {unit}", "thesis", "fit"]
    texts = [
        [f"{row.offset:g}", f"{row.amplitude:g}"]
        + [f"{value:.{2 if i < 2 else 1}f}" for i in range(4) for value in (row.ours[i], row.printed[i], row.misfit[i])]
        for row in rows
    ]
    caption = f"{comparison.label}: this page | thesis Table {printed} | misfit of the transfer function, Table 4.4"
    title = f"Where and why this differs from thesis Table {printed} ({comparison.label} set)"
    return [heading(title), items([*explain(rows, printed), *_CAVEATS[comparison.label]]), table(caption, head, texts)]
