"""Chirp analysis against the closed form of a linear system, whose tops and bottoms answer alike."""

import math
from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from pysim.identify.chirp import Branch, ChirpAnalysis, analyse_chirp, chirp_responses, sweep_error
from pysim.types import BadInput, Dataset, MeasuredRecord, MeasuredSignal, Record
from pysim.types.note import NoteCode
from tests.pysim.identify.chirp.chirps import log, response

SIGNALS = (MeasuredSignal("u", "input", "%", "", "u"), MeasuredSignal("y", "output", "%", "", "y", 0.3))


@cache
def analysed(rate: float, **system: float) -> ChirpAnalysis:
    """Of a log of `chirps.log`."""
    return analyse_chirp(log(rate, **system), "u", "y")  # type: ignore[arg-type]


def errors(branch: Branch, *, low: float = 0.0, high: float = 20.0, **system: float) -> np.ndarray:
    """Magnitude (dB) and phase (deg) minus the truth, (2, n)."""
    truth = response(branch.frequency, **system)
    degrees = branch.phase_deg - np.degrees(np.angle(truth))
    inside = (branch.frequency >= low) & (branch.frequency <= high)
    return np.array([branch.magnitude_db - 20 * np.log10(np.abs(truth)), (degrees + 180) % 360 - 180])[:, inside]


@pytest.mark.parametrize("down", [False, True], ids=["up", "down"])
def test_a_slow_sweep_gives_the_closed_form(down: bool) -> None:
    found = analysed(0.5, down=down)
    assert np.max(np.abs(errors(found.mean)[0])) < 0.02
    assert np.max(np.abs(errors(found.mean)[1])) < 0.25
    for branch in (found.top, found.bottom):
        assert np.max(np.abs(errors(branch)[0])) < 0.05
    assert (np.diff(found.mean.frequency) > 0).all()
    assert found.mean.frequency[0] < 1.3  # sqrt(2.5 rate) = 1.12 Hz is the first pair's second extreme


@pytest.mark.parametrize(("rate", "damping"), [(0.5, 0.6), (1.0, 0.2), (0.5, 0.1)])
def test_the_error_stays_below_that_of_the_sweep(rate: float, damping: float) -> None:
    found = analysed(rate, damping=damping)
    share = sweep_error(rate, 8.0, damping)
    decibel, degrees = np.max(np.abs(errors(found.mean, low=2.0, damping=damping)), axis=1)
    assert decibel < 20 * np.log10(1 + share)
    assert degrees < np.degrees(share) + 0.2


def test_a_lag_of_several_turns_is_followed() -> None:
    found = analysed(0.5, delay=0.15)
    assert found.mean.phase_deg[-1] < -1300  # 0.15 s at 25 Hz alone are 1350 degrees
    unwrapped = np.unwrap(np.angle(response(np.linspace(0.01, 20, 4000), delay=0.15)))
    at20 = np.interp(20.0, found.mean.frequency, found.mean.phase_deg)
    assert at20 == pytest.approx(np.degrees(unwrapped[-1]), abs=1.5)


def test_intervals_hold_what_noise_does() -> None:
    inside = np.zeros(2)
    total = 0
    for seed in range(3):
        found = analyse_chirp(log(1.0, noise=0.3, seed=seed), "u", "y", noise=0.3)
        off = np.abs(errors(found.mean, low=2.0))
        here = (found.mean.frequency >= 2.0) & (found.mean.frequency <= 20.0)
        sigma = [found.mean.magnitude_deviation_db[here], np.degrees(found.mean.phase_deviation[here])]
        inside += np.sum(off <= 1.96 * np.array(sigma), axis=1)
        total += off.shape[1]
    assert (inside / total >= 0.94).all()  # the doubts of a pair are bounded, not combined: more than 95 percent
    for branch in (found.top, found.bottom):
        off = errors(branch, low=2.0)
        here = (branch.frequency >= 2.0) & (branch.frequency <= 20.0)
        assert np.std(off[0] / branch.magnitude_deviation_db[here]) == pytest.approx(1.0, abs=0.25)
        assert np.std(off[1] / np.degrees(branch.phase_deviation[here])) == pytest.approx(1.0, abs=0.25)


