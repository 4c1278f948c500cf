"""Every point of both parameter sets within 0.03 dB and 0.25 degrees of the independent simulation."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from pysim.identify import frequency_response, response_difference, stepped_sine
from pysim.identify.stepped_sine import SteppedSine
from pysim.simulate import simulate_many
from pysim.thesis import CLASSES, pump_model, read_csv
from pysim.types import FrequencyResponse, Model, SineTest
from validation.findings import Finding

LIMIT_DB, LIMIT_DEG = 0.03, 0.25
_FILE = Path(__file__).parents[1] / "reference" / "pump_frequency_response.csv"


def run() -> Iterator[Finding]:
    """Both sets, FMI 2 and FMI 3, through the native loop."""
    for fmi in (2, 3):
        for parameter_set in CLASSES:
            yield from _check(pump_model(parameter_set, fmi=fmi), f"FMI {fmi}, {parameter_set} set", parameter_set)


def reference_responses(parameter_set: str) -> tuple[FrequencyResponse, ...]:
    """The independent simulation of "free" or "locked", a response per offset and amplitude."""
    points: dict[SineTest, list[tuple[float, float, float]]] = defaultdict(list)
    for row in read_csv(_FILE):
        if row["parameter_set"] == parameter_set:
            test = SineTest(float(row["offset_percent"]), float(row["amplitude_percent"]), "alphaCMD", "alphaPercent")
            points[test].append((float(row["frequency_hz"]), float(row["gain"]), float(row["phase_deg"])))
    responses = []
    for test, rows in points.items():
        frequency, gain, phase = np.array(rows).T
        responses.append(FrequencyResponse(frequency, gain, np.radians(phase), test, "independent simulation"))
    return tuple(responses)


def simulated_responses(model: Model, references: tuple[FrequencyResponse, ...]) -> Iterator[FrequencyResponse]:
    """The FMU's responses to the same tests at the same frequencies."""
    pairs = [(reference.test, f) for reference in references for f in reference.frequency.tolist()]
    experiments = [stepped_sine(test, f, rate_input="alphaCMD_t") for test, f in pairs]
    records = iter(simulate_many(model, experiments))
    for reference in references:
        own = [next(records) for _ in reference.frequency]
        yield frequency_response(own, reference.frequency.tolist(), reference.test, onset=SteppedSine().onset)


def _check(model: Model, title: str, parameter_set: str) -> Iterator[Finding]:
    references = reference_responses(parameter_set)
    worst = {"dB": (0.0, ""), "deg": (0.0, "")}
    for reference, simulated in zip(references, simulated_responses(model, references), strict=True):
        for unit, difference in zip(
            worst, response_difference(simulated, reference, reference_hz=None), strict=True
        ):  # absolute gains
            at = int(np.argmax(np.abs(difference)))
            place = f"{reference.test.label} at {reference.frequency[at]:g} Hz"
            worst[unit] = max(worst[unit], (float(abs(difference[at])), place))
    count = sum(reference.frequency.size for reference in references)
    for (unit, (value, place)), limit in zip(worst.items(), (LIMIT_DB, LIMIT_DEG), strict=True):
        yield Finding(f"{title}: largest difference over {count} points, {place}", value, limit, unit)
