"""A stepped sine that has not settled is told from one that has, and compared as what it is: a log over time."""

from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray

from pysim.identify.greybox import Parameter, Simulation, SinePlan, Treatment, fit, problem
from pysim.identify.greybox.sine_log import Sine, SineLog, sine_log
from pysim.simulate import Esdirk
from pysim.types import MeasuredRecord, Model, NoteCode, Record
from tests.pysim.identify.greybox import measurements as m
from tests.pysim.identify.seeds import seeds

F, RATE, TOLD = 2.0, 100.0, 0.02


def swing(drift: float, seed: int | None = None, *, seconds: float = 4.0) -> SineLog:
    """A sine from time 7 on beside a mean that decays with 1 s, with white noise where there is a seed for it."""
    time = 7 + np.arange(round(seconds * RATE)) / RATE
    values = 3 * np.sin(2 * np.pi * F * (time - 7) - 0.4) + drift * np.exp(-(time - 7))
    if seed is not None:
        values = values + TOLD * np.random.default_rng(seed).standard_normal(time.size)
    data = Record(time, values[:, None], ("y",), ("1",))
    return sine_log("2Hz.txt", data, Sine(0.0, 1.0, F, -2 * np.pi * F * 7, 7.0, 11.0), (TOLD,), SinePlan(), index=0)


@seeds(400)
def test_a_drift_is_seen_where_the_noise_lets_it_be(runs: int) -> None:
    still = [swing(0.0, seed).unlike for seed in range(runs)]
    assert max(still) < 5.0
    assert 1.0 < np.median(still) < 2.5  # the largest of eleven normal numbers
    assert max(swing(1e-3, seed).unlike for seed in range(20)) < 5.0
    assert min(swing(0.2, seed).unlike for seed in range(20)) > 5.0


def test_a_transient_of_two_samples_is_seen() -> None:
    """Too short for any harmonic, and larger than what they leave of the first period: 50 and 20 noises."""
    still = swing(0.0, 1)
    values = still.measured.values.copy()
    values[:2, 0] += TOLD * np.array([50.0, 20.0])
    assert still.unlike < 5.0 < replace(still, measured=replace(still.measured, values=values)).unlike


def test_one_period_has_no_other_to_be_compared_with() -> None:
    assert swing(5.0, seconds=1.0).unlike == 0.0
    assert swing(5.0, seconds=1.6).unlike > 5.0


def test_harmonics_that_stand_out_are_compared_beyond_those_that_always_are() -> None:
    time = np.arange(400) / RATE
    noise = TOLD * np.random.default_rng(1).standard_normal(time.size)
    for highest, count in ((3, 5), (9, 9), (30, 5)):
        values = np.sin(2 * np.pi * F * time) + 0.1 * np.sin(2 * np.pi * F * highest * time + 1) + noise
        data = Record(time, values[:, None], ("y",), ("1",))
        log = sine_log("2Hz.txt", data, Sine(0.0, 1.0, F, 0.0, 0.0, 4.0), (TOLD,), SinePlan(), index=0)
        assert log.count == count


def started(K: float, T: float, f: float) -> MeasuredRecord:
    """The lag from rest, from the moment on when the sine begins."""
    t = np.arange(0, 3.0, 0.01)
    gain, angle = K / (1 + 2j * np.pi * f * T), 2 * np.pi * f * t
    steady: NDArray[np.float64] = K + 2 * np.abs(gain) * np.sin(angle + np.angle(gain))
    y = steady - steady[0] * np.exp(-t / T)
    data = Record(t, np.column_stack([1 + 2 * np.sin(angle), y]), ("w", "y"), ("1", "1"))
    return MeasuredRecord(f"{f:g}Hz.txt", "frequency-response", "fit", data, 1.0, 2.0, f)


def found(lag: Model, steady: str, *domains: str) -> list[float]:
    records = [started(2.0, 1.5, f) for f in (1.0, 2.0)]
    treatment = Treatment(rest=None, sine=SinePlan(settle_time=0.5), steady=steady, reference_hz=None)
    parameters = [Parameter("K", 1.5, 0.1, 10.0), Parameter("T", 0.7, 0.01, 5.0)]
    given = problem(lag, [m.dataset(records)], parameters, treatment=treatment)
    assert [one.kind for one in given.observations] == ["frequency-response"] * len(given.observations)
    assert [one.domain for one in given.observations] == list(domains)
    assert (NoteCode.NOT_SETTLED in [note.code for note in given.notes]) == ("time" in domains)
    answer = fit(given, simulation=Simulation(solver=Esdirk(rtol=1e-8, atol=1e-8)))
    return [estimate.value for estimate in answer.estimates]


def test_the_closed_form_of_a_lag_that_is_still_on_its_way_is_found(lag: Model) -> None:
    assert found(lag, "transient", "time", "time") == pytest.approx([2.0, 1.5], rel=1e-3)
    assert found(lag, "orbit", "frequency")[0] < 1.9  # a steady swing has another mean
