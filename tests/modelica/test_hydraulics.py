"""Volumes, resistances, valves, motor and hose, each alone against its closed form, as an FMU."""

from pathlib import Path

import numpy as np
import pytest
from scipy.optimize import brentq

from tests.modelica.built import built, ran
from tests.modelica.test_functions import curve


@pytest.mark.parametrize(
    ("name", "stop", "errors"),
    [
        ("MotorRunUp", 1.0, {"error": 70 * 1e-7, "error_Q": 4e-4 * 1e-7, "error_tau": 36 * 1e-7}),
        # 600 periods of the solver's error; Churchill adds nothing at these Reynolds numbers
        ("HoseMode", 0.1, {"error": 1e5 * 1e-6}),
        ("ReliefValveStep", 0.3, {"error": 1e-8}),
        ("PassiveParts", 2.0, {"error": 1e-9}),
    ],
)
def test_error_stays_within_its_reason(name: str, stop: float, errors: dict[str, float]) -> None:
    record = ran(f"Validation.{name}", stop, tuple(errors))
    for error, tolerance in errors.items():
        assert np.abs(record[error]).max() < tolerance, error


def test_pressure_at_constant_flow_is_where_the_relief_valve_lets_it_pass() -> None:
    record = ran("Validation.ReliefValveStep", 0.3, ("volume.p", "valve.opening"))
    expected = brentq(lambda p: (p - 100e5) / 50e5 * 5e-6 * np.sqrt(2 / 875 * p) - 3e-4, 100e5, 150e5)
    assert record["volume.p"][-1] == pytest.approx(expected, rel=1e-6)
    assert record["valve.opening"][-1] == pytest.approx((expected - 100e5) / 50e5, rel=1e-6)


def test_poppet_stays_between_its_stops() -> None:
    """Thrown open by 400 bar it meets the upper stop; it gives way by less than the seat's travel, 5 percent."""
    model = built("Validation.ReliefValveStep")
    record = ran(model, 0.3, ("alone.x", "alone.opening"), 3001, {"source.p": 400e5})
    assert record["alone.x"].max() < 1.05e-3
    assert record["alone.opening"].max() == 1
    assert record["alone.opening"][-1] == 1


def test_motor_loses_power_and_never_makes_any() -> None:
    lost = ran("Validation.MotorRunUp", 1.0, ("lost",))["lost"]
    assert lost.min() > 0
    assert lost[0] == pytest.approx(75e5 * 75e5 * 1e-12 + (100e5**2 + 25e5**2) * 2e-12, rel=1e-6)  # leaks alone


@pytest.mark.parametrize("part", ["orifice", "resistance", "check", "relief", "servo"])
def test_each_passive_part_takes_power_at_times(part: str) -> None:
    """The test of `PassiveParts` says something only where the parts are passed."""
    assert ran("Validation.PassiveParts", 2.0, (f"P_{part}",))[f"P_{part}"].max() > 50


def test_check_valve_is_shut_one_way_and_an_orifice_the_other() -> None:
    record = ran("Validation.PassiveParts", 2.0, ("check.dp", "check.q"), 2001)
    dp, q = record["check.dp"], record["check.q"]
    assert (q[dp <= 2e5] == 0).all()
    full = dp >= 5e5
    assert full.sum() > 200
    assert np.allclose(q[full], 1e-6 * np.sqrt(2 / 875 * dp[full]), rtol=1e-3, atol=0)  # smoothing at 5 bar: 1e-4


def test_energy_of_a_closed_hose_falls_at_all_times() -> None:
    """Solver's error beside it: 1e-8 of the energy in each of 200 steps."""
    energy = ran("Validation.HoseMode", 0.1, ("energy",), 2001)["energy"]
    assert np.diff(energy).max() < 2e-6 * energy[0]
    assert energy[-1] < 0.25 * energy[0]


