"""Logs that begin anywhere, of a swing of many periods: the search starts from rest, a period out of step."""

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import fmu_build
from pysim.identify.greybox import Parameter, Treatment, fit, fit_at, problem
from pysim.identify.greybox.beginning import settled_initial_states
from pysim.io import read_model
from pysim.types import Dataset, MeasuredRecord, MeasuredSignal, Model, Record

SWING = """model Swing "Pendulum that hangs"
  parameter Real w2(unit="1/s2", min=20, max=120, nominal=60) = 55;
  parameter Real d(unit="1/s", min=0, max=2, nominal=0.1) = 0.1;
  input Real u(unit="1/s2");
  output Real x(unit="rad", start=0, fixed=true);
  Real v(unit="rad/s", start=0, fixed=true);
equation
  der(x) = v;
  der(v) = u - w2*sin(x) - d*v;
end Swing;
"""
W2, D, NOISE = 62.0, 0.06, 1e-3


def built(folder: Path, text: str) -> Model:
    (folder / "Swing.mo").write_text(text)
    return read_model(fmu_build.build("Swing", folder / "Swing.fmu", libraries=[folder / "Swing.mo"]))


@pytest.fixture(scope="module")
def swing(tmp_path_factory: pytest.TempPathFactory) -> Model:
    return built(tmp_path_factory.mktemp("swing"), SWING)


def angle(x: float, v: float, time: np.ndarray, push: float = 0.0) -> np.ndarray:
    """Without noise, by another integrator; pushed by a sine of one radian a second."""
    return solve_ivp(
        lambda t, y: (y[1], push * np.sin(t) - W2 * np.sin(y[0]) - D * y[1]),
        (0, time[-1]), (x, v), t_eval=time, rtol=1e-10, atol=1e-10,
    ).y[0]  # fmt: skip


def measured(time: np.ndarray, pushed: np.ndarray, clean: np.ndarray, use: str, seed: int) -> MeasuredRecord:
    noisy = clean + NOISE * np.random.default_rng(seed).standard_normal(time.size)
    record = Record(time, np.column_stack([pushed, noisy]), ("u", "x"), ("1/s2", "rad"))
    return MeasuredRecord(f"{use}-{seed}.txt", "other", use, record)


def let_go(x: float, v: float, use: str, seed: int) -> MeasuredRecord:
    """Ten seconds."""
    time = np.arange(0, 10, 0.01)
    return measured(time, 0 * time, angle(x, v, time), use, seed)


def swings(*records: MeasuredRecord) -> Dataset:
    signals = (
        MeasuredSignal("u", "input", "1/s2", "torque", "u"),
        MeasuredSignal("x", "output", "rad", "angle", "x", noise=NOISE),
    )
    return Dataset("swing", "", "pendulum", signals, records)


@pytest.fixture(scope="module")
def data() -> Dataset:
    return swings(let_go(2.4, 3.0, "fit", 1), let_go(-1.2, 6.0, "fit", 2), let_go(2.0, -5.0, "validate", 3))


def test_a_fit_falls_into_step(swing: Model, data: Dataset) -> None:
    task = problem(swing, [data], (Parameter("w2"), Parameter("d")), treatment=Treatment(initial="estimate"))
    found = fit(task)
    for estimate, truth in zip(found.estimates, (W2, D), strict=True):
        low, high = estimate.interval
        assert low - (high - low) < truth < high + (high - low)
    for record in found.records:
        assert np.std(record.residual.values) == pytest.approx(1.0, rel=0.1)  # of the noise


def test_an_unknown_state_lies_between_its_limits(data: Dataset, tmp_path: Path) -> None:
    """Half the way between these is the standard deviation of what is known of it."""
    slow = built(tmp_path, SWING.replace("Real v(", "Real v(min=-8, max=6, "))
    task = problem(slow, [data], (Parameter("w2"), Parameter("d")), treatment=Treatment(initial="estimate"))
    for one in task.observations:
        assert dict(zip(slow.abilities.states, one.runs[0].initial.tolist(), strict=True)) == {"x": math.inf, "v": 7.0}


def test_a_log_that_was_not_fitted_falls_into_step(swing: Model, data: Dataset) -> None:
    task = problem(swing, [data], (Parameter("w2", W2), Parameter("d", D)), treatment=Treatment(initial="estimate"))
    point = settled_initial_states(
        task.residuals(use="validate"), swing, task.space, task.space.to_search(task.space.start)
    )
    (states,) = point.carried.states
    assert states == pytest.approx([2.0, -5.0], abs=5e-3)


def test_limits_of_all_states_do_not_put_a_log_out_of_step(data: Dataset, tmp_path: Path) -> None:
    text = SWING.replace("Real v(", "Real v(min=-100, max=100, ").replace("Real x(", "Real x(min=-20, max=20, ")
    wide = built(tmp_path, text)
    task = problem(wide, [data], (Parameter("w2", W2), Parameter("d", D)), treatment=Treatment(initial="estimate"))
    residuals = task.residuals(use="validate")
    assert all(np.isfinite(run.initial).all() for run in residuals.runs)
    point = settled_initial_states(residuals, wide, task.space, task.space.to_search(task.space.start))
    assert point.carried.states[0] == pytest.approx([2.0, -5.0], abs=5e-3)


def test_to_find_where_a_log_at_rest_began_costs_one_noise_a_state(swing: Model) -> None:
    time = np.arange(0, 3, 0.01)
    truth, pushed = angle(0.0, 0.0, time, push=5.0), 5.0 * np.sin(time)
    seen = [measured(time, pushed, truth, "validate", seed) for seed in range(40)]
    known = replace(seen[0], source="known.txt", initial="rest")
    task = problem(swing, [swings(let_go(2.4, 3.0, "fit", 1), *seen, known)], (Parameter("w2"), Parameter("d")))
    found = fit_at(task, {"w2": W2, "d": D})
    cost = {r.source: float(np.sum(((r.simulated["x"] - truth) / NOISE) ** 2)) for r in found.records[1:]}
    assert cost.pop("known.txt") < 0.5  # of the integration
    assert 1.0 < np.mean(list(cost.values())) < 3.0  # 2 states; the mean of forty is 2 within 0.3
