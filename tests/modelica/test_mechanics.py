"""The shaft: its friction law, its pulse sensor, and the slow swing that shows both."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pytest

import fmu_build
from pysim.io import read_model
from pysim.simulate import Rodas, simulate
from pysim.types import Experiment, Record
from tests.modelica.built import built

FINE = Rodas(rtol=1e-8, atol=1e-8)
# thesis Table 6.2
R, OMEGA_0, TAU_C, TAU_S = 13.8806, 8.3593, 14.8939, 54.8258


def ran(name: str, stop: float, recorded: Sequence[str], folder: Path, step: float = 0.01) -> Record:
    model = read_model(fmu_build.build(name, folder / "model.fmu"))
    return simulate(model, Experiment(np.arange(0, stop, step), tuple(recorded)), solver=FINE)


def test_pulse_sensor_shows_the_mean_speed_between_edges(tmp_path: Path) -> None:
    """Edge k of even acceleration comes at sqrt(2 k pitch / a)."""
    record = ran("HydraulicTestBench.Validation.PulseSpeed", 3.0, ("error", "sensor.count", "sensor.w"), tmp_path)
    assert np.abs(record["error"]).max() < 1e-9
    assert record["sensor.count"][-1] == 1 + int(0.5 * 4 * record.time[-1] ** 2 / (2 * np.pi / 10))
    assert record["sensor.w"][-1] == pytest.approx(4 * record.time[-1], abs=0.3)


def test_friction_of_the_swing_is_eq_5_38_in_both_directions(tmp_path: Path) -> None:
    """T_s - J dw/dt against the law, typed here a second time; dw/dt from the recorded speed."""
    record = ran("HydraulicTestBench.Examples.FrictionSweep", 20.0, ("bench.omega", "bench.T_s"), tmp_path, step=0.001)
    omega = record["bench.omega"]
    law = np.tanh(R * omega) * (TAU_C + (TAU_S - TAU_C) * np.exp(-np.abs(omega) / OMEGA_0))
    balance = record["bench.T_s"] - 0.0733 * np.gradient(omega, record.time)
    # where the shaft breaks loose its acceleration kinks within samples
    smooth = np.abs(np.gradient(np.gradient(omega, record.time), record.time)) < 100
    assert smooth.mean() > 0.98
    assert np.abs(balance - law)[smooth][2:-2].max() < 0.01
    assert omega.max() > 39
    assert omega.min() < -39
    assert np.abs(law).max() > 50


JOINED = {  # parts that start together: declarations, connected flanges, their speed over time, the torque between them
    "ConstantSpeed": ("ConstantSpeed first(w=151.8)", "", "flange", lambda t: np.full_like(t, 151.8), lambda t: 0 * t),
    "PrescribedSpeed": (
        "PrescribedSpeed first",
        "first.w = 6*cos(2*time);",
        "flange",
        lambda t: 6 * np.cos(2 * t),
        lambda t: -12 * np.sin(2 * t),
    ),
    "Inertia": ("Inertia first(J=2, w(start=3))", "", "flange_b", lambda t: np.full_like(t, 3.0), lambda t: 0 * t),
}


@pytest.mark.parametrize("part", JOINED)
def test_inertia_starts_as_the_part_it_is_fixed_to(part: str, tmp_path: Path) -> None:
    declared, equation, flange, speed, acceleration = JOINED[part]
    text = tmp_path / "Joined.mo"
    text.write_text(
        f"model Joined\n  HydraulicTestBench.Mechanics.{declared};\n"
        "  HydraulicTestBench.Mechanics.Inertia rotor(J=0.012, phi(fixed=false), w(fixed=false));\n"
        f"equation\n  {equation}\n  connect(first.{flange}, rotor.flange_a);\nend Joined;\n"
    )
    names = ("rotor.w", "rotor.flange_a.tau")
    record = simulate(built("Joined", (), (text,)), Experiment(np.linspace(0, 1, 11), names), solver=FINE)
    assert np.allclose(record["rotor.w"], speed(record.time), rtol=1e-6)
    assert np.allclose(record["rotor.flange_a.tau"], 0.012 * acceleration(record.time), atol=1e-7)


def test_mass_starts_as_the_mass_it_is_fixed_to(tmp_path: Path) -> None:
    text = tmp_path / "Masses.mo"
    text.write_text("""model Masses
  HydraulicTestBench.Mechanics.Mass first(m=2, g=0, s_start=4, v(start=3));
  HydraulicTestBench.Mechanics.Mass second(m=1, g=0, s(fixed=false), v(fixed=false));
equation
  connect(first.flange_b, second.flange_a);
end Masses;
""")
    run = Experiment(np.linspace(0, 1, 11), ("second.s",))
    record = simulate(built("Masses", (), (text,)), run, solver=FINE)
    assert np.allclose(record["second.s"], 4 + 3 * record.time, rtol=1e-9)