def test_the_level_is_taken_off() -> None:
    at_zero = analysed(2.0, offset=0.0)
    raised = analysed(2.0, offset=70.0)
    np.testing.assert_allclose(raised.mean.gain, at_zero.mean.gain, rtol=1e-4)
    other = analyse_chirp(log(2.0, offset=70.0), "u", "y", level=69.0)
    slow = other.top.frequency < 3
    np.testing.assert_allclose(other.top.gain[slow], raised.top.gain[slow] + 0.1, atol=1e-4)
    np.testing.assert_allclose(other.bottom.gain[slow], raised.bottom.gain[slow] - 0.1, atol=1e-4)


def test_different_units_need_a_level() -> None:
    record = log(2.0)
    radians = replace(record, data=replace(record.data, units=("%", "rad")))
    with pytest.raises(
        BadInput, match="y is in rad and u in %; give the level that y has at the command's offset of 50 %"
    ):
        analyse_chirp(radians, "u", "y")
    found = analyse_chirp(radians, "u", "y", level=50.0)
    np.testing.assert_allclose(found.mean.gain, analysed(2.0).mean.gain, rtol=1e-4)


def test_a_slow_logger_still_shows_the_response() -> None:
    found = analysed(1.0, sampling=80)  # 3.2 samples per period at the end
    assert np.max(np.abs(errors(found.mean, low=2.0)[0])) < 0.1
    assert np.max(np.abs(errors(found.mean, low=2.0)[1])) < 1.0


def test_stops_where_tops_are_lost_in_noise() -> None:
    found = analysed(1.0, natural_hz=2.0, noise=0.5, stop_hz=40.0)
    (lost,) = (note for note in found.notes if note.code is NoteCode.LOST_IN_NOISE)
    assert found.mean.frequency[-1] <= float(lost.values["frequency"]) < 40.0
    assert 6.0 < found.mean.frequency[-1] < 35.0
    assert np.max(np.abs(errors(found.mean, low=3.0, natural_hz=2.0)[0])) < 6.0


def test_notes_name_the_fast_start_and_the_few_samples() -> None:
    found = analysed(1.0, sampling=125)
    values = {note.code: note.values for note in found.notes}
    assert values[NoteCode.FAST_SWEEP]["frequency"] == pytest.approx(math.sqrt(2.0), rel=0.01)
    assert values[NoteCode.FEW_SAMPLES]["samples"] == pytest.approx(5.0, abs=0.05)


def test_the_mean_is_a_frequency_response() -> None:
    found = analysed(2.0, noise=0.1)
    response_, places = found.response, list(found.apart)
    np.testing.assert_allclose(response_.gain, np.sqrt(found.top.gain * found.bottom.gain)[places])
    np.testing.assert_allclose(response_.frequency, 0.5 * (found.top.frequency + found.bottom.frequency)[places])
    sigma = np.sqrt(response_.covariance[:, 0, 0]) / response_.test.amplitude
    np.testing.assert_allclose(sigma, found.mean.gain_deviation[places])


def _memory(gains: list[np.ndarray]) -> float:
    """Correlation of what noise does to neighbours, over many logs of one sweep."""
    off = np.array(gains) - np.mean(gains, axis=0)
    off /= np.std(off, axis=0)
    return float(np.mean(off[:, 1:] * off[:, :-1]))


