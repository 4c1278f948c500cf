"""What a plan refuses, and how long its sines last."""

import numpy as np
import pytest

from pysim.bench import (
    ChirpTest,
    Logger,
    MultisineTest,
    Plan,
    Sensor,
    SteppedSines,
    StepTest,
    Truth,
    WaveTest,
    truth_data,
)
from pysim.excitation import Chirp, LeadIn, LineGrid, Multisine, PiersonMoskowitz, Step, StochasticWave
from pysim.types import BadInput, Dataset, MeasuredSignal

COMMAND = Sensor(MeasuredSignal("u", "input", "Pa", "", "u"))
ANSWER = Sensor(MeasuredSignal("y", "output", "m", "", "y"))
LOGGER = Logger(((1, 100.0),))
CHIRP = ChirpTest("u", ("y",), Chirp(2e5, 1e5, 0.1, 10, 5))


def plan(*tests: object, sensors: tuple[Sensor, ...] = (COMMAND, ANSWER)) -> Plan:
    return Plan("p", "-", "-", sensors, tests, LOGGER, units={"u": ("bar", 1e5)})  # type: ignore[arg-type]


def test_files_are_named_in_the_files_units() -> None:
    step = StepTest("u", ("y",), Step(1e5, -2e5, 1.0))
    wave = MultisineTest("u", ("y",), Multisine(LineGrid(1.0, 1, 10), 1, rms=1e5, offset=3e5))
    sines = SteppedSines("u", ("y",), ((1e5, 5e4),), (0.5,))
    sources = [run.source for run in plan(CHIRP, step, wave, sines).runs()]
    assert sources == [
        "chirp/O+2_A1.txt",
        "step/O+1_H-2.txt",
        "multisine/O+3_R1.txt",
        "frequency_response/O+1_A0.5/0.5Hz.txt",
    ]


@pytest.mark.parametrize(("lead", "starts"), [(LeadIn(), 1.0), (LeadIn(hold=0.0), 0.0), (LeadIn(0.3, 0.0, 0.0), 0.0)])
def test_logs_of_waves_and_steps_start_at_rest_at_the_offset(lead: LeadIn, starts: float) -> None:
    step = StepTest("u", ("y",), Step(0.0, 1.0, 1.0, lead=lead))
    for run in plan(step, _wave(lead)).runs():
        assert run.log_from == starts
        assert run.command.signal().value(np.array([run.log_from])) == pytest.approx([0.0])


def _named(name: str, folder: str = "chirp") -> ChirpTest:
    return ChirpTest("u", ("y",), CHIRP.command, name=name, folder=folder)


def _wave(lead: LeadIn) -> WaveTest:
    return WaveTest("u", ("y",), StochasticWave(PiersonMoskowitz(1.0, 1.0), 10.0, 1, lead=lead))


@pytest.mark.parametrize(
    ("frequency", "periods"), [(0.01, 1), (0.1, 2), (0.5, 3), (2, 3), (4, 5), (6, 8), (10, 12), (13, 16), (30, 36)]
)
def test_whole_periods_between_least_and_most(frequency: float, periods: int) -> None:
    # three periods, 1.2 s at least, 20 s at most, one period in any case
    assert SteppedSines("u", ("y",), ((0.0, 1.0),), (frequency,)).periods_of(frequency) == periods


@pytest.mark.parametrize(
    ("make", "words"),
    [
        (lambda: plan(), "plan 'p' has no tests"),
        (lambda: plan(CHIRP, CHIRP), r"two tests are logged to chirp/O\+2_A1\.txt"),
        (
            lambda: plan(_named("A"), _named("a")),
            "logged to chirp/A.txt and chirp/a.txt, one file on Windows and macOS",
        ),
        (lambda: plan(_named("Nul")), "logged to 'chirp/Nul.txt', but 'Nul.txt' is a device on Windows; name it anew"),
        (lambda: plan(_named("a", folder="logs ")), "Windows drops the end of 'logs '"),
        (lambda: plan(CHIRP, sensors=(COMMAND, ANSWER, ANSWER)), "the signal 'y' stands there twice"),
        (lambda: plan(ChirpTest("y", ("y",), CHIRP.command)), "'y' is no signal with the role input; use u"),
        (lambda: plan(ChirpTest("u", ("u",), CHIRP.command)), "'u' is no signal with the role output; use y"),
        (lambda: plan(ChirpTest("u", (), CHIRP.command)), "a test measures nothing"),
        (lambda: StepTest("u", ("y",), Step(5, 2, 1, lead=LeadIn(hold=0))), "step: without a hold"),
        (lambda: _wave(LeadIn.none()), "wave: without a hold its log cannot start at rest at the offset"),
        (lambda: SteppedSines("u", ("y",), (), (1.0,)), "at least one pair of offset and amplitude"),
        (lambda: SteppedSines("u", ("y",), ((0, 1),), (1.0,), most=1.0), "most not less than least"),
    ],
)
def test_refuses_what_cannot_be_driven(make: object, words: str) -> None:
    with pytest.raises(BadInput, match=words):
        make()  # type: ignore[operator]


def test_the_truth_as_data() -> None:
    nothing = Dataset("p", "-", "-", (), ())
    truth = Truth("M", "{1}", {"k": 2.0}, {"k": "N/m"}, {"y": 0.1}, {"y": None}, "p", 3, nothing, "none", {})
    assert truth_data(truth) == {
        "effect": "none",
        "strength": {},
        "parameters": {"k": 2.0},
        "parameter_units": {"k": "N/m"},
        "noise": {"y": 0.1},
        "resolution": {"y": None},
        "units": "SI",
        "model": "M",
        "token": "{1}",
        "plan": "p",
        "seed": 3,
    }


def test_an_input_follows_another() -> None:
    also = Sensor(MeasuredSignal("v", "input", "1", "", "v"))
    made = Plan("p", "-", "-", (COMMAND, also, ANSWER), (CHIRP,), LOGGER, follows={"v": ("u", -2.0)})
    assert (made.along("u"), made.along("v")) == ({"v": -2.0}, {})
    for follows in ({"v": ("y", 1.0)}, {"v": ("v", 1.0)}, {"y": ("u", 1.0)}, {"v": ("u", 1.0), "u": ("v", 1.0)}):
        with pytest.raises(BadInput, match="an input can follow one of"):
            Plan("p", "-", "-", (COMMAND, also, ANSWER), (CHIRP,), LOGGER, follows=follows)
