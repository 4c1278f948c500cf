"""The oscillator on the bench: x'' = u - 2 D w x' - w^2 x, with answers in closed form."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from fmu_build import build
from pysim.bench import BenchData, Plan, read_plan, run_plan
from pysim.io import read_dataset, read_model, write_dataset
from pysim.types import BadInput, Model, Record, SimulationError
from tests.pysim.bench.plans import PLAN


@pytest.fixture(scope="module")
def plan(tmp_path_factory: pytest.TempPathFactory) -> Plan:
    path = tmp_path_factory.mktemp("plan") / "plan.toml"
    path.write_text(PLAN, encoding="utf-8")
    return read_plan(path)


@pytest.fixture(scope="module")
def data(oscillator: Model, plan: Plan) -> BenchData:
    return run_plan(oscillator, plan, 11, parameters={"D": 0.0})


def log(dataset: object, source: str) -> Record:
    return next(record.data for record in dataset.records if record.source == source)  # type: ignore[attr-defined]


def test_the_clean_step_is_the_closed_form(data: BenchData) -> None:
    clean = log(data.truth.clean, "step/O+0_H+0.004.txt")
    s = np.maximum(clean.time - 0.5, 0.0)
    np.testing.assert_allclose(clean["position"], 1 - np.cos(2 * s), atol=1e-5)  # 4 N over w^2 = 4 /s2
    np.testing.assert_allclose(clean["v"], 2 * np.sin(2 * s), atol=2e-5)
    np.testing.assert_array_equal(clean["force"], np.where(clean.time < 0.5, 0.0, 4.0))
    assert clean.time[0] == 0.25
    np.testing.assert_allclose(np.diff(clean.time), 1 / 250 + (1 / 70 - 1 / 250) / 3, rtol=1e-9)  # two signals


def test_measured_is_clean_with_noise_limits_and_steps(data: BenchData) -> None:
    name = "step/O+0_H+0.004.txt"
    clean, measured = log(data.truth.clean, name), log(data.dataset, name)
    position = measured["position"]
    assert (position.max(), position.min()) == (pytest.approx(1.8), pytest.approx(0.0, abs=8e-3))
    np.testing.assert_allclose(position / 5e-4, np.round(position / 5e-4), atol=1e-6)
    free = clean["position"] < 1.79
    error = (position - clean["position"])[free]
    assert error.std() == pytest.approx(np.hypot(2e-3, 5e-4 / np.sqrt(12)), rel=0.15)
    np.testing.assert_array_equal(measured["force"], clean["force"])


def test_a_slow_signal_repeats_its_last_sample(data: BenchData) -> None:
    measured = log(data.dataset, "step/O+0_H+0.004.txt")
    taken = 0.25 + np.floor((measured.time - 0.25) * 25 + 1e-9) / 25
    np.testing.assert_allclose(measured["v"], 2 * np.sin(2 * np.maximum(taken - 0.5, 0.0)), atol=2e-5)
    assert np.unique(measured["v"][measured.time > 0.6]).size < 110


def test_sines_start_with_the_log_and_settle_to_the_closed_form(oscillator: Model, plan: Plan) -> None:
    sines = replace(plan, tests=(replace(plan.tests[1], most=60.0, least=40.0),))
    clean = log(
        run_plan(oscillator, sines, 1, parameters={"D": 1.0}).truth.clean, "frequency_response/O-0.002_A0.001/2Hz.txt"
    )
    phase = 2 * np.pi * 2 * (clean.time - 1.0)
    np.testing.assert_allclose(clean["force"], -2.0 + np.sin(phase), atol=1e-9)
    gain = 1 / (4 - (4 * np.pi) ** 2 + 2j * 2 * 4 * np.pi)
    late = clean.time > 30
    answer = -0.5 + np.abs(gain) * np.sin(phase + np.angle(gain))
    np.testing.assert_allclose(clean["position"][late], answer[late], atol=1e-5)


def test_records_say_what_they_are(data: BenchData) -> None:
    sine = next(r for r in data.dataset.records if r.source == "frequency_response/O-0.002_A0.001/2Hz.txt")
    assert (sine.kind, sine.use, sine.command) == ("frequency-response", "fit", "force")
    assert (sine.offset, sine.amplitude, sine.frequency) == (-2.0, 1.0, 2.0)
    assert (sine.data.names, sine.data.units) == (("force", "position"), ("N", "m"))
    assert (data.dataset.name, data.dataset.system) == ("oscillator", "mass")


def test_the_truth_names_parameters_noise_and_effect(oscillator: Model, plan: Plan) -> None:
    short = replace(plan, tests=plan.tests[:1])
    truth = run_plan(oscillator, short, 5, parameters={"D": 0.3}, effect="x", strength={"F": 2.0}).truth
    assert truth.parameters.items() >= {"w": 2.0, "D": 0.3}.items()
    assert (truth.effect, dict(truth.strength)) == ("x", {"F": 2.0})
    assert truth.noise == {"force": None, "position": pytest.approx(2e-3), "v": None}
    assert (truth.plan, truth.seed, truth.token) == ("oscillator", 5, oscillator.token)


def folder_bytes(folder: Path) -> dict[str, bytes]:
    return {path.relative_to(folder).as_posix(): path.read_bytes() for path in folder.rglob("*") if path.is_file()}


def test_the_same_seed_gives_the_same_bytes(oscillator: Model, plan: Plan, data: BenchData, tmp_path: Path) -> None:
    units = {name: unit for name, (unit, _) in plan.units.items()}
    again = run_plan(oscillator, plan, 11, parameters={"D": 0.0}, workers=1)
    other = run_plan(oscillator, plan, 12, parameters={"D": 0.0})
    for name, bench in (("a", data), ("b", again), ("c", other)):
        write_dataset(tmp_path / name, bench.dataset, units=units)
    a, b, c = (folder_bytes(tmp_path / name) for name in "abc")
    assert a == b
    assert a.keys() == c.keys()
    assert sum(a[name] != c[name] for name in a) == 7  # but for dataset.toml and the multisines, whose v has no noise


def test_a_written_set_is_read_back_to_its_digits(plan: Plan, data: BenchData, tmp_path: Path) -> None:
    units = {name: unit for name, (unit, _) in plan.units.items()}
    back = read_dataset(write_dataset(tmp_path / "set", data.dataset, units=units))
    for new, old in zip(back.records, data.dataset.records, strict=True):
        assert (new.source, new.kind, new.use, new.command) == (old.source, old.kind, old.use, old.command)
        np.testing.assert_allclose(new.data.values, old.data.values, atol=3e-6)  # 5e-4 m over a hundred, rounded
        np.testing.assert_allclose(new.data.time, old.data.time, atol=1e-6)


def test_a_log_does_not_depend_on_its_neighbours(oscillator: Model, plan: Plan, data: BenchData) -> None:
    alone = run_plan(oscillator, replace(plan, tests=plan.tests[2:3]), 11, parameters={"D": 0.0}).dataset.records[0]
    np.testing.assert_array_equal(alone.data.values, log(data.dataset, alone.source).values)


def test_jitter_samples_the_truth_where_the_stamps_say(oscillator: Model, plan: Plan) -> None:
    uneven = replace(plan, tests=plan.tests[:1], logger=replace(plan.logger, jitter=1e-3))
    result = run_plan(oscillator, uneven, 3, parameters={"D": 0.0})
    clean = result.truth.clean.records[0].data
    assert np.diff(clean.time).std() > 1e-3
    np.testing.assert_allclose(clean["position"], 1 - np.cos(2 * np.maximum(clean.time - 0.5, 0.0)), atol=1e-5)
    np.testing.assert_array_equal(result.dataset.records[0].data.time, clean.time)


def test_refusals(oscillator: Model, plan: Plan) -> None:
    with pytest.raises(BadInput, match="the seed is -1"):
        run_plan(oscillator, plan, -1)
    wrong = replace(plan.sensors[1], signal=replace(plan.sensors[1].signal, unit="rad"))
    with pytest.raises(BadInput, match=r"'position' of the plan is in 'rad', x of .* in 'm'"):
        run_plan(oscillator, replace(plan, sensors=(plan.sensors[0], wrong, plan.sensors[2])), 1)
    wrong = replace(plan.sensors[0], signal=replace(plan.sensors[0].signal, variable="x"))
    with pytest.raises(BadInput, match="x is no input but of causality local"):
        run_plan(oscillator, replace(plan, sensors=(wrong, *plan.sensors[1:])), 1)
    slow = replace(plan.logger, rates=((1, 3.0),))
    with pytest.raises(BadInput, match=r"2Hz\.txt: its 2 Hz are not below half the sampling rate, 3 Hz"):
        run_plan(oscillator, replace(plan, tests=plan.tests[1:2], logger=slow), 1)
    with pytest.raises(BadInput, match=r"multi/O\+0_R1\.txt: its 7.5 Hz are not below half the sampling rate, 3 Hz"):
        run_plan(oscillator, replace(plan, tests=plan.tests[4:], logger=slow), 1)
    with pytest.raises(BadInput, match="shorter than a sampling interval"):
        run_plan(oscillator, replace(plan, logger=replace(plan.logger, rates=((1, 0.01),))), 1)


@pytest.mark.parametrize("words", [("offset = 0\nheight = 0.004", "offset = 1e40\nheight = 0.004"), ("0.004", "-1e30")])
def test_a_command_out_of_all_proportion_is_refused(words: tuple[str, str], oscillator: Model, tmp_path: Path) -> None:
    path = tmp_path / "plan.toml"
    path.write_text(
        PLAN.replace(*words, 1).replace("rest = 0.25\nramp = 0.0", "rest = 0.25\nramp = 0.5"), encoding="utf-8"
    )
    with pytest.raises(BadInput, match="takes u to"):
        run_plan(oscillator, read_plan(path), 1)


def test_a_run_that_stops_is_an_error_with_its_record(oscillator: Model, plan: Plan) -> None:
    with pytest.raises(SimulationError, match=r"step/O\+0_H\+0\.004\.txt: .* stopped early"):
        run_plan(oscillator, replace(plan, tests=plan.tests[:1]), 1, parameters={"w": 1e200})


TWO = """model Two
  input Real u(unit="N", start=0);
  input Real v(unit="rad", start=0);
  input Real v_t(unit="rad/s", start=0);
  output Real y(unit="N") = u + 10*v;
  output Real rate(unit="rad/s") = v_t;
