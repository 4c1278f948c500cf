"""Comparisons as plain data, for JSON."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from pysim.identify import FREQUENCY_CRITERIA, magnitude_db
from pysim.types import Comparison, FrequencyResponse, ResponseComparison

_KEYS = ("mean_magnitude_db", "max_magnitude_db", "mean_phase_deg", "max_phase_deg")


def comparison_data(comparisons: Sequence[Comparison]) -> dict[str, Any]:
    """Everything a Comparison holds; numbers are finite or None, magnitudes in dB relative to 0.1 Hz, phases in deg."""
    criteria = zip(_KEYS, FREQUENCY_CRITERIA, strict=True)
    return {
        "dataset": comparisons[0].dataset,
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
        "note": comparison.note,
        "tests": [_test(test) for test in comparison.tests],
    }


def _test(test: ResponseComparison) -> dict[str, Any]:
    values = [float(deviation.value) for deviation in test.deviations]
    return {
        "offset": test.measured.test.offset,
        "amplitude": test.measured.test.amplitude,
        "passes": test.passes,
        "message": test.message,
        "deviations": dict(zip(_KEYS, values, strict=True)) if values else dict.fromkeys(_KEYS),
        "frequency_hz": test.measured.frequency.tolist(),
        "measured": _response(test.measured),
        "simulated": None if test.simulated is None else _response(test.simulated),
    }


def _response(response: FrequencyResponse) -> dict[str, Any]:
    return {
        "magnitude_db": magnitude_db(response).tolist(),
        "gain": response.gain.tolist(),
        "phase_deg": np.degrees(response.phase).tolist(),
        "origin": response.origin,
    }
