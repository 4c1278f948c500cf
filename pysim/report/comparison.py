"""The page on a model against its measurements."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from pysim.identify import FREQUENCY_CRITERIA
from pysim.report.page import cell, commands, heading, items, page, paragraph, picture, table
from pysim.report.text import verdict_text
from pysim.types import Comparison, ResponseComparison

_DIGITS = (2, 2, 1, 1)


def comparison_page(
    title: str,
    comparisons: Sequence[Comparison],
    *,
    pictures: Mapping[str, bytes],
    redo: str,
    remarks: Sequence[str] = (),
) -> str:
    """A self-contained HTML page: what was done, verdicts with their caveat, pictures, remarks, how to redo it.

    Args:
        comparisons: parameter sets against one data set.
        pictures: caption -> SVG, in the order they are shown.
        redo: the command line that makes this page again.
        remarks: sections of HTML to put behind the pictures.
    """
    first = comparisons[0]
    models = "; ".join(f"{comparison.label}: {comparison.model}" for comparison in comparisons)
    parts = [heading("Verdict"), items(f"{c.label}: {verdict_text(c)}" for c in comparisons)]
    parts += [paragraph(first.note, note=True), heading("What was done"), *_method(comparisons)]
    for comparison in comparisons:
        parts += [heading(f"Test by test: {comparison.label}"), comparison_table(comparison)]
        parts += [paragraph(first.note, note=True)]
    parts += [heading("Pictures"), *(picture(svg, caption) for caption, svg in pictures.items())]
    parts += [*remarks, heading("Do it again"), commands(redo)]
    return page(title, f"{models}; measurements: {first.dataset}.", parts)


def comparison_table(comparison: Comparison) -> str:
    """A row per test, with what is beyond its limit marked."""
    head = ["offset %", "amplitude %", *(f"{c.name.replace(' deviation', '')} ({c.unit})" for c in FREQUENCY_CRITERIA)]
    limits = [cell("limit"), cell(""), *(cell(f"{c.limit:g}") for c in FREQUENCY_CRITERIA), cell("")]
    rows = [_row(test) for test in comparison.tests]
    caption = f"{comparison.label}: deviation from {comparison.dataset}, limits of {FREQUENCY_CRITERIA[0].source}"
    return table(caption, [*head, "verdict"], [*rows, limits])


def _row(test: ResponseComparison) -> list[str]:
    point = [cell(f"{test.measured.test.offset:g}"), cell(f"{test.measured.test.amplitude:g}")]
    if not test.deviations:
        return [*point, *[cell("-")] * len(FREQUENCY_CRITERIA), cell(f"fail: {test.message}", "fail")]
    numbers = [
        cell(f"{d.value:.{digits}f}", "" if d.passes else "beyond")
        for d, digits in zip(test.deviations, _DIGITS, strict=True)
    ]
    return [*point, *numbers, cell("pass", "pass") if test.passes else cell("fail", "fail")]


def _method(comparisons: Sequence[Comparison]) -> list[str]:
    f = comparisons[0].tests[0].measured.frequency
    runs = sum(test.measured.frequency.size for c in comparisons for test in c.tests)
    lines = [
        f"{len(comparisons[0].tests)} stepped-sine tests of {f.size} frequencies, {f[0]:g} to {f[-1]:g} Hz, were run "
        f"through the FMU for each parameter set, {runs} runs in all: rest, ramp to the offset, hold, then a sine from "
        "t = 2 s (thesis Section 2.1.1).",
        "A sine was fitted by least squares to the last whole periods, after the transients (Section 2.2). Its "
        "amplitude relative to that at 0.1 Hz is the magnitude, its phase against the command the phase (Section 2.3).",
        "Deviations are simulated minus measured, averaged and at their largest over the frequencies (Eq. 2.27, 2.28). "
        "A test passes when all four are within Table 1.3.",
    ]
    for comparison in comparisons:
        if comparison.overrides:
            values = ", ".join(f"{name} = {value:g}" for name, value in comparison.overrides.items())
            lines.append(f"Set beforehand for {comparison.label}: {values}.")
    return [items(lines)]