@pytest.mark.parametrize("segments", [6, 12])
def test_first_resonance_of_a_hose_is_that_of_the_wave_equation(segments: int) -> None:
    """Zero crossings against c/2l: low by (pi/2n)^2/6 of the segments and 1/(2 (omega/sigma)^2) of damping."""
    model = built("Validation.HoseMode", (("n", segments),))
    record = ran(model, 0.1, ("hose.port_a.p", "omega_line"), 4001)
    pressure, time = record["hose.port_a.p"], record.time
    last = np.flatnonzero(np.diff(np.sign(pressure)) != 0)
    crossings = time[last] - pressure[last] * np.diff(time)[last] / np.diff(pressure)[last]
    found = np.pi * (crossings.size - 1) / (crossings[-1] - crossings[0])
    line = np.pi * np.sqrt(1 / (1 / 1.4e9 + 1 / 350e6) / 875) / 3
    assert record["omega_line"][0] == pytest.approx(line, rel=1e-12)
    assert 1 - found / line == pytest.approx((np.pi / 2 / segments) ** 2 / 6, rel=0.05)


def test_wall_damping_is_its_loss_factor() -> None:
    """The energy of a mode of angular frequency w falls by w^2 T_w per second, and by 32 nu/d^2 of laminar friction."""
    record = ran("Validation.HoseMode", 0.1, ("energy", "omega_line"), 2001, {"hose.T_w": 1e-4})
    omega = 12 * 2 * np.sin(np.pi / 24) / np.pi * record["omega_line"][0]
    decay = -np.polyfit(record.time, np.log(record["energy"]), 1)[0]
    expected = omega**2 * 1e-4 + 32 * 46e-6 / 0.01**2
    assert decay == pytest.approx(expected, rel=0.01)  # the losses swing within a period


def colebrook(reynolds: float, roughness: float) -> float:
    """Darcy's friction factor."""
    return float(
        brentq(lambda f: 1 / np.sqrt(f) + 2 * np.log10(roughness / 3.7 + 2.51 / (reynolds * np.sqrt(f))), 0.005, 0.2)
    )


@pytest.mark.parametrize("roughness", [0.0, 1e-3])
def test_pipe_friction_is_laminar_then_turbulent(roughness: float) -> None:
    d, rho, nu = 0.01, 875.0, 46e-6
    q, gradient = curve("pipeFriction", f"{d}, {rho}, {nu}, {roughness}", -2e-2, 2e-2)
    speed = 4 * q / (np.pi * d**2)
    reynolds = np.abs(speed) * d / nu
    slow = reynolds < 800
    assert slow.sum() > 20
    assert np.allclose(gradient[slow], (32 * rho * nu * speed / d**2)[slow], rtol=1e-4, atol=1e-6)
    fast = np.flatnonzero(reynolds > 5000)
    exact = [colebrook(reynolds[i], roughness) * rho / (2 * d) * speed[i] * abs(speed[i]) for i in fast[::50]]
    assert np.allclose(gradient[fast[::50]], exact, rtol=0.04)  # Churchill's own claim is some percent
    assert (np.diff(gradient) > 0).all()


HOSE = "HydraulicTestBench.Hydraulics.Hose {}(l=1, d=0.01, n=2, beta=1.4e9, rho=875);"
BEHIND = {  # part: its declaration, its port, its pressure, its compliance in m3/Pa
    "hose": (HOSE, "port_a", "p[3]", np.pi / 4 * 1e-4 / 280e6),
    "volume": ("HydraulicTestBench.Hydraulics.Volume {}(V=1e-3, beta=1.4e9);", "port_a", "p", 1e-3 / 1.4e9),
    "chamber": ("HydraulicTestBench.Hydraulics.Chamber {}(V=1e-3, kappa=0, beta=1.4e9);", "port", "p", 1e-3 / 1.4e9),
}


