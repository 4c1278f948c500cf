"""Numbers copied from the thesis: tables agree with what they print of themselves, misprints are worked out again."""

import math

import numpy as np
import pytest

from pysim.identify import FREQUENCY_CRITERIA
from pysim.thesis import measured_responses, published_deviations


def test_table_4_1_makes_stable_systems_of_nearly_unit_gain() -> None:
    responses = measured_responses()
    assert len(responses) == 18
    for response in responses:
        assert abs(20 * np.log10(response.gain[0])) < 0.3
        assert -1.1 < np.degrees(response.phase[0]) < -0.5
        assert -230 < np.degrees(response.phase[-1]) < -215


@pytest.mark.parametrize("table", ["4.4", "4.7", "4.8"])
def test_printed_verdicts_follow_from_printed_numbers(table: str) -> None:
    rows = published_deviations(table)
    assert len(rows) == 18
    for row in rows:
        within = all(value <= c.limit for value, c in zip(row.values, FREQUENCY_CRITERIA, strict=True))
        assert row.passes == within, row


def test_flow_of_eq_3_22() -> None:
    speed = 1450 * 2 * math.pi / 60
    assert round(speed * 71e-6 * 60e3) == 647
    assert round(speed / (2 * math.pi) * 71e-6 * 60e3, 2) == 102.95


def test_factors_of_eq_3_63() -> None:
    assert round(0.6392 / (0.0198 * 102.95 * (1 - 2 / math.pi)), 4) == 0.8629
    assert round(0.0198 * 102.95, 3) == 2.038


def test_bounds_of_table_4_5() -> None:
    assert round(1 / (2 * math.pi * 30), 6) == 0.005305
    assert round(1 / (2 * math.pi * 45), 7) == 0.0035368


def test_volume_of_the_locked_cylinder() -> None:
    assert round(1260e-6 * 34.2e-3 / 2 * 1e6, 1) == 21.5


def test_resonance_of_eq_5_31() -> None:
    assert round(math.sqrt(2 * 1400e6 * 9.5493e-6**2 / (1.52e-3 * 0.0733)) / (2 * math.pi), 1) == 7.6


def test_tops_of_figure_2_7() -> None:
    assert round(20 * math.log10((75 + 20) / 20), 1) == 13.5
