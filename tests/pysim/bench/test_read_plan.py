"""Plans from files: numbers in the files' units, and refusals with their line."""

from pathlib import Path

import pytest

from pysim.bench import named_plans, read_plan
from pysim.excitation import LeadIn
from pysim.types import BadInput
from tests.pysim.bench.plans import PLAN


def plan_file(folder: Path, text: str = PLAN) -> Path:
    path = folder / "plan.toml"
    path.write_text(text, encoding="utf-8")
    return path


def test_every_kind_of_test_becomes_its_runs(tmp_path: Path) -> None:
    plan = read_plan(plan_file(tmp_path))
    runs = plan.runs()
    assert [run.source for run in runs] == [
        "step/O+0_H+0.004.txt",
        "frequency_response/O+0.001_A0.0005/0.5Hz.txt",
        "frequency_response/O+0.001_A0.0005/2Hz.txt",
        "frequency_response/O-0.002_A0.001/0.5Hz.txt",
        "frequency_response/O-0.002_A0.001/2Hz.txt",
        "chirp/O+0_A0.001.txt",
        "stochastic/Tp0.7s.txt",
        "multi/O+0_R1.txt",
        "multi/O+0_R2.txt",
    ]
    assert [run.kind for run in runs][::4] == ["step", "frequency-response", "multisine"]
    assert [run.use for run in runs].count("validate") == 1
    sine = runs[3]
    assert (sine.offset, sine.amplitude, sine.frequency) == (-2.0, 1.0, 0.5)  # N
    assert sine.command.lead == LeadIn(0.25, 0.5, 0.25, 0.0)
    assert sine.log_from == sine.command.onset == 1.0
    assert [run.command.periods for run in runs[1:3]] == [1, 2]  # at most 3 s, but two periods of 0.5 Hz are 4 s
    assert runs[0].log_from == 0.25  # at rest, before the step at 0.5 s
    assert runs[7].command.seed + 1 == runs[8].command.seed


def test_signals_and_sensors_are_in_si(tmp_path: Path) -> None:
    plan = read_plan(plan_file(tmp_path))
    position = plan.sensor("position")
    assert position.signal.unit == "m"
    assert (position.signal.noise, position.signal.resolution) == (pytest.approx(2e-3), pytest.approx(5e-4))
    assert (position.low, position.high) == (pytest.approx(-1.5), pytest.approx(1.8))
    assert plan.sensor("v").rate == 25.0
    assert plan.units["position"][0] == "mm"
    assert dict(plan.inputs) == {"u_rate": 3.0}


def test_the_plans_that_come_with_the_package() -> None:
    assert named_plans() == ("bench-01", "thesis")
    short, long = (read_plan(name) for name in named_plans())
    assert len(short.runs()) == 5 * 13 + 1 + 2
    sines = [run for run in long.runs() if run.kind == "frequency-response"]
    assert len(sines) == 18 * 19
    assert len({(run.offset, run.amplitude) for run in sines}) == 18
    assert short.logger.rate(2) == 250.0
    assert long.logger.rate(4) == pytest.approx(70.0)


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ("[plan]", "[plans]", r"plan\.toml: the section \[plan\] is missing"),
        ('unit = "mm"', 'unit = "inch"', "line 12: unit = 'inch' is not known"),
        ("noise = 2.0", "noise = -2.0", "line 12: noise cannot be negative"),
        ("high = 1800", "high = -1800", "line 12: sensor position: its limits"),
        ("rate = 25", "rates = 25", "line 21: the key 'rates' is not known"),
        ("rates = [[1, 250.0], [4, 70.0]]", "", r"\[logging\] is missing"),
        ("rates = [[1, 250.0], [4, 70.0]]", "rates = [250.0]", "line 26: rates is missing or no row of pairs"),
        ("rates = [[1, 250.0], [4, 70.0]]", "rate = 1\nrates = [[1, 2]]", "line 26: give rate = Hz, or rates"),
        ("ramp = 0.0", "ramps = 0.0", "line 32: the key 'ramps' is not known; use rest, ramp"),
        ("hold = 0.25", "hold = -0.25", "line 32: lead-in: hold"),
        ('kind = "step"', 'kind = "stepp"', "line 38: kind = 'stepp' is not known; use one of frequency-response"),
        ("height = 0.004", "height = 0", "line 38: step: the height is 0"),
        ("length = 4", "long = 4", "line 38: the key 'long' is not known"),
        ('["position", "v"]', '["position", "w"]', "plan 'oscillator': 'w' is no signal with the role output"),
        ('["position", "v"]', '["force"]', "'force' is no signal with the role output; use position, v"),
        ("[0.5, 2]", "[0.5, -2]", "line 45: stepped sines: frequencies and periods must be positive"),
        ("[0.5, 2]", '"all"', "line 45: frequencies is missing or no row of numbers"),
        ("seed = 4", "seed = 4.5", "seed is missing or no whole number"),
        ("[signals.v]", "[signals.time]", "line 21: time is the clock of every log and no signal"),
        ("seed = 4", "seed = -4", "line 65: seed cannot be below 0, got -4"),
        ("seed = 2", "seed = -2", "line 73: seed cannot be below 0, got -2"),
        ("[-0.002, 0.001]", "[-0.002, -0.001]", "line 45: stepped sines: every amplitude, .* must be positive"),
        ("lead = { ramp = 0.5 }", "lead = 3", "line 45: lead = 3 is no table"),
        ("[-0.002, 0.001]", "[0.001, 0.0005]", "two tests are logged to frequency_response/O"),
        ("realisations = 2", "realisations = 0", "multisine: 0 realisations"),
    ],
)
def test_refuses_faults_with_their_line(tmp_path: Path, old: str, new: str, words: str) -> None:
    assert PLAN.count(old) == 1
    with pytest.raises(BadInput, match=words):
        read_plan(plan_file(tmp_path, PLAN.replace(old, new)))


def test_a_missing_plan_says_which_there_are(tmp_path: Path) -> None:
    with pytest.raises(BadInput, match=r"one of bench-01, thesis\): cannot read .*none\.toml"):
        read_plan(tmp_path / "none.toml")
