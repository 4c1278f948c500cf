"""One log against the closed form of its system."""

import math
from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from pysim.identify import SinePoint, Window, sine_point
from pysim.identify.frf.noise import COLOURED
from pysim.types import BadInput, MeasuredRecord, Record
from pysim.types.note import Note, NoteCode
from tests.pysim.identify.frf.systems import coloured, log, response, white
from tests.pysim.identify.seeds import at_least, at_most, seeds


def error(point, frequency: float) -> np.ndarray:
    """Gain and phase minus the truth."""
    truth = response(frequency)
    return np.array([point.gain - abs(truth), np.angle(np.exp(1j * (point.phase - np.angle(truth))))])


@pytest.mark.parametrize("frequency", [0.5, 3.7, 25.0, 30.0])
def test_is_exact_without_noise(frequency: float) -> None:
    point = sine_point(log(frequency), "cmd", "y")
    np.testing.assert_allclose(error(point, frequency), 0.0, atol=2e-6)  # the command is rounded to 1e-5
    assert point.mean == pytest.approx(45.0, abs=1e-6)
    assert not point.distorted


def test_command_counts_as_it_was_logged_not_as_it_was_meant() -> None:
    point = sine_point(log(3.0, amplitude=8.0, told=(50.0, 10.0)), "cmd", "y")
    np.testing.assert_allclose(error(point, 3.0), 0.0, atol=2e-6)
    assert point.command.amplitude == pytest.approx(8.0, abs=1e-5)


def check_coverage(hits: np.ndarray, runs: int) -> None:
    """Of 95 percent intervals of gain, phase and mean, whose errors have little to do with each other."""
    assert at_least(0.95, 3 * runs) <= hits.sum() <= at_most(0.95, 3 * runs)
    assert hits.min() >= at_least(0.95, runs)


@seeds(120)
@pytest.mark.parametrize(("make", "declared"), [(white, None), (white, 0.5), (coloured, None)])
def test_intervals_cover_the_truth(
    make: Callable[[int, float, int], np.ndarray], declared: float | None, runs: int
) -> None:
    hits = np.zeros(3)
    for seed in range(runs):
        point = sine_point(log(5.0, noise=make(1100, 0.5, seed)), "cmd", "y", noise=declared)
        off = [*error(point, 5.0), point.mean - 45.0]
        hits += np.abs(off) < 1.96 * np.sqrt(np.diag(point.covariance))
    check_coverage(hits, runs)


def test_noise_of_the_logged_command_counts_in_the_gain() -> None:
    """An amplitude A of n samples with noise s has the variance 2 s^2/n; the answer has none."""
    record, s = log(5.0, periods=100), 0.3
    assert isinstance(record.data, Record)
    values = record.data.values + s * np.random.default_rng(7).standard_normal((record.data.time.size, 1)) * [1, 0]
    point = sine_point(replace(record, data=replace(record.data, values=values)), "cmd", "y")
    variance = abs(response(5.0)) ** 2 / 10.0**2 * 2 * s**2 / record.data.time.size
    assert point.covariance[0, 0] == pytest.approx(variance, rel=0.1)  # s is estimated: 2 percent


def without(record: MeasuredRecord, begin: float, end: float) -> MeasuredRecord:
    """The same log with the samples between two times lost."""
    data = record.data
    assert isinstance(data, Record)
    kept = (data.time < begin) | (data.time > end)
    return replace(record, data=replace(data, time=data.time[kept], values=data.values[kept]))


@seeds(120)
@pytest.mark.parametrize("hole", [0.05, 0.2, 0.3, 0.35])
def test_intervals_cover_the_truth_where_samples_are_lost(hole: float, runs: int) -> None:
    hits, widest = np.zeros(3), 0.0
    for seed in range(runs):
        record = without(log(1.0, periods=2.4, noise=white(1000, 0.05, seed)), 3.6, 3.6 + hole)
        point = sine_point(record, "cmd", "y")
        assert point.periods == 1
        hits += np.abs([*error(point, 1.0), point.mean - 45.0]) < 1.96 * np.sqrt(np.diag(point.covariance))
        widest = max(widest, float(np.sqrt(point.covariance[0, 0])))
    check_coverage(hits, runs)
    assert widest < 0.002  # of a gain of 0.9; without a hole it is 0.0005


def test_says_which_harmonics_lost_samples_hide() -> None:
    whole = log(1.0, periods=2.4, noise=white(1000, 0.05, 1))
    small, large = without(whole, 3.6, 3.62), without(whole, 3.6, 3.8)
    assert sine_point(small, "cmd", "y").harmonics.size == 10
    assert not sine_point(small, "cmd", "y").notes
    point = sine_point(large, "cmd", "y")
    assert point.harmonics.size == 1
    lost = {"begin": pytest.approx(3.596), "end": pytest.approx(3.804), "kept": 1, "count": 10}
    assert dict(noted(point, NoteCode.FEW_HARMONICS).values) == lost
    assert noted(sine_point(without(whole, 3.6, 3.9), "cmd", "y"), NoteCode.NO_HARMONICS)


