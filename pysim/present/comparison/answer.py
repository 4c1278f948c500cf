"""Comparisons as text for a terminal and as data for JSON."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from pysim.identify import FREQUENCY_CRITERIA, magnitude_db
from pysim.present import criteria
from pysim.present.plain_text import wrapped
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
