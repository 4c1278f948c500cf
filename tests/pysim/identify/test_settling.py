"""Settling, with a first-order lag whose transient is known in closed form."""

from collections.abc import Sequence

import numpy as np
import pytest

from pysim.identify import SteadyRun, SteppedSine, frequency_response, run_until_settled, stepped_sine
from pysim.types import Experiment, Outcome, Record, SineTest

TEST = SineTest(50.0, 5.0, "cmd", "y")
PLAN = SteppedSine()


def lag(experiment: Experiment, constant: float) -> Record:
    """What der(y) = (cmd - y) / constant answers to rest, ramp, hold and sine, at times after the sine's start."""
    amplitude, _, omega, _ = experiment.inputs["cmd"].sines[-1, 0]
    offset, onset = experiment.inputs["cmd"].cubics[-1, 0], PLAN.onset
    ramped = offset / PLAN.ramp * (PLAN.ramp - constant * (1 - np.exp(-PLAN.ramp / constant)))
    held = offset + (ramped - offset) * np.exp(-PLAN.hold / constant)
    g = 1 / (1 + 1j * omega * constant)
    transient = held - offset - amplitude * g.imag
    t = experiment.times - onset
    y = offset + amplitude * (g * np.exp(1j * omega * t)).imag + transient * np.exp(-t / constant)
    return Record(experiment.times, y[:, None], ("y",), ("%",))


def settle(
    frequencies: Sequence[float], constant: float, plan: SteppedSine = PLAN
) -> tuple[tuple[SteadyRun, ...], list[int]]:
    """The runs, and how many experiments each attempt took."""
    attempts: list[int] = []

    def run(experiments: Sequence[Experiment]) -> list[Record]:
        attempts.append(len(experiments))
        return [lag(experiment, constant) for experiment in experiments]

    tests = [(TEST, f) for f in frequencies]
    return run_until_settled(tests, lambda t, f, p: stepped_sine(t, f, plan=p), run, plan), attempts


def test_a_slow_output_gets_the_time_it_needs() -> None:
    frequencies, constant = (0.1, 1.0, 10.0, 30.0), 0.5
    runs, attempts = settle(frequencies, constant)
    assert not any(run.trouble for run in runs)
    assert attempts[0] == 4
    assert 1 < len(attempts) < 6
    assert all(later < 4 for later in attempts[1:])  # 0.1 Hz has settled at once
    response = frequency_response([run.record for run in runs], frequencies, TEST, onset=PLAN.onset)
    g = 1 / (1 + 2j * np.pi * np.array(frequencies) * constant)
    np.testing.assert_allclose(20 * np.log10(response.gain), 20 * np.log10(np.abs(g)), atol=0.1)
    np.testing.assert_allclose(np.degrees(response.phase), np.degrees(np.angle(g)), atol=0.6)


def test_without_the_check_the_same_output_would_be_wrong() -> None:
    early = lag(stepped_sine(TEST, 10.0), 0.5)
    response = frequency_response([early], [10.0], TEST, onset=PLAN.onset)
    assert abs(np.degrees(response.phase[0]) - np.degrees(np.angle(1 / (1 + 10j * np.pi)))) > 5.0


def test_a_fast_output_is_run_once_and_fitted_over_the_planned_periods() -> None:
    runs, attempts = settle((0.1, 30.0), 0.02)
    assert attempts == [2]
    for run, f in zip(runs, (0.1, 30.0), strict=True):
        np.testing.assert_array_equal(run.record.time, stepped_sine(TEST, f).times)


def test_an_output_that_needs_too_long_is_given_up_in_words() -> None:
    runs, attempts = settle((10.0,), 50.0, SteppedSine(settle_limit=4.0))
    assert runs[0].trouble == "the output has not settled after 4 s of the sine"
    assert len(attempts) == 4  # 0.5, 1, 2 and 4 s


@pytest.mark.parametrize("level", [0.0, 48.3])
def test_an_output_that_stands_still_is_named_at_once(level: float) -> None:
    def still(experiments: Sequence[Experiment]) -> list[Record]:
        return [Record(e.times, np.full((e.times.size, 1), level), ("y",), ("%",)) for e in experiments]

    (run,) = run_until_settled([(TEST, 2.0)], lambda t, f, p: stepped_sine(t, f, plan=p), still, PLAN)
    assert run.trouble == "y does not move; there is no response to compare"


def test_a_run_that_stopped_says_why() -> None:
    def stopped(experiments: Sequence[Experiment]) -> list[Record]:
        return [Record(np.zeros(0), np.zeros((0, 1)), ("y",), ("%",), Outcome.NOT_FINITE, "at t = 1 s")]

    (run,) = run_until_settled([(TEST, 2.0)], lambda t, f, p: stepped_sine(t, f, plan=p), stopped, PLAN)
    assert run.trouble == "a value is no longer finite. at t = 1 s"
