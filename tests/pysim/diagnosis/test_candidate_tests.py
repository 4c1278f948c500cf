"""Tests stay within what a bench has run, and the plan is the test."""

from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np
import pytest

from pysim.bench import read_plan
from pysim.diagnosis import settings as numbers
from pysim.diagnosis.candidate_tests import CandidateTest, candidate_tests, plan_text
from pysim.types import BadInput, Dataset, Experiment, MeasuredSignal, Model
from tests.pysim.diagnosis.plants import measured, variants

SETTINGS = numbers.TestSettings()


@cache
def data() -> Dataset:
    return measured("mass", length=12.0)


def model() -> Model:
    return variants("mass").build(())[0]


def ran(low: float, high: float) -> Dataset:
    """One log whose command goes from low to high."""
    (record, *_) = data().records
    command, values = record.data["F"], record.data.values.copy()
    place = record.data.names.index("F")
    values[:, place] = np.interp(command, [command.min(), command.max()], [low, high])
    return replace(data(), records=(replace(record, data=replace(record.data, values=values)),))


def test_no_test_goes_beyond_what_was_run() -> None:
    ends = [float(end) for r in data().logs() for end in (r.data["F"].min(), r.data["F"].max())]
    tests = candidate_tests(data(), lambda run: 2.46, model(), SETTINGS)
    assert len({(t.offset, t.amplitude, t.frequency) for t in tests}) == len(tests)
    for test in tests:
        run = test.experiment(model(), ("x",), {})
        assert run.times.size == test.samples >= 300
        assert test.command.onset == 1 + 2.5
        command = run.inputs["F"].value(np.linspace(0, test.seconds, 2000))
        assert min(ends) * (1 + 1e-9) <= command.min() < command.max() <= max(ends) * (1 + 1e-9)
    assert {t.offset > 0 for t in tests} == {True, False}
    assert {t.periods > 0 for t in tests} == {True, False}


@pytest.mark.parametrize(
    ("low", "high", "offsets", "amplitudes", "wave"),
    [
        (-8.0, 8.0, [-6.0, -2.0, 2.0, 6.0], [0.4, 2.0], [(0.0, 6.4)]),
        (0.0, 8.0, [2.0, 6.0], [0.4, 2.0], []),
        (-10.0, 0.0, [-7.5, -2.5], [0.5, 2.5], []),
        (60.0, 100.0, [70.0, 90.0], [2.0, 10.0], []),
        (-100.0, -60.0, [-90.0, -70.0], [2.0, 10.0], []),
        (-2.0, 10.0, [-0.5, 2.5, 5.5, 8.5], [0.3, 1.5], [(4.0, 4.8)]),
    ],
)
def test_the_tests_lie_between_the_lowest_and_the_highest_command(
    low: float, high: float, offsets: list[float], amplitudes: list[float], wave: list[tuple[float, float]]
) -> None:
    steps: list[float] = []

    def settled(run: Experiment) -> float:
        steps.append(float(run.inputs["F"].value(np.array([20.0]))[0]))
        return 2.0

    tests = candidate_tests(ran(low, high), settled, model(), SETTINGS)
    sines = [t for t in tests if t.periods]
    assert sorted({t.offset for t in sines}) == pytest.approx(offsets)
    assert sorted({t.amplitude for t in sines}) == pytest.approx(amplitudes)
    assert [(t.offset, t.amplitude) for t in tests if not t.periods] == [pytest.approx(one) for one in 2 * wave]
    assert steps == [pytest.approx(max(offsets, key=lambda offset: (abs(offset), offset)))]
    slack = 1e-9 * (high - low)
    for test in tests:
        command = test.command.signal().value(np.linspace(test.log_from, test.seconds, 2000, endpoint=False))
        assert low - slack <= command.min() < command.max() <= high + slack


def test_the_plan_is_the_test(tmp_path: Path) -> None:
    signals = [MeasuredSignal("x", "output", "m", "position", "x", noise=1e-3)]
    every = candidate_tests(data(), lambda run: 2.46, model(), SETTINGS)
    for test in every[::5] + every[-1:]:
        path = tmp_path / "plan.toml"
        path.write_text(plan_text([test], signals, "mass", ("one", "other")), encoding="utf-8")
        (run,) = read_plan(path).runs()
        times = np.linspace(0, test.seconds, 500)
        assert run.log_from == pytest.approx(test.log_from)
        assert run.command.end == pytest.approx(test.command.end, rel=1e-6)
        wanted, made = test.command.signal().value(times), run.command.signal().value(times)
        assert made == pytest.approx(wanted, abs=2e-4 * np.abs(wanted).max())


def sine(frequency: float, periods: int) -> CandidateTest:
    (command, _) = data().signals
    return CandidateTest(command, 1.0, 2.0, frequency, periods, 0.0, 0.02, 2.0, 1)


def test_of_a_steady_sine_mean_and_harmonics_are_counted_and_nothing_else() -> None:
    """What is orthogonal to them over whole periods is lost; so is the first period, where the sine sets in."""
    test = sine(1.0, 6)
    t = test.interval * np.arange(test.samples)
    steady = np.column_stack([np.full(t.size, 0.7), 0.3 * np.sin(2 * np.pi * t), np.cos(10 * np.pi * t)])
    counted = test.counted(steady)
    kept = t.size - 50
    assert counted.T @ counted == pytest.approx(np.diag([0.49, 0.045, 0.5]) * kept)
    onset = np.where(t < 1, 5.0, 0.0)[:, None]
    assert np.abs(test.counted(onset)).max() < 1e-12
    assert np.abs(test.counted(np.sin(2 * np.pi * 7 * t)[:, None])).max() < 1e-9
    assert test.counted(np.ones((t.size, 2, 3))).shape == (11, 2, 3)


def test_of_a_wave_all_is_counted_behind_the_hold() -> None:
    wave = next(t for t in candidate_tests(data(), lambda run: 2.46, model(), SETTINGS) if not t.periods)
    rows = np.arange(wave.samples, dtype=float)[:, None]
    time = wave.log_from + wave.interval * wave.counted(rows)[:, 0]
    assert time[0] == pytest.approx(wave.command.onset, abs=wave.interval)
    assert time.size == SETTINGS.wave


def test_two_commands_are_refused() -> None:
    other = MeasuredSignal("G", "input", "N", "force", "F")
    with pytest.raises(BadInput, match="'mass': a next test needs one command"):
        candidate_tests(replace(data(), signals=(*data().signals, other)), lambda run: 2.0, model(), SETTINGS)


def test_a_command_that_never_moves_is_refused() -> None:
    with pytest.raises(BadInput, match="'mass': a next test needs a command that moves"):
        candidate_tests(ran(5.0, 5.0), lambda run: 2.0, model(), SETTINGS)
