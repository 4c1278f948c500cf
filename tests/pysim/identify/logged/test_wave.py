"""Waves fitted to logged commands, against the commands that were logged."""

from dataclasses import replace

import numpy as np
import pytest

from pysim.excitation import Chirp, LeadIn, SteppedSineCommand, StochasticWave
from pysim.excitation import PiersonMoskowitz as Sea
from pysim.identify import LoggedWave, logged_wave
from pysim.types import BadInput, FrequencyResponse, MeasuredRecord, Record, SineTest
from tests.pysim.identify.logs import log

CHIRP = Chirp(50.0, 10.0, 0.1, 30.0, 30.0)
SINES = [SteppedSineCommand(-50.0, 10.0, f, periods=max(2, round(1.2 * f))) for f in (0.1, 1.0, 13.0, 30.0)]


def error(wave: LoggedWave, test: object, n: int = 4001) -> float:
    """Largest difference from the command, between samples too."""
    t = np.linspace(wave.start, wave.end, n)[:-1]
    return float(np.max(np.abs(wave.value(t) - test.signal().value(t))))  # type: ignore[attr-defined]


@pytest.mark.parametrize("sine", SINES, ids=lambda s: f"{s.frequency:g} Hz")
@pytest.mark.parametrize("whole", [False, True], ids=["sine only", "with lead-in and ramp"])
def test_rounded_sine_is_found_to_its_rounding(sine: SteppedSineCommand, whole: bool) -> None:
    bounds = {"first": 0.0, "last": sine.duration} if whole else {}
    wave = logged_wave(log(sine, "frequency-response", frequency=sine.frequency, **bounds), "cmd")
    assert (wave.offset, wave.amplitude) == pytest.approx((-50.0, 10.0), abs=1e-5)
    assert error(wave, sine) < 2e-5
    assert (wave.frequency, wave.rate) == (pytest.approx(sine.frequency), 0.0)
    if whole:
        assert wave.start == pytest.approx(2.0, abs=1e-6)  # where the hold meets the sine, not merely a sample
        assert sine.end - 0.0041 <= wave.end <= sine.end + 0.02


@pytest.mark.parametrize("rate", [250.0, 1000.0])
@pytest.mark.parametrize("decimals", [9, 12, 15])
def test_a_log_without_noise_is_found_behind_its_lead_in(decimals: int, rate: float) -> None:
    for frequency in (0.3, 1.0, 2.0, 5.0, 20.0):
        sine = SteppedSineCommand(25.0, 10.0, frequency, periods=max(3, round(3 * frequency)))
        bounds = {"first": 0.0, "last": sine.duration, "rate": rate}
        record = log(sine, "frequency-response", frequency=frequency, decimals=decimals, **bounds)  # type: ignore[arg-type]
        wave = logged_wave(record, "cmd")
        assert (wave.offset, wave.amplitude) == pytest.approx((25.0, 10.0), rel=1e-5)


@pytest.mark.parametrize("whole", [False, True], ids=["chirp only", "with lead-in and ramp"])
@pytest.mark.parametrize("chirp", [CHIRP, Chirp(-30.0, 20.0, 25.0, 0.5, 20.0)], ids=["upwards", "downwards"])
def test_rounded_chirp_is_found_to_its_rounding(chirp: Chirp, whole: bool) -> None:
    bounds = {"first": 0.0, "last": chirp.duration} if whole else {}
    wave = logged_wave(log(chirp, "chirp", **bounds), "cmd")
    assert error(wave, chirp) < 2e-5
    assert wave.frequency == pytest.approx(chirp.start_hz, abs=1e-6)
    assert wave.rate == pytest.approx(chirp.rate, rel=1e-7)
    assert wave.start == pytest.approx(2.0, abs=1e-6)
    assert np.max(np.abs(wave.frequency_at(np.array([2.0, chirp.end])) - [chirp.start_hz, chirp.stop_hz])) < 1e-6


@pytest.mark.parametrize("test", [SINES[2], CHIRP], ids=["sine", "chirp"])
@pytest.mark.parametrize("way", [{"step": 0.0586}, {"noise": 0.1}, {"noise": 0.05, "step": 0.0586}, {"jitter": 2e-5}])
def test_quantised_noisy_and_late_samples_average_out(test: SteppedSineCommand | Chirp, way: dict[str, float]) -> None:
    kind, f = ("chirp", None) if isinstance(test, Chirp) else ("frequency-response", test.frequency)
    record = log(test, kind, frequency=f, first=0.5, last=test.end + 0.2, seed=8, **way)
    wave = logged_wave(record, "cmd")
    samples = (wave.end - wave.start) * 250
    spread = way.get("noise", 0.0) + way.get("step", 0.0) / np.sqrt(12) + 10 * 2 * np.pi * 30 * way.get("jitter", 0.0)
    assert error(wave, test) < 10 * spread / np.sqrt(samples)


def test_intervals_cover_the_truth() -> None:
    hits = np.zeros(2)
    for seed in range(200):
        wave = logged_wave(log(SINES[2], "frequency-response", frequency=13.0, noise=0.2, seed=seed), "cmd")
        sigma = np.sqrt(np.diag(wave.covariance))
        hits += np.abs([wave.amplitude - 10.0, wave.phase - 2 * np.pi * 13.0 * (wave.start - 2.0)]) < 1.96 * sigma
    assert (np.abs(hits / 200 - 0.95) < 3.3 * np.sqrt(0.95 * 0.05 / 200)).all()


