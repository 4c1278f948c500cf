from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from pysim.bench import read_plan
from pysim.diagnose.candidate_tests import candidate_tests
from pysim.types import BadInput, Dataset, Experiment, MeasuredSignal
from tests.pysim.diagnose.toy import base, measured

DATA = measured(1)
LOWEST = min(record.data["F"].min() for record in DATA.logs())
HIGHEST = max(record.data["F"].max() for record in DATA.logs())


def soon(run: Experiment) -> float:
    """At rest 2.45 s after a step to the farthest offset: this command went further down than up."""
    farthest = (LOWEST + HIGHEST) / 2 - 0.75 * (HIGHEST - LOWEST) / 2
    assert run.inputs["F"].value(np.array([0.1, 20.0])).tolist() == pytest.approx([farthest] * 2)
    return 2.46


def ran(low: float, high: float) -> Dataset:
    """One log whose command goes from low to high."""
    (record, *_) = DATA.records
    command, values = record.data["F"], record.data.values.copy()
    place = record.data.names.index("F")
    values[:, place] = np.interp(command, [command.min(), command.max()], [low, high])
    return replace(DATA, records=(replace(record, data=replace(record.data, values=values)),))


def test_no_test_goes_beyond_what_was_run() -> None:
    model = base()
    tests = candidate_tests(DATA, soon, model)
    assert len({(t.offset, t.amplitude, t.frequency) for t in tests}) == len(tests)
    for test in tests:
        run = test.experiment(model, ("x",), {})
        assert run.times.size == test.samples >= 300
        assert test.command.onset == 1 + 2.5
        command = run.inputs["F"].value(np.linspace(0, test.seconds, 2000))
        assert LOWEST * (1 + 1e-9) <= command.min() < command.max() <= HIGHEST * (1 + 1e-9)
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

    tests = candidate_tests(ran(low, high), settled, base())
    sines = [t for t in tests if t.periods]
    assert sorted({t.offset for t in sines}) == pytest.approx(offsets)
    assert sorted({t.amplitude for t in sines}) == pytest.approx(amplitudes)
    assert [(t.offset, t.amplitude) for t in tests if not t.periods] == [pytest.approx(one) for one in 2 * wave]
    assert steps == [pytest.approx(max(offsets, key=lambda offset: (abs(offset), offset)))]
    slack = 1e-9 * (high - low)
    for test in tests:
        command = test.command.signal().value(np.linspace(test.log_from, test.seconds, 2000, endpoint=False))
        assert low - slack <= command.min() < command.max() <= high + slack


def test_a_range_from_or_about_zero_is_cut_as_it_was_before_ranges_had_a_lowest_command() -> None:
    largest = 17.3
    for low, shares in ((-largest, (-0.75, -0.25, 0.25, 0.75)), (0.0, (0.25, 0.75))):
        sines = [t for t in candidate_tests(ran(low, largest), lambda run: 2.0, base()) if t.periods]
        assert {t.offset for t in sines} == {largest * share for share in shares}
        assert {t.amplitude for t in sines} == {largest * 0.05, largest * 0.25}


def test_a_command_of_one_sign_stays_so() -> None:
    rows = replace(DATA.records[0].data, values=np.abs(DATA.records[0].data.values))
    data = replace(DATA, records=(replace(DATA.records[0], data=rows),))
    assert all(t.offset > 0 for t in candidate_tests(data, lambda run: 2.0, base()))


def test_the_plan_is_the_test(tmp_path: Path) -> None:
    head = ["[plan]", 'name = "p"', "[signals.F]", 'role = "input"', 'unit = "N"', 'quantity = "force"']
    head += ["[signals.x]", 'role = "output"', 'unit = "m"', 'quantity = "position"', "[logging]", "rate = 50"]
    for test in candidate_tests(DATA, soon, base()):
        path = tmp_path / "plan.toml"
        path.write_text("\n".join([*head, *test.plan_rows(("x",), "one")]))
        (run,) = read_plan(path).runs()
        times = np.linspace(0, test.seconds, 500)
        assert run.log_from == pytest.approx(test.log_from)
        assert run.command.end == pytest.approx(test.command.end, rel=1e-6)
        wanted, made = test.command.signal().value(times), run.command.signal().value(times)
        assert made == pytest.approx(wanted, abs=2e-4 * np.abs(wanted).max())


def test_two_commands_are_refused() -> None:
    other = MeasuredSignal("G", "input", "N", "", "F")
    with pytest.raises(BadInput, match="'toy': a next test needs one command"):
        candidate_tests(replace(DATA, signals=(*DATA.signals, other)), soon, base())


def test_a_command_that_never_moves_is_refused() -> None:
    with pytest.raises(BadInput, match="'toy': a next test needs a command that moves"):
        candidate_tests(ran(5.0, 5.0), soon, base())
