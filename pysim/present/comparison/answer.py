"""Comparisons as text for a terminal, as data for JSON and as a page."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from pysim.identify import FREQUENCY_CRITERIA, magnitude_db
from pysim.present import criteria
from pysim.present.page import cell, heading, items, paragraph, pictures, table
from pysim.present.page import page as whole_page
from pysim.present.plain_text import wrapped
from pysim.present.render import Drawing
from pysim.types import Comparison, FrequencyResponse, ResponseComparison
from pysim.types.json_number import json_data

_WIDTH = 78
_HEAD = ("mean dB", "max dB", "mean deg", "max deg")


@dataclass(frozen=True)
class Comparisons:
    """Parameter sets against one data set.

    Args:
        title: of the page.
        sets: one at least.
        remarks: sections of HTML behind the pictures.
    """

    title: str
    sets: tuple[Comparison, ...]
    remarks: tuple[str, ...] = ()


def whole(result: Comparison | Comparisons) -> Comparisons:
    """One parameter set is several with one."""
    return result if isinstance(result, Comparisons) else Comparisons("A model against its measurements", (result,))


def text(result: Comparisons) -> str:
    """The table of every parameter set."""
    return "\n\n".join(comparison_text(comparison) for comparison in result.sets)


def comparison_text(comparison: Comparison) -> str:
    """A row per test with the four numbers of Table 1.3 and the verdict; * marks what is beyond its limit."""
    lines = [
        f"{comparison.label}: {comparison.model} against {comparison.dataset} ({comparison.measured_name})",
        "  offset  amplitude" + "".join(f"{name:>10}" for name in _HEAD) + "   verdict",
    ]
    lines += [_row(test) for test in comparison.tests]
    limits = comparison.tests[0].deviations or next((t.deviations for t in comparison.tests if t.deviations), ())
    if limits:
        cells = "".join(f"{text:>9} " for text in criteria.numbers([one.criterion.limit for one in limits]))
        lines.append(f"  {'limit':<17}{cells}  {limits[0].criterion.source}")
    return "\n".join([*lines, verdict_text(comparison), *wrapped(note_text(comparison), width=_WIDTH)])


def note_text(comparison: Comparison) -> str:
    """What the data set says of itself; nothing where it says nothing."""
    return "" if comparison.note.strip() == "-" else comparison.note


def verdict_text(comparison: Comparison) -> str:
    """How many tests pass, in one sentence; rows with the same measured response count as one test."""
    passed, count = sum(test.passes for test in comparison.tests), len(comparison.tests)
    independent = comparison.independent
    if independent == count:
        return f"{passed} of {count} tests pass."
    return f"{comparison.independent_passes} of {independent} independent tests pass ({passed} of {count} rows)."


def _row(test: ResponseComparison) -> str:
    point = f"{test.measured.test.offset:>8g}{test.measured.test.amplitude:>11g}"
    if not test.deviations:
        return f"{point}  no response: {test.message}  FAIL"
    texts = criteria.numbers([one.value for one in test.deviations])
    marked = zip(texts, test.deviations, strict=True)
    cells = "".join(f"{text:>9}{' ' if one.passes else '*'}" for text, one in marked)
    return f"{point}{cells}   {'pass' if test.passes else 'FAIL'}"


def data(result: Comparisons) -> dict[str, Any]:
    """Everything a Comparison holds; numbers are finite or None, magnitudes in dB relative to
    `reference_hz`, phases in deg."""
    first, limits = result.sets[0], zip(criteria.KEYS, FREQUENCY_CRITERIA, strict=True)
    return json_data(
        {
            "dataset": first.dataset,
            "measured": first.measured_name,
            **{key: getattr(first, key) for key in ("reference_hz", "command_unit", "note")},
            "criteria": {key: {"limit": c.limit, "unit": c.unit, "source": c.source} for key, c in limits},
            "parameter_sets": [_set(comparison) for comparison in result.sets],
        }
    )


def _set(comparison: Comparison) -> dict[str, Any]:
    return {
        **{key: getattr(comparison, key) for key in ("label", "model", "overrides", "passes", "note", "conditions")},
        "passed": sum(test.passes for test in comparison.tests),
        "independent": comparison.independent,
        "independent_passed": comparison.independent_passes,
        "parameters": {name: {"value": v, "unit": unit} for name, (v, unit) in comparison.parameters.items()},
        "tests": [_test(test, comparison.reference_hz) for test in comparison.tests],
    }


def _test(test: ResponseComparison, reference_hz: float | None) -> dict[str, Any]:
    return {
        "offset": test.measured.test.offset,
        "amplitude": test.measured.test.amplitude,
        "passes": test.passes,
        "message": test.message,
        "deviations": criteria.keyed(test.deviations),
        "frequency_hz": test.measured.frequency,
        "measured": _response(test.measured, reference_hz),
        "simulated": None if test.simulated is None else _response(test.simulated, reference_hz),
    }


def _response(response: FrequencyResponse, reference_hz: float | None) -> dict[str, Any]:
    return {
        "magnitude_db": magnitude_db(response, reference_hz),
        "gain": response.gain,
        "phase_deg": np.degrees(response.phase),
        "origin": response.origin,
    }


def page(result: Comparisons, drawings: Sequence[Drawing], redo: str) -> str:
    """What was done, verdicts with their caveat, pictures, remarks, how to redo it."""
    comparisons = result.sets
    first = comparisons[0]
    models = "; ".join(f"{comparison.label}: {comparison.model}" for comparison in comparisons)
    parts = [heading("Verdict"), items(f"{c.label}: {verdict_text(c)}" for c in comparisons)]
    note = [paragraph(note_text(first), note=True)] if note_text(first) else []
    parts += [*note, heading("What was done"), *_method(comparisons)]
    parts += [_conditions_table(comparisons), _parameters_table(comparisons)]
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
    return table(caption, head, [*map(_cells, comparison.tests), limits])


def _cells(test: ResponseComparison) -> list[str]:
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


def _conditions_table(comparisons: Sequence[Comparison]) -> str:
    """What it takes to repeat the runs, a column per parameter set."""
    names = list(dict.fromkeys(name for c in comparisons for name in c.conditions))
    rows = [[name, *(c.conditions.get(name, "-") for c in comparisons)] for name in names]
    words = range(1, 1 + len(comparisons))
    return table("Conditions of the runs", ["", *(c.label for c in comparisons)], rows, words=words)


def _parameters_table(comparisons: Sequence[Comparison]) -> str:
    """Every parameter in force, a column per parameter set; values that differ between the sets are marked."""
    units = {name: unit for c in comparisons for name, (_, unit) in c.parameters.items()}
    rows = []
    for name, unit in units.items():
        values = [f"{c.parameters[name][0]:.10g}" if name in c.parameters else "-" for c in comparisons]
        kind = "differs" if len(set(values)) > 1 else ""
        rows.append([name, unit, *(cell(value, kind) for value in values)])
    head = ["", "unit", *(c.label for c in comparisons)]
    return table("Parameters in force; bold: not the same in all sets", head, rows)