end Two;
"""
FOLLOWING = """
[plan]
name = "two"

[signals.u]
role = "input"
unit = "kN"

[signals.v]
role = "input"
unit = "rad"
follows = "u"
ratio = 50

[signals.y]
role = "output"
unit = "kN"

[signals.rate]
role = "output"
unit = "rad/s"

[logging]
rate = 100

[[tests]]
kind = "chirp"
outputs = ["y", "rate"]
offset = 0.002
amplitude = 0.001
start_hz = 0.5
stop_hz = 2
sweep = 3
"""


def test_an_input_that_follows_goes_along_and_is_logged(tmp_path: Path) -> None:
    (tmp_path / "Two.mo").write_text(TWO, encoding="utf-8")
    (tmp_path / "plan.toml").write_text(FOLLOWING, encoding="utf-8")
    two = read_model(build("Two", tmp_path / "two.fmu", libraries=[tmp_path / "Two.mo"]))
    data = run_plan(two, read_plan(tmp_path / "plan.toml"), 1).dataset
    ((record,), clean) = data.records, data.records[0].data
    assert isinstance(clean, Record)
    assert (clean.names, record.command) == (("u", "v", "y", "rate"), "u")
    assert np.ptp(clean["u"]) == pytest.approx(2.0, rel=0.01)
    np.testing.assert_allclose(clean["v"], 0.05 * clean["u"], rtol=1e-12)  # 50 per kN
    np.testing.assert_allclose(clean["y"], 1.5 * clean["u"], rtol=1e-12)
    slope = np.gradient(clean["v"], clean.time)[3:-3]
    np.testing.assert_allclose(clean["rate"][3:-3], slope, atol=0.01 * np.abs(slope).max())
    write_dataset(tmp_path / "set", data)
    assert read_dataset(tmp_path / "set").records[0].command == "u"


def test_follows_without_ratio_is_refused(tmp_path: Path) -> None:
    (tmp_path / "plan.toml").write_text(FOLLOWING.replace("ratio = 50\n", ""), encoding="utf-8")
    with pytest.raises(BadInput, match="follows and ratio go together"):
        read_plan(tmp_path / "plan.toml")
