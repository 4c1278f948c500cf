"""Comparisons as text for a terminal."""

from __future__ import annotations

import textwrap

from pysim.types import Comparison, Deviation, ResponseComparison

_WIDTH = 78
_HEAD = ("mean dB", "max dB", "mean deg", "max deg")
_DIGITS = (2, 2, 1, 1)


def comparison_text(comparison: Comparison) -> str:
    """A row per test with the four numbers of Table 1.3 and the verdict; * marks what is beyond its limit."""
    lines = [
        f"{comparison.label}: {comparison.model} against {comparison.dataset} ({comparison.measured_name})",
        "  offset  amplitude" + "".join(f"{name:>10}" for name in _HEAD) + "   verdict",
    ]
    lines += [_row(test) for test in comparison.tests]
    limits = comparison.tests[0].deviations or next((t.deviations for t in comparison.tests if t.deviations), ())
    if limits:
        cells = "".join(f"{d.criterion.limit:>9.{digits}f} " for d, digits in zip(limits, _DIGITS, strict=True))
        lines.append(f"  {'limit':<17}{cells}  {limits[0].criterion.source}")
    lines.append(verdict_text(comparison))
    return "\n".join([*lines, *textwrap.wrap(note_text(comparison), _WIDTH)])


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
    cells = "".join(_cell(d, digits) for d, digits in zip(test.deviations, _DIGITS, strict=True))
    return f"{point}{cells}   {'pass' if test.passes else 'FAIL'}"


def _cell(deviation: Deviation, digits: int) -> str:
    return f"{deviation.value:>9.{digits}f}{' ' if deviation.passes else '*'}"