@pytest.mark.parametrize("down", [False, True])
def test_points_of_the_response_do_not_share_their_noise(down: bool) -> None:
    """A fit counts them as independent; the means of all pairs are not, where the sweep is slow."""
    record = log(0.5, stop_hz=12.0, down=down)
    assert isinstance(record.data, Record)
    found = []
    for seed in range(12):
        values = np.array(record.data.values)
        values[:, 1] += 0.2 * np.random.default_rng(seed).standard_normal(values.shape[0])
        found.append(analyse_chirp(replace(record, data=replace(record.data, values=values)), "u", "y"))
    assert {one.apart for one in found} == {found[0].apart}
    assert abs(_memory([one.response.gain for one in found])) < 0.15  # three times 1 / sqrt(12 logs of 35 points)
    assert _memory([one.mean.gain for one in found]) > 0.4


def test_every_chirp_of_a_data_set_is_analysed() -> None:
    records = (log(2.0), replace(log(2.0), kind="other"), log(3.0))
    found = chirp_responses(Dataset("d", "", "", SIGNALS, records))
    assert [round(one.command.rate, 6) for one in found] == [2.0, 3.0]
    assert found[0].noise >= 0.3  # as declared


def test_refuses_what_is_no_chirp() -> None:
    with pytest.raises(BadInput, match='its kind is "step"'):
        analyse_chirp(replace(log(2.0), kind="step"), "u", "y")
    with pytest.raises(BadInput, match='no log of kind "chirp"'):
        chirp_responses(Dataset("d", "", "", SIGNALS, ()))
    record = log(2.0, stop_hz=10.0)
    noise = np.column_stack([record.data["u"], np.random.default_rng(0).standard_normal(record.data.time.size)])
    with pytest.raises(BadInput, match="rises above the noise"):
        analyse_chirp(replace(record, data=replace(record.data, values=noise)), "u", "y")


def without(record: MeasuredRecord, begin: float, end: float) -> MeasuredRecord:
    """The same log with the samples between two times lost."""
    data = record.data
    assert isinstance(data, Record)
    kept = (data.time < begin) | (data.time > end)
    return replace(record, data=replace(data, time=data.time[kept], values=data.values[kept]))


def test_lost_samples_are_no_slow_sampling_and_leave_out_what_they_hide() -> None:
    whole = log(0.5, noise=0.1)
    found, full = (analyse_chirp(record, "u", "y") for record in (without(whole, 5.0, 6.0), whole))
    assert [note.code for note in found.notes] == [note.code for note in full.notes] == [NoteCode.FAST_SWEEP]
    assert full.mean.frequency.size - 4 <= found.mean.frequency.size < full.mean.frequency.size
    off = np.abs(errors(found.mean, low=1.5))
    assert np.max(off[0] / found.mean.magnitude_deviation_db[found.mean.frequency >= 1.5][: off.shape[1]]) < 6


@pytest.mark.parametrize(
    ("down", "begin", "lost"),
    [(False, 15.0, 1.0), (True, 15.0, 1.0), (False, 30.0, 0.05), (True, 30.0, 0.4), (False, 40.0, 1.0)],
)
def test_turns_that_lost_samples_hide_are_counted(down: bool, begin: float, lost: float) -> None:
    found = analyse_chirp(without(log(0.5, down=down), begin, begin + lost), "u", "y")
    assert found.command.rate == pytest.approx(-0.5 if down else 0.5, rel=1e-6)
    assert np.max(np.abs(errors(found.mean)[0])) < 0.05
    assert np.max(np.abs(errors(found.mean)[1])) < 0.5


def test_a_refusal_names_samples_that_are_lost() -> None:
    whole = log(0.5)
    assert isinstance(whole.data, Record)
    values = np.array(whole.data.values)
    values[:, 0] += np.cumsum(np.random.default_rng(0).standard_normal(values.shape[0]))
    with pytest.raises(BadInput, match=r"not a chirp: .*; or cut it where samples are lost, from 29.996 to 30.404 s$"):
        analyse_chirp(without(replace(whole, data=replace(whole.data, values=values)), 30.0, 30.4), "u", "y")
