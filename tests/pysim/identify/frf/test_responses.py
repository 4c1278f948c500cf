"""A data set's logs as responses."""

from dataclasses import replace

import numpy as np
import pytest

from pysim.identify import magnitude_db, measured_responses, standard_deviations
from pysim.types import BadInput
from pysim.types.note import NoteCode
from tests.pysim.identify.frf.systems import dataset, log, response, white

F = (0.1, 1.0, 5.0, 13.0, 25.0)


def logs(sigma: float = 0.0, seed: int = 0, **words: float) -> list:
    return [log(f, periods=max(2, 3 * f), noise=white(6000, sigma, seed + i), **words) for i, f in enumerate(F)]


def test_groups_by_offset_and_amplitude_in_rising_frequency() -> None:
    other = [replace(record, offset=75.0) for record in logs()]
    first, second = measured_responses(dataset(*logs()[::-1], *other))
    assert [first.response.test.label, second.response.test.label] == ["O+50 A10", "O+75 A10"]
    np.testing.assert_allclose(first.response.frequency, F)
    np.testing.assert_allclose(first.response.gain, np.abs(response(np.array(F))), atol=2e-6)
    np.testing.assert_allclose(first.response.phase, np.unwrap(np.angle(response(np.array(F)))), atol=2e-6)
    assert (first.input_unit, first.output_unit) == ("%", "deg")


def test_what_is_not_told_is_read_off_the_command() -> None:
    records = [replace(record, offset=None, amplitude=None) for record in logs()]
    (only,) = measured_responses(dataset(*records))
    assert only.response.test.label == "O+50 A10"


def test_a_repeated_test_is_a_response_of_its_own() -> None:
    first, second = measured_responses(dataset(*logs(), *logs(0.1)[1:3]))
    assert first.response.frequency.size == 5
    assert second.response.frequency.tolist() == [1.0, 5.0]
    assert second.response.origin == "measured, bench, repetition 1"


def test_intervals_of_magnitude_and_phase_cover_the_truth() -> None:
    truth = response(np.array(F))
    hits, runs = np.zeros((3, len(F))), 30
    for run in range(runs):
        (one,) = measured_responses(dataset(*logs(0.3, 10 * run), noise=0.3))
        for k, reference in enumerate((None, 0.1)):
            exact = 20 * np.log10(np.abs(truth))
            off = magnitude_db(one.response, reference) - exact + (0 if reference is None else exact[0])
            deviation, degrees = standard_deviations(one.response, reference)
            hits[k] += np.abs(off) <= 1.96 * deviation
        hits[2] += np.abs(np.degrees(one.response.phase - np.unwrap(np.angle(truth)))) <= 1.96 * degrees
    assert (hits[1, 0]) == runs  # the reference has no doubt of its own
    assert hits.sum() / hits.size / runs == pytest.approx(0.95 + 0.05 / 15, abs=0.035)  # 450 trials, and correlated


def test_declared_noise_includes_the_rounding() -> None:
    step = 0.4
    records = []
    for record in logs(0.1):
        values = np.array(record.data.values)
        values[:, 1] = np.round(values[:, 1] / step) * step
        records.append(replace(record, data=replace(record.data, values=values)))
    (one,) = measured_responses(dataset(*records, noise=0.1, resolution=step))
    assert one.points[3].noise.deviation == pytest.approx(np.hypot(0.1, step / np.sqrt(12)), rel=0.1)
    assert one.points[3].noise.at_frequency == pytest.approx(np.hypot(0.1, step / np.sqrt(12)), rel=0.1)


def test_a_noise_of_nothing_is_refused() -> None:
    with pytest.raises(BadInput, match="a noise of 0 gives no weight; leave it out or correct it"):
        measured_responses(dataset(*logs(0.1), noise=0.0))


def test_notes_tell_of_harmonics() -> None:
    (one,) = measured_responses(
        dataset(*[log(f, periods=20, add=0.03 * (f == 5.0), noise=white(1001, 0.01, 4)) for f in (5.0, 7.0)])
    )
    (note,) = one.notes
    assert note.code is NoteCode.HARMONICS
    assert (note.values["count"], note.values["points"], note.values["frequency"]) == (1, 2, 5.0)
    assert note.values["percent"] == pytest.approx(3.0, rel=0.02)


def test_refuses_what_cannot_be_told_apart() -> None:
    with pytest.raises(BadInput, match="no log of kind"):
        measured_responses(dataset())
    with pytest.raises(BadInput, match=r"0\.1Hz\.txt: no output 'z'; name one of y"):
        measured_responses(dataset(*logs()), output="z")
    both = dataset(*logs())
    swapped = tuple(replace(s, role="output") for s in both.signals)
    with pytest.raises(BadInput, match="0 signals of role input"):
        measured_responses(replace(both, signals=swapped))
    swapped = tuple(replace(s, role="input") for s in both.signals)
    with pytest.raises(BadInput, match="2 signals of role input; name one of cmd, y"):
        measured_responses(replace(both, signals=swapped))
    (only,) = measured_responses(dataset(*logs()[:1]))
    bare = replace(only.response, covariance=None)
    with pytest.raises(BadInput, match="doubt is not known"):
        standard_deviations(bare)
