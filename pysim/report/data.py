"""Comparisons as plain data, for JSON."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from pysim.identify import FREQUENCY_CRITERIA, magnitude_db
from pysim.types import Comparison, FrequencyResponse, ResponseComparison

_KEYS = ("mean_magnitude_db", "max_magnitude_db", "mean_phase_deg", "max_phase_deg")


def comparison_data(comparisons: Sequence[Comparison]) -> dict[str, Any]:
    """Everything a Comparison holds; numbers are finite or None, magnitudes in dB relative to
    `reference_hz`, phases in deg."""
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