def test_samples_lost_before_the_fitted_part_do_no_harm() -> None:
    whole = log(1.0, periods=2.4, noise=white(1000, 0.05, 1))
    one, other = (sine_point(record, "cmd", "y").covariance for record in (without(whole, 2.5, 2.8), whole))
    np.testing.assert_allclose(one, other, rtol=1e-4, atol=1e-20)


def test_a_hole_at_the_edge_of_the_fitted_part_counts() -> None:
    point = sine_point(without(log(1.0, periods=2.4, noise=white(1000, 0.05, 1)), 3.2, 3.6), "cmd", "y")
    (lost,) = (note.values for note in point.notes if "begin" in note.values)
    assert (lost["begin"], lost["end"]) == (pytest.approx(3.4), pytest.approx(3.604))  # the part begins at 3.4 s


@seeds(200)
def test_lost_samples_do_not_pass_for_a_drift(runs: int) -> None:
    told = 0
    for seed in range(runs):
        record = without(log(1.0, periods=4.0, noise=white(1100, 0.05, seed)), 5.0, 5.45)
        told += drifts(sine_point(record, "cmd", "y"))
    assert told <= at_most(1e-3, runs)


def test_harmonics_are_found_and_do_not_spoil_the_sine() -> None:
    point = sine_point(log(4.0, add=0.05, noise=white(2000, 0.05, 3)), "cmd", "y")
    assert point.distorted
    assert point.harmonics[1] == pytest.approx(0.05, abs=4 * point.harmonics_noise)
    assert np.max(np.delete(point.harmonics, 1)) < 5 * point.harmonics_noise
    np.testing.assert_allclose(error(point, 4.0), 0.0, atol=4 * np.sqrt(point.covariance[0, 0]))
    assert point.noise.deviation == pytest.approx(0.05, rel=0.1)


@seeds(80)
def test_noise_is_seldom_called_a_harmonic(runs: int) -> None:
    wrong = sum(sine_point(log(4.0, noise=white(2000, 0.5, seed)), "cmd", "y").distorted for seed in range(runs))
    assert wrong <= at_most(1e-3, runs)


@seeds(60)
@pytest.mark.parametrize(("pole", "periods"), [(0.9, 21.2), (0.5, 7.2), (0.9, 4.2), (0.98, 3.2), (0.9, 3.2)])
def test_noise_with_a_memory_is_seldom_called_a_harmonic(pole: float, periods: float, runs: int) -> None:
    """At 1 Hz slow noise is several times as strong as white noise of its size, which nearly always were harmonics."""
    points = [
        sine_point(log(1.0, periods=periods, noise=coloured(6000, 0.5, seed, pole)), "cmd", "y") for seed in range(runs)
    ]
    assert all(point.noise.basis == COLOURED and point.periods == int(periods - 1) for point in points)
    assert sum(point.distorted for point in points) <= at_most(1e-3, runs)


@pytest.mark.parametrize("periods", [21.2, 3.2])
def test_noise_of_the_harmonics_is_that_of_its_spectrum(periods: float) -> None:
    """Of a filter 1 / (1 - p z^-1) driven by white noise: a sine's deviation is sqrt(2 / n) times its gain."""
    pole, fundamental = 0.9, np.abs(response(1.0))
    points = [sine_point(log(1.0, periods=periods, noise=coloured(6000, 0.5, s, pole)), "cmd", "y") for s in range(40)]
    turns = np.arange(2, 12) / 250
    gain = 0.5 * math.sqrt(1 - pole**2) / np.abs(1 - pole * np.exp(-2j * np.pi * turns))
    truth = math.sqrt(2 / (250 * points[0].periods) * float(np.mean(gain**2))) / (10 * fundamental)
    assert np.mean([point.harmonics_noise for point in points]) == pytest.approx(truth, rel=0.12)


def test_harmonics_are_found_in_noise_with_a_memory() -> None:
    noise = coloured(6000, 0.5, 3)
    point = sine_point(log(1.0, periods=21.2, add=0.05, noise=noise), "cmd", "y")
    assert point.noise.basis == COLOURED
    assert point.distorted
    assert point.harmonics[1] == pytest.approx(0.05, abs=4 * point.harmonics_noise)


