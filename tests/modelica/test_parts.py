"""Parts that no other closed form reaches, in one model: sources, delays, a plate, a hose, a motor, a drum."""

import numpy as np
import pytest
from scipy.linalg import expm

from pysim.types import Record
from tests.modelica.built import built, ran

OFFSET, AMPLITUDE, F, HEIGHT, FLOW = 20.0, 8.0, 3.0, 30.0, 1e-4
PARTS = f"""model Parts
  import L = HydraulicTestBench;
  L.Sources.SteppedSine sine(offset={OFFSET}, amplitude={AMPLITUDE}, f={F}, t_ramp=0.1, t_hold=0.3, t_sine=0.4);
  L.Sources.Constant held(k=-7);
  L.Sources.Constant zero;
  L.Sources.Step step(height={HEIGHT}, t_step=0.2);
  L.Pump.TransportDelay delayed(tau=0.03);
  L.Pump.CommandRateInput fed;
  L.Pump.BlackBoxPlate plate(alphaMAX=0.25);
  L.Hydraulics.PrescribedFlow source;
  L.Hydraulics.Hose hose(l=2, d=0.01, n=3, beta=1.4e9, rho=875, q_start={FLOW});
  L.Hydraulics.Tank tank;
  L.Hydraulics.Tank high(p=180e5);
  L.Hydraulics.Tank low(p=30e5);
  L.Hydraulics.VariableMotor motor(redeclare L.Mechanics.MachineLoss torqueLoss(tau_0=2, V_loss=4e-6));
  L.Mechanics.ConstantSpeed drive(w=50);
  L.Mechanics.Inertia wheel(J=2, phi(fixed=false), w(fixed=false));
  L.Mechanics.Drum drum(r_d=0.1);
  L.Mechanics.Mass mass(m=30);
equation
  delayed.s = sine.y;
  fed.s = sine.y;
  fed.s_t = sine.y_t;
  plate.alphaCMD = {HEIGHT};
  plate.alphaCMD_t = 0;
  source.Q = {FLOW};
  connect(source.port, hose.port_a);
  connect(hose.port_b, tank.port);
  motor.alpha = motor.alphaMAX/2;
  connect(high.port, motor.port_A);
  connect(low.port, motor.port_B);
  connect(tank.port, motor.port_D);
  connect(motor.shaft, drive.flange);
  connect(wheel.flange_b, drum.shaft);
  connect(drum.wire, mass.flange_a);
end Parts;
"""
SEEN = ("sine.y", "sine.y_t", "step.y", "delayed.y", "fed.rate", "plate.alphaPercent", "plate.alpha", "plate.alpha_t")
SEEN += ("hose.port_a.p", "hose.port_b.p", "hose.port_b.q", "drive.tau", "high.port.q", "mass.s", "wheel.phi")
SEEN += ("held.y", "zero.y")


@pytest.fixture(scope="module")
def record(tmp_path_factory: pytest.TempPathFactory) -> Record:
    file = tmp_path_factory.mktemp("parts") / "Parts.mo"
    file.write_text(PARTS, encoding="utf-8")
    return ran(built("Parts", (), (file,)), 1.0, SEEN, 1001)


def command(t: np.ndarray) -> np.ndarray:
    """Ramp from 0.1 to 0.3 s, hold, sine from 0.4 s on."""
    ramp = OFFSET * np.interp(t, [0.1, 0.3], [0, 1])
    return np.where(t < 0.4, ramp, OFFSET + AMPLITUDE * np.sin(2 * np.pi * F * (t - 0.4)))


def test_stepped_sine_and_its_rate(record: Record) -> None:
    t = record.time
    assert np.allclose(record["sine.y"], command(t), atol=1e-9)
    between = np.min(np.abs(t[:, None] - [0.1, 0.3, 0.4]), axis=1) > 1e-6  # where its rate jumps
    h = 1e-7
    slope = (command(t + h) - command(t - h)) / (2 * h)
    assert np.allclose(record["sine.y_t"][between], slope[between], atol=1e-5)
    assert np.array_equal(record["fed.rate"], record["sine.y_t"])


def test_step_comes_at_its_time_and_a_constant_stays(record: Record) -> None:
    assert (record["held.y"] == -7).all()
    assert (record["zero.y"] == 0).all()
    away = np.abs(record.time - 0.2) > 1e-6
    assert np.array_equal(record["step.y"][away], np.where(record.time < 0.2, 0, HEIGHT)[away])


def test_true_delay_gives_the_same_later(record: Record) -> None:
    assert np.allclose(record["delayed.y"], command(record.time - 0.03), atol=1e-5)  # straight lines between steps


def test_black_box_plate_is_its_transfer_function(record: Record) -> None:
    """Step response of b_0/(s^5 + a_4 s^4 + ... + a_0), thesis Eq. 4.1, by the companion matrix."""
    a = np.array([60185e6, 1429e6, 11612e3, 88408.0, 191.0])
    scale = 100.0 ** np.arange(5)  # the k-th derivative in units of 100^k/s^k
    companion = np.vstack([np.eye(5)[1:], -a]) * scale / scale[:, None]
    rest = np.array([62091e6 / a[0] * HEIGHT, 0, 0, 0, 0])
    for k in range(0, record.time.size, 50):
        z = (rest - expm(companion * record.time[k]) @ rest) * scale
        assert record["plate.alphaPercent"][k] == pytest.approx(z[0], abs=1e-5)
        assert record["plate.alpha"][k] == pytest.approx(z[0] / 100 * 0.25, abs=1e-7)
        assert record["plate.alpha_t"][k] == pytest.approx(z[1] / 100 * 0.25, abs=1e-5)


def test_pressure_falls_along_a_hose_from_a_to_b(record: Record) -> None:
    """Laminar flow at rest: 32 rho nu v l/d^2; Churchill's formula adds less than 1e-4 at a Reynolds number of 277."""
    speed = 4 * FLOW / (np.pi * 0.01**2)
    assert record["hose.port_b.p"][-1] == 0
    assert record["hose.port_b.q"][-1] == pytest.approx(-FLOW, rel=1e-6)
    assert record["hose.port_a.p"][-1] == pytest.approx(32 * 875 * 46e-6 * speed * 2 / 0.01**2, rel=2e-4)


def test_motor_gives_its_torque_less_what_it_loses(record: Record) -> None:
    """Eq. 5.7 and 5.8 at half the angle, and 2 N m beside 4 cm3 of loss per revolution, at 150 bar."""
    displacement = 30e-6 / (2 * np.pi)
    torque = displacement * 150e5 - (2 + 4e-6 / (2 * np.pi) * 150e5)
    assert np.allclose(record["drive.tau"], -torque, rtol=1e-9)
    assert np.allclose(-record["high.port.q"], displacement * 50, rtol=1e-9)


def test_mass_falls_and_turns_the_wheel_of_its_drum(record: Record) -> None:
    """(m + J/r^2) a = -m g."""
    fall = 0.5 * 30 * 9.81 / (30 + 2 / 0.1**2) * record.time**2
    assert np.allclose(record["mass.s"], -fall, atol=1e-7)
    assert np.allclose(record["wheel.phi"], -fall / 0.1, atol=1e-6)
