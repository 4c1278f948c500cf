"""Table 4.1 as data set, and the other tables against the criteria they were judged by."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from pysim.identify import FREQUENCY_CRITERIA, frequency_deviations
from pysim.io import read_dataset
from pysim.types import Comparison, ResponseComparison
from validation.pump_frequency.case import reference_responses
from validation.read_csv import read_csv
from validation.thesis import (
    FREQUENCIES_HZ,
    Difference,
    differences,
    explain,
    measured_responses,
    published_deviations,
    write_dataset,
)

REFERENCE = Path(read_csv.__code__.co_filename).parent / "reference"


def independent_comparison(label: str) -> Comparison:
    """The independent simulation in place of the FMU."""
    simulated = {(r.test.offset, r.test.amplitude): r for r in reference_responses(label)}
    tests = []
    for measured in measured_responses():
        own = simulated.get((abs(measured.test.offset), measured.test.amplitude))
        deviations = () if own is None else frequency_deviations(own, measured)
        tests.append(ResponseComparison(measured, own, deviations, "" if own else "left out of the reference"))
    return Comparison("independent", label, "Table 4.1", "", tuple(tests))


def test_coefficients_make_stable_systems_of_nearly_unit_gain() -> None:
    responses = measured_responses()
    assert len(responses) == 18
    for response in responses:
        assert abs(20 * np.log10(response.gain[0])) < 0.3
        assert -1.1 < np.degrees(response.phase[0]) < -0.5
        assert -230 < np.degrees(response.phase[-1]) < -215


def test_negative_offsets_copy_positive_ones() -> None:
    assert independent_comparison("free").independent == 9


def test_data_set_repeats_the_table(tmp_path: Path) -> None:
    read = read_dataset(write_dataset(tmp_path / "new" / "folder"))
    assert "nine independent tests" in read.description
    for a, b in zip(read.responses(), measured_responses(), strict=True):
        np.testing.assert_allclose(a.gain, b.gain, rtol=1e-8)
        np.testing.assert_allclose(a.phase, b.phase, atol=1e-9)
        assert a.test == b.test
    assert len(read.responses()[0].frequency) == len(FREQUENCIES_HZ) == 19


@pytest.mark.parametrize("table", ["4.4", "4.7", "4.8"])
def test_printed_verdicts_follow_from_printed_numbers(table: str) -> None:
    rows = published_deviations(table)
    assert len(rows) == 18
    for row in rows:
        within = all(value <= c.limit for value, c in zip(row.values, FREQUENCY_CRITERIA, strict=True))
        assert row.passes == within, row


def test_independent_simulation_gives_the_stored_nine_rows() -> None:
    found = {(t.measured.test.offset, t.measured.test.amplitude): t for t in independent_comparison("free").tests}
    for row in read_csv(REFERENCE / "free_set_deviations.csv"):
        test = found[float(row["offset_percent"]), float(row["amplitude_percent"])]
        values = [deviation.value for deviation in test.deviations]
        stored = [float(row[name]) for name in ("mean_db", "max_db", "mean_deg", "max_deg")]
        assert np.all(np.abs(np.subtract(values, stored)) <= [0.0051, 0.0051, 0.051, 0.051]), row


@pytest.mark.parametrize(("label", "table", "count"), [("free", "4.8", 18), ("locked", "4.7", 16)])
def test_table_4_4_explains_the_difference_from_the_thesis(label: str, table: str, count: int) -> None:
    rows = differences(independent_comparison(label), table)
    assert len(rows) == count
    for row in rows:
        assert max(row.excess[:2]) <= 0.05
        assert max(row.excess[2:]) <= 0.3


def test_the_explanation_would_notice_another_model() -> None:
    rows = differences(independent_comparison("locked"), "4.8")  # the locked model held against the free set's table
    assert max(row.excess[2] for row in rows) > 1.0


def test_the_words_name_the_verdicts_that_differ() -> None:
    words = " ".join(explain(differences(independent_comparison("free"), "4.8"), "4.8"))
    assert "25/10, 75/5, 75/10, 75/20." in words
    assert "5 to 10 deg here, 21 to 37 deg in Table 4.8" in words
    assert explain((), "4.8") == []
    smallest, largest = (f(row.values[1] for row in published_deviations("4.4")) for f in (min, max))
    assert f"and {smallest:.2f} to {largest:.2f} dB away" in words
    assert "can explain every difference" in words
    assert "Assumption: both comparisons are at the same frequencies" in words


def test_the_words_name_the_tests_that_the_misfit_does_not_explain() -> None:
    words = " ".join(explain(differences(independent_comparison("locked"), "4.8"), "4.8"))
    assert "does not explain the difference" in words
    assert "can explain every difference" not in words
    # 25/5 by hand: |ours - printed| - misfit - rounding, beyond the tolerance in the mean phase alone
    row = Difference(25.0, 5.0, (0.5, 1.0, 9.0, 30.0), (0.4, 0.9, 3.0, 28.0), (0.2, 0.3, 4.0, 25.0), False, False)
    fine = replace(row, offset=50.0, ours=(0.5, 1.0, 7.3, 30.0))
    (sentence,) = (line for line in explain((row, fine), "4.7") if line.startswith("Is that all"))
    assert "1 of 2 tests differ by more: 25/5 (by 0.00 dB, 1.9 deg)." in sentence