@pytest.mark.slow
def test_hose_as_it_comes_joins_what_gives_a_pressure_too(tmp_path: Path) -> None:
    """What is pumped in for a second spreads over the compliances of the hose and of what is behind it."""
    declared, connected = "", ""
    for part, (declaration, port, _, _) in BEHIND.items():
        declared += f"  {HOSE.format(f'to_{part}')}\n  {declaration.format(part)}\n"
        declared += f"  HydraulicTestBench.Hydraulics.FlowSource into_{part}(q=1e-5);\n"
        connected += f"  connect(into_{part}.port, to_{part}.port_a);\n  connect(to_{part}.port_b, {part}.{port});\n"
    text = tmp_path / "Joined.mo"
    text.write_text(f"model Joined\n{declared}equation\n{connected}end Joined;\n")
    names = {part: (f"to_{part}.p[1]", f"{part}.{pressure}") for part, (_, _, pressure, _) in BEHIND.items()}
    record = ran(built("Joined", (), (text,)), 1.0, [name for pair in names.values() for name in pair])
    for part, (_, _, _, compliance) in BEHIND.items():
        expected = 1e-5 / (compliance + np.pi / 4 * 1e-4 / 280e6)
        for name in names[part]:  # apart by friction and by what T_w holds back
            assert record[name][-1] == pytest.approx(expected, rel=1e-3), name


def test_two_volumes_at_a_node_fill_as_one(tmp_path: Path) -> None:
    text = tmp_path / "Two.mo"
    text.write_text("""model Two
  HydraulicTestBench.Hydraulics.FlowSource source(q=1e-5);
  HydraulicTestBench.Hydraulics.Volume first(V=1e-3, beta=1.4e9, p_start=10e5);
  HydraulicTestBench.Hydraulics.Volume second(V=3e-3, beta=1.4e9, p(fixed=false));
equation
  connect(source.port, first.port_a);
  connect(first.port_b, second.port_a);
end Two;
""")
    record = ran(built("Two", (), (text,)), 1.0, ("first.p", "second.p"))
    for name in ("first.p", "second.p"):
        assert np.allclose(record[name], 10e5 + 1.4e9 / 4e-3 * 1e-5 * record.time, rtol=1e-9), name


def test_hose_with_air_is_softer_at_low_pressure(tmp_path: Path) -> None:
    """Its first resonance by the stiffness of oil with air beside the wall, at 2 and at 100 bar."""
    hoses, recorded = "", {bar: f"hose{bar}.p[1]" for bar in (2, 100)}
    for bar in recorded:
        shape = f"p(start={{{', '.join(str(bar * 1e5 + 100 * s) for s in (1, 0.5, -0.5, -1))}}})"
        hoses += f"  HydraulicTestBench.Hydraulics.Hose hose{bar}(l=3, d=0.01, n=3, beta=1.4e9, rho=875, T_w=0,\n"
        hoses += f"    redeclare HydraulicTestBench.Hydraulics.Fluids.EntrainedAir fluid(each eps=0.02), {shape});\n"
    text = tmp_path / "Airy.mo"
    text.write_text(f"model Airy\n{hoses}end Airy;\n")
    record = ran(built("Airy", (), (text,)), 1.0, tuple(recorded.values()), 8001)
    found = {}
    for bar, name in recorded.items():
        swing = record[name] - bar * 1e5
        turns = np.flatnonzero(np.diff(np.sign(swing)) != 0)
        found[bar] = (turns.size - 1) / (record.time[turns[-1]] - record.time[turns[0]]) / 2
        absolute = bar * 1e5 + 1.013e5
        compliance = 1 / 1.4e9 + 1 / 350e6 + 0.02 * (1.013e5 / absolute) ** (1 / 1.4) / (1.4 * absolute)
        segments = 2 * 3 / 3 * np.sin(np.pi / 6) / (2 * np.pi)
        assert found[bar] == pytest.approx(segments / np.sqrt(875 * compliance), rel=0.01)
    assert found[2] < 0.5 * found[100]