def test_a_commensurate_sampling_is_not_taken_for_a_converter() -> None:
    sine = SteppedSineCommand(50.0, 10.0, 25.0, periods=30)  # ten samples a period, the same ones in each
    wave = logged_wave(log(sine, "frequency-response", frequency=25.0), "cmd")
    assert np.sqrt(wave.covariance[0, 0]) < 1e-6
    assert error(wave, sine) < 1e-5


def test_a_disturbed_sample_is_passed_over() -> None:
    record = log(CHIRP, "chirp")
    values = np.array(record.data.values)  # type: ignore[union-attr]
    values[[700, 5000]] += 3.0
    wave = logged_wave(replace(record, data=replace(record.data, values=values)), "cmd")
    assert error(wave, CHIRP) < 2e-5


def refused(record: MeasuredRecord, words: str) -> None:
    with pytest.raises(BadInput, match=words):
        logged_wave(record, "cmd")


def test_refuses_a_sine_of_another_frequency() -> None:
    for f in (12.8, 6.5, 26.0):
        refused(log(SINES[2], "frequency-response", frequency=f), "not a sine of|not this any more|still swings")
    refused(log(SINES[2], "frequency-response"), "needs its frequency")


def test_refuses_what_is_no_wave() -> None:
    wave = StochasticWave(Sea(100.0, 1.0), 30.0, seed=3)
    refused(log(wave, "chirp"), "not a chirp")
    refused(log(wave, "frequency-response", frequency=1.0), "not a sine of 1 Hz")
    refused(log(CHIRP, "frequency-response", frequency=1.0), "1 Hz")
    refused(log(SteppedSineCommand(0.0, 1.0, 0.1, periods=1.2), "chirp"), "swings less than three times")
    refused(log(CHIRP, "stochastic"), "has no closed form")


def test_refuses_a_clipped_sine_and_a_triangle() -> None:
    record = log(SINES[2], "frequency-response", frequency=13.0)
    values = record.data.values  # type: ignore[union-attr]
    refused(replace(record, data=replace(record.data, values=np.minimum(values, -41.5))), "more than rounding")
    triangle = np.arcsin(np.clip((values + 50) / 10, -1, 1))
    refused(replace(record, data=replace(record.data, values=triangle)), "more than rounding")


def test_refuses_a_log_without_motion_or_without_time() -> None:
    still = Record(np.arange(20) / 250, np.full((20, 1), 3.0), ("cmd",), ("%",), origin="measured")
    refused(MeasuredRecord("a.txt", "chirp", "fit", still), "20 samples and moves by 0")
    table = FrequencyResponse([1.0], [1.0], [0.0], SineTest(0.0, 1.0, "u", "y"), "measured")  # type: ignore[arg-type]
    refused(MeasuredRecord("a.txt", "chirp", "fit", table), "over frequency")


def test_no_lead_in_starts_at_the_first_sample() -> None:
    late = log(SINES[0], "frequency-response", frequency=0.1, first=5.3)
    wave = logged_wave(late, "cmd")
    assert wave.start == 5.3
    assert wave.phase == pytest.approx(2 * np.pi * 0.1 * 3.3, abs=1e-6)
    assert LeadIn().onset == 2.0


@pytest.mark.parametrize("seed", range(40))
def test_waves_of_all_kinds_are_found(seed: int) -> None:
    """Drawn tests: sampling, lead-in, noise, quantisation, direction; the log whole, or the wave alone."""
    draw = np.random.default_rng(seed)
    offset, amplitude, rate = draw.uniform(-80, 80), 10 ** draw.uniform(-0.3, 1.5), float(draw.choice([70, 250, 1000]))
    lead = LeadIn(draw.uniform(0, 1), draw.uniform(0.1, 1), draw.uniform(0.05, 2), draw.uniform(0, 1))
    noise, step = float(draw.choice([0.0, 0.002, 0.01])) * amplitude, float(draw.choice([0.0, 0.01])) * amplitude
    fastest, frequency = min(30.0, rate / 2.5), None
    test: SteppedSineCommand | Chirp
    if draw.random() < 0.4:
        frequency = 10 ** draw.uniform(-1, np.log10(fastest))
        test = SteppedSineCommand(offset, amplitude, frequency, max(2.0, 2 * frequency), lead)
    else:
        ends = draw.permutation([draw.uniform(0, 2), draw.uniform(5, fastest)])
        test = Chirp(offset, amplitude, *ends, draw.uniform(10, 40), lead)
    bounds = {"first": 0.0, "last": test.duration} if draw.random() < 0.6 else {}
    kind = "chirp" if frequency is None else "frequency-response"
    record = log(test, kind, frequency=frequency, rate=rate, noise=noise, step=step, seed=seed, **bounds)
    wave = logged_wave(record, "cmd")
    found = replace(wave, start=max(wave.start, test.onset), end=min(wave.end, test.end))
    assert (found.end - found.start) > 0.97 * (test.end - test.onset)
    t = np.linspace(found.start, found.end, 3001)[:-1]
    off = np.max(np.abs(wave.value(t) - test.signal().value(t)))
    # at the ends of a parabola of phase the standard deviation is 3 sqrt(2) sigma / sqrt(n)
    assert off < max(5e-5, 4.5 * 3 * np.sqrt(2) * (noise + step) / np.sqrt((found.end - found.start) * rate))
