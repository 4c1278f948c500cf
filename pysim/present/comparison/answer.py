"""Comparisons as text for a terminal and as data for JSON."""

from __future__ import annotations

import textwrap
from dataclasses import dataclass
from typing import Any

import numpy as np

from pysim.identify import FREQUENCY_CRITERIA, magnitude_db
from pysim.types import Comparison, Deviation, FrequencyResponse, ResponseComparison

_WIDTH = 78
_HEAD = ("mean dB", "max dB", "mean deg", "max deg")
_DIGITS = (2, 2, 1, 1)
_KEYS = ("mean_magnitude_db", "max_magnitude_db", "mean_phase_deg", "max_phase_deg")


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


def data(result: Comparisons) -> dict[str, Any]:
    """Everything a Comparison holds; numbers are finite or None, magnitudes in dB relative to
    `reference_hz`, phases in deg."""
    comparisons = result.sets
    criteria = zip(_KEYS, FREQUENCY_CRITERIA, strict=True)
    return {
        "dataset": comparisons[0].dataset,
        "measured": comparisons[0].measured_name,
        "reference_hz": comparisons[0].reference_hz,
        "command_unit": comparisons[0].command_unit,
        "note": comparisons[0].note,
        "criteria": {key: {"limit": c.limit, "unit": c.unit, "source": c.source} for key, c in criteria},
        "parameter_sets": [_set(comparison) for comparison in comparisons],
    }


def _set(comparison: Comparison) -> dict[str, Any]:
    return {
        "label": comparison.label,
        "model": comparison.model,
        "overrides": dict(comparison.overrides),
        "passes": comparison.passes,
        "passed": sum(test.passes for test in comparison.tests),
        "independent": comparison.independent,
        "independent_passed": comparison.independent_passes,
        "note": comparison.note,
        "conditions": dict(comparison.conditions),
        "parameters": {name: {"value": v, "unit": unit} for name, (v, unit) in comparison.parameters.items()},
        "tests": [_test(test, comparison.reference_hz) for test in comparison.tests],
    }


def _test(test: ResponseComparison, reference_hz: float | None) -> dict[str, Any]:
    values = [float(deviation.value) for deviation in test.deviations]
    return {
        "offset": test.measured.test.offset,
        "amplitude": test.measured.test.amplitude,
        "passes": test.passes,
        "message": test.message,
        "deviations": dict(zip(_KEYS, values, strict=True)) if values else dict.fromkeys(_KEYS),
        "frequency_hz": test.measured.frequency.tolist(),
        "measured": _response(test.measured, reference_hz),
        "simulated": None if test.simulated is None else _response(test.simulated, reference_hz),
    }


def _response(response: FrequencyResponse, reference_hz: float | None) -> dict[str, Any]:
    return {
        "magnitude_db": magnitude_db(response, reference_hz).tolist(),
        "gain": response.gain.tolist(),
        "phase_deg": np.degrees(response.phase).tolist(),
        "origin": response.origin,
    }