def coarse(frequency: float, rate: float, periods: float, seed: int) -> MeasuredRecord:
    """A noisy sine of few samples."""
    time = np.arange(round(periods * rate / frequency) + 1) / rate
    sine = np.sin(2 * np.pi * frequency * time)
    values = np.column_stack([50 + 10 * sine, 40 + 9 * sine + white(time.size, 0.5, seed)])
    return MeasuredRecord(
        "few", "frequency-response", "fit", Record(time, values, ("cmd", "y"), ("%", "deg")), 50, 10, frequency
    )


@seeds(400)
@pytest.mark.parametrize("declared", [None, 0.5])
def test_noise_of_few_samples_is_seldom_called_a_harmonic_or_a_drift(declared: float | None, runs: int) -> None:
    one = [sine_point(coarse(0.5, 20.0, 1.9, seed), "cmd", "y", noise=declared) for seed in range(runs)]
    assert all(point.periods == 1 and point.harmonics.size == 10 for point in one)
    assert sum(point.distorted for point in one) <= at_most(1e-3, runs)
    two = [sine_point(coarse(1.0, 13.0, 3.2, seed), "cmd", "y", noise=declared) for seed in range(runs)]
    assert all(point.periods == 2 for point in two)
    assert sum(map(drifts, two)) <= at_most(1e-3, runs)


def test_whole_periods_behind_the_transients_are_fitted() -> None:
    assert sine_point(log(4.0, periods=10.6), "cmd", "y").periods == 8  # half a second is two periods
    assert sine_point(log(0.5, periods=3.0), "cmd", "y").periods == 2
    assert sine_point(log(4.0, periods=10.0), "cmd", "y", window=Window(0.0, 0.0)).periods == 10


def test_says_when_transients_may_be_in_it_and_when_it_is_not_steady() -> None:
    short = sine_point(log(0.5, periods=1.4), "cmd", "y")
    assert short.periods == 1
    assert noted(short, NoteCode.TRANSIENTS).values["seconds"] == pytest.approx(0.8, abs=0.01)
    record = log(4.0, periods=20.0, noise=white(2000, 0.01, 5))
    assert isinstance(record.data, Record)
    assert sine_point(record, "cmd", "y").notes == ()
    values = np.array(record.data.values)
    values[:, 1] = 45 + (values[:, 1] - 45) * np.linspace(1.0, 1.02, values.shape[0])
    growing = replace(record, data=replace(record.data, values=values))
    assert drifts(sine_point(growing, "cmd", "y"))


def test_says_when_residuals_have_a_memory() -> None:
    point = sine_point(log(5.0, noise=coloured(1100, 0.5, 1)), "cmd", "y")
    assert noted(point, NoteCode.MEMORY)
    naive = 2 * point.noise.deviation**2 / 875 / 100
    assert point.covariance[0, 0] > 2 * naive


@seeds(100)
def test_slow_noise_is_seen_in_a_single_period(runs: int) -> None:
    """The harmonics take it out of what is left over, and then are what shows it; else one in six is held."""
    held = np.zeros(2)
    for seed in range(runs):
        point = sine_point(log(1.0, periods=2.4, noise=coloured(601, 0.5, seed)), "cmd", "y")
        assert point.periods == 1
        held += np.abs(error(point, 1.0)) < 1.96 * np.sqrt(np.diag(point.covariance)[:2])
    assert held.min() >= at_least(0.92, runs)
    assert noted(point, NoteCode.MEMORY_IN_HARMONICS)


def noted(point: SinePoint, code: NoteCode) -> Note:
    """The one note of that code."""
    (note,) = (one for one in point.notes if one.code is code)
    return note


def drifts(point: SinePoint) -> bool:
    return any(note.code is NoteCode.DRIFTING for note in point.notes)


def refused(record: MeasuredRecord, words: str) -> None:
    with pytest.raises(BadInput, match=words):
        sine_point(record, "cmd", "y")


def test_refuses_what_gives_no_response() -> None:
    refused(log(0.5, periods=0.8), r"holds 0\.8 periods of 0\.5 Hz")
    record = log(4.0)
    assert isinstance(record.data, Record)
    values = np.array(record.data.values)
    values[:, 1] = 3.0
    refused(replace(record, data=replace(record.data, values=values)), "does not move at 4 Hz")
    refused(
        without(log(1.0, periods=2.4), 3.5, 4.0), r"1Hz.txt: no samples from 3.496 to 4.004 s, and .* record it again"
    )
    for wrong in (-1.0, math.inf, math.nan):
        with pytest.raises(BadInput, match=f"settle_periods is {wrong:g}; it must be finite and not negative"):
            Window(wrong)


def test_a_part_too_short_to_fit_is_refused_by_its_name_and_with_a_cure() -> None:
    record = log(20.0)
    with pytest.raises(BadInput, match=r"1[23] samples of 1 period behind .* do not show 20 Hz; shorten the settling"):
        sine_point(record, "cmd", "y", window=Window(settle_periods=1e6))
