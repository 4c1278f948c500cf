"""The page on a model against its measurements."""

from __future__ import annotations

from collections.abc import Sequence

from pysim.identify import FREQUENCY_CRITERIA
from pysim.present import criteria
from pysim.present.comparison.answer import Comparisons, note_text, verdict_text
from pysim.present.page import cell, heading, items, paragraph, pictures, table
from pysim.present.page import page as whole_page
from pysim.present.render import Drawing
from pysim.types import Comparison, ResponseComparison


def page(result: Comparisons, drawings: Sequence[Drawing], redo: str) -> str:
    """What was done, verdicts with their caveat, pictures, remarks, how to redo it."""
    comparisons = result.sets
    first = comparisons[0]
    models = "; ".join(f"{comparison.label}: {comparison.model}" for comparison in comparisons)
    parts = [heading("Verdict"), items(f"{c.label}: {verdict_text(c)}" for c in comparisons)]
    note = [paragraph(note_text(first), note=True)] if note_text(first) else []
    parts += [*note, heading("What was done"), *_method(comparisons)]
    parts += [_conditions(comparisons), _parameters(comparisons)]
    for comparison in comparisons:
        parts += [heading(f"Test by test: {comparison.label}"), comparison_table(comparison)]
        parts += note
    parts += [heading("Pictures"), *pictures(drawings), *result.remarks]
    return whole_page(result.title, f"{models}; held against: {first.dataset}, {first.measured_name}.", parts, redo)


def comparison_table(comparison: Comparison) -> str:
    """A row per test, with what is beyond its limit marked."""
    unit = comparison.command_unit
    head = [f"offset {unit}", f"amplitude {unit}", *criteria.heads(), "verdict"]
    limits = ["limit", "", *(f"{c.limit:g}" for c in FREQUENCY_CRITERIA), ""]
    source = FREQUENCY_CRITERIA[0].source
    caption = f"{comparison.label}: absolute deviation from {comparison.measured_name}, limits of {source}"
    return table(caption, head, [*map(_row, comparison.tests), limits])


def _row(test: ResponseComparison) -> list[str]:
    point = [f"{test.measured.test.offset:g}", f"{test.measured.test.amplitude:g}"]
    if not test.deviations:
        return [*point, *["-"] * len(FREQUENCY_CRITERIA), cell(f"fail: {test.message}", "fail")]
    verdict = "pass" if test.passes else "fail"
    return [*point, *criteria.cells(test.deviations), cell(verdict, verdict)]


def _method(comparisons: Sequence[Comparison]) -> list[str]:
    first = comparisons[0]
    f = first.tests[0].measured.frequency
    relative = "" if first.reference_hz is None else f" relative to that at {first.reference_hz:g} Hz"
    runs = sum(test.measured.frequency.size for c in comparisons for test in c.tests)
    lines = [
        f"{len(comparisons[0].tests)} stepped-sine tests of {f.size} frequencies, {f[0]:g} to {f[-1]:g} Hz, were run "
        f"through the FMU for each parameter set, {runs} runs in all: rest, ramp to the offset, hold, then a sine "
        "(thesis Section 2.1.1). Runs that had not settled were repeated with longer settling.",
        "A sine was fitted by least squares to the last whole periods, after the transients (Section 2.2). Its "
        f"amplitude{relative} is the magnitude, its phase against the command the phase (Section 2.3).",
        f"The model is held against: {first.measured_name}. Deviations are the absolute values of the differences, "
        "their average and their largest over the frequencies (Eq. 2.27, 2.28), so that errors of both signs do not "
        "cancel. A test passes when all four are within Table 1.3.",
    ]
    for comparison in comparisons:
        if comparison.overrides:
            values = ", ".join(f"{name} = {value:g}" for name, value in comparison.overrides.items())
            lines.append(f"Set beforehand for {comparison.label}: {values}.")
    return [items(lines)]


def _conditions(comparisons: Sequence[Comparison]) -> str:
    """What it takes to repeat the runs, a column per parameter set."""
    names = list(dict.fromkeys(name for c in comparisons for name in c.conditions))
    rows = [[name, *(c.conditions.get(name, "-") for c in comparisons)] for name in names]
    words = range(1, 1 + len(comparisons))
    return table("Conditions of the runs", ["", *(c.label for c in comparisons)], rows, words=words)


def _parameters(comparisons: Sequence[Comparison]) -> str:
    """Every parameter in force, a column per parameter set; values that differ between the sets are marked."""
    units = {name: unit for c in comparisons for name, (_, unit) in c.parameters.items()}
    rows = []
    for name, unit in units.items():
        values = [f"{c.parameters[name][0]:.10g}" if name in c.parameters else "-" for c in comparisons]
        kind = "differs" if len(set(values)) > 1 else ""
        rows.append([name, unit, *(cell(value, kind) for value in values)])
    head = ["", "unit", *(c.label for c in comparisons)]
    return table("Parameters in force; bold: not the same in all sets", head, rows)
