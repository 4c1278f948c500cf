"""The test bench of two motors: steady states and balances by hand, its pulse counter, its slots, its controllers."""

import json
from collections.abc import Mapping
from pathlib import Path

import numpy as np
import pytest

import fmu_build
from pysim.simulate import Rodas, simulate
from pysim.types import Experiment, Model, Record, Signal
from tests.contracts.fmu import Fmu
from tests.modelica.built import built

TABLES = json.loads((Path(__file__).parent / "thesis_tables.json").read_text(encoding="utf-8"))
K = 60e-6 / (2 * np.pi)  # m3/rad
RHO, BETA, P_SL, K_SV = 875.0, 1.4e9, 310e5, 1.863e-5
GREY = """model GreyRig
  extends HydraulicTestBench.LoadCircuit.OpenTestBench(
    redeclare HydraulicTestBench.Pump.GreyBoxPlate plate,
    redeclare HydraulicTestBench.Effects.ShaftFriction shaftFriction(tau_c=14.8939, tau_s=54.8258));
end GreyRig;
model GreyBench
  extends HydraulicTestBench.LoadCircuit.TestBench(redeclare GreyRig rig);
end GreyBench;
"""
COMPLIANT = """model Compliant
  extends HydraulicTestBench.LoadCircuit.OpenTestBench(
    redeclare HydraulicTestBench.Mechanics.Coupling coupling(k_t=2000, d_t=0.1),
    redeclare HydraulicTestBench.Effects.HoseCompliance hoses(V=1e-3, T=7e-4));
end Compliant;
"""


def written(folder: Path, text: str, name: str) -> Model:
    file = folder / f"{name}.mo"
    file.write_text(text)
    return built(name, (), (file,))


def driven(model: Model, stop: float, recorded: tuple[str, ...], inputs: Mapping[str, Signal], points: int) -> Record:
    run = Experiment(np.linspace(0, stop, points), recorded, inputs)
    return simulate(model, run, solver=Rodas(rtol=1e-7, atol=1e-7))


def steps(model: Model, stop: float, recorded: tuple[str, ...], points: int = 801, **inputs: float) -> Record:
    """Each input from 0 to its value in 0.1 s."""
    ramps = {name: Signal.lines([0, 0.1, stop + 1], [0, value, value]) for name, value in inputs.items()}
    return driven(model, stop, recorded, ramps, points)


@pytest.mark.parametrize("table", TABLES["appendix_G"])
def test_names_of_appendix_g(table: str) -> None:
    names = {variable.name for variable in built("LoadCircuit.TestBench").variables}
    assert set(TABLES["appendix_G"][table]) - names == set()


def test_supply_pressure_is_what_the_gains_of_table_5_1_imply() -> None:
    table = TABLES["table_5_1"]
    low, high = (RHO * ((table["K_qu"] + half) / K_SV) ** 2 for half in (-0.5e-4, 0.5e-4))
    by_pressure_gain = (0.1 * K_SV / (2 * table["K_qp"])) ** 2 / RHO
    assert low < P_SL < high
    assert by_pressure_gain == pytest.approx(P_SL, rel=0.02)
    assert built("LoadCircuit.OpenTestBench")["p_sL"].start == P_SL


def test_open_bench_comes_to_the_speed_of_the_pump_s_flow() -> None:
    names = ("omega", "pS", "pL", "Q_P", "T_s", "T_L", "tau_v", "u_sv", "volume_sB.p", "volume_LA.p", "volume_LB.p")
    record = steps(built("LoadCircuit.OpenTestBench"), 30.0, names, alphaCMD=20.0, u_ref=-0.08)
    end = {name: float(record[name][-1]) for name in names}
    flow = 62091 / 60185 * 0.2 * 71e-6 * 1450 / 60
    assert end["Q_P"] == pytest.approx(flow, rel=1e-6)
    assert end["omega"] == pytest.approx(flow / K, rel=1e-4)
    assert end["T_s"] - end["T_L"] == pytest.approx(0.26 * end["omega"], rel=1e-3)
    assert end["tau_v"] == pytest.approx(0.26 * end["omega"], rel=1e-12)
    # u < 0 joins A to the tank: both edges pass what the motor pumps, K omega, and share the pressure
    edge = (K * end["omega"] / (0.08 * K_SV)) ** 2 * RHO / 2
    assert end["volume_LA.p"] == pytest.approx(edge, rel=1e-3)
    assert end["volume_LB.p"] == pytest.approx(P_SL - edge, rel=1e-3)
    assert end["volume_sB.p"] > 24e5


def test_refill_holds_the_closed_circuit_above_25_bar() -> None:
    record = steps(built("LoadCircuit.OpenTestBench"), 10.0, ("volume_sA.p", "volume_sB.p"), alphaCMD=-30.0, u_ref=0.1)
    assert min(record["volume_sA.p"].min(), record["volume_sB.p"].min()) > 24e5


def test_energy_balances_of_circuits_and_shaft() -> None:
    errors = ("error", "error_s", "error_L")
    record = simulate(
        built("Validation.BenchEnergy"), Experiment(np.linspace(1, 60, 600), (*errors, "passed")), solver=Rodas()
    )
    assert record["passed"][-1] > 5e4
    for error in errors:
        assert np.abs(record[error]).max() < 1e-3, error  # 0.1 percent


PULSES = """model Pulses
  HydraulicTestBench.LoadCircuit.PulseCounter counter;
  HydraulicTestBench.Mechanics.PrescribedSpeed drive;
  Real angle = 9*sin(0.7*time);
equation
  drive.w = 6.3*cos(0.7*time);
  counter.direction = 50*cos(0.7*time);
  connect(drive.flange, counter.flange);
end Pulses;
"""


def test_pulse_counter_at_its_events(tmp_path: Path) -> None:
    """The swing 9 sin(0.7 t): a pulse at each 36 degrees since the last, found here from the closed form."""
    pitch, last, edges = 2 * np.pi / 10, 0.0, []
    fine = np.linspace(0, 12, 1_200_001)
    angle = 9 * np.sin(0.7 * fine)
    at = 0
    while True:
        beyond = np.flatnonzero(np.abs(angle[at:] - last) > pitch)
        if not beyond.size:
            break
        at += int(beyond[0])
        last += pitch * np.sign(angle[at] - last)
        edges.append(fine[at])
    names = ("counter.count", "counter.EventTimer", "counter.omegaS", "counter.EventOmega", "counter.absMe")
    record = simulate(
        written(tmp_path, PULSES, "Pulses"), Experiment(np.linspace(0, 12, 2401), names), solver=Rodas(rtol=1e-9)
    )
    counted = np.searchsorted(edges, record.time, side="right")
    assert np.abs(record["counter.count"] - counted).max() <= 1  # a sample on an edge
    assert record["counter.count"][-1] == len(edges)
    assert record["counter.EventTimer"][-1] == pytest.approx(edges[-1], abs=2e-5)
    assert record["counter.absMe"].max() <= pitch * (1 + 1e-9)
    gaps = np.diff(edges)
    sign = np.sign(np.cos(0.7 * record.time))
    calm = (np.abs(np.cos(0.7 * record.time)) > 0.1) & (counted > 1) & (record["counter.count"] == counted)
    expected = pitch / gaps[np.clip(counted[calm] - 2, 0, None)]
    assert np.abs(record["counter.omegaS"][calm] - sign[calm] * expected).max() < 1e-3
    turn = np.abs(record.time - np.pi / 1.4) < 0.2  # about standstill the last speed stays
    assert np.ptp(np.abs(record["counter.omegaS"][turn])) < 1.5
    assert np.abs(record["counter.omegaS"][turn]).min() > 0.8


TURNED = """model Turned
  parameter Real phi = 0;
  parameter Real w = 0;
  HydraulicTestBench.Mechanics.Inertia inertia(J=0.1, phi(start=phi), w(start=w));
  HydraulicTestBench.Mechanics.PulseSensor sensor;
  HydraulicTestBench.LoadCircuit.PulseCounter counter;
equation
  sensor.direction = w;
  counter.direction = w;
  connect(inertia.flange_b, sensor.flange);
  connect(inertia.flange_b, counter.flange);
end Turned;
"""


@pytest.mark.parametrize(("phi", "w"), [(1.0, 20.0), (1.0, -20.0), (-7.3, 20.0), (100.0, -20.0)])
def test_speed_is_measured_wherever_the_shaft_starts(phi: float, w: float, tmp_path: Path) -> None:
    """At even speed: the counter's first pulse a pitch from the start, the sensor's where its next tooth begins."""
    names = ("sensor.w", "sensor.count", "counter.omegaS", "counter.count")
    run = Experiment(np.linspace(0, 1, 101), names, overrides={"phi": phi, "w": w})
    record = simulate(written(tmp_path, TURNED, "Turned"), run, solver=Rodas())
    tenths = np.array([phi, phi + w]) * 10 / (2 * np.pi)
    teeth = np.diff(np.floor(tenths) if w > 0 else np.ceil(tenths + 0.5))[0]
    assert record["sensor.count"][-1] == abs(teeth)
    assert record["counter.count"][-1] == int(abs(w) * 10 / (2 * np.pi))
    for name in ("sensor.w", "counter.omegaS"):
        assert (record[name][:2] == 0).all(), name
        assert np.allclose(record[name][record.time > 0.1], w, rtol=1e-6), name


def from_the_start(name: str, stop: float, recorded: tuple[str, ...], **inputs: float) -> Record:
    """Each input at its value from the first instant on."""
    held = {name: Signal.constant(value) for name, value in inputs.items()}
    return driven(built(f"LoadCircuit.{name}"), stop, recorded, held, 301)


def test_measured_speed_has_the_sign_of_a_command_that_is_there_from_the_start() -> None:
    """The bench is its own mirror image, and so is what its counter says."""
    names = ("omega", "omegaS")
    back = from_the_start("OpenTestBench", 3.0, names, alphaCMD=-30.0, u_ref=0.05)
    forth = from_the_start("OpenTestBench", 3.0, names, alphaCMD=30.0, u_ref=-0.05)
    assert back["omega"][-1] < -40
    assert back["omegaS"][-1] == pytest.approx(back["omega"][-1], rel=0.01)
    for name in names:
        assert np.allclose(back[name][::50], -forth[name][::50], rtol=1e-4, atol=0)


def test_controlled_bench_comes_to_a_negative_speed_asked_for_from_the_start() -> None:
    record = from_the_start("TestBench", 20.0, ("contOmega", "omegaS"), omegaS_ref=-20.0)
    assert record["contOmega"][-1] == pytest.approx(-20.0, rel=1e-3)
    assert record["omegaS"][-1] == pytest.approx(-20.0, rel=1e-3)


class At:
    """Derivatives of a bench at a state. Use as a context manager."""

    def __init__(self, path: Path, folder: Path) -> None:
        self.fmu = Fmu.unpack(path, folder, 2)

    def __enter__(self) -> "At":
        self.instance = self.fmu.open("me").start()
        return self

    def __exit__(self, *failure: object) -> None:
        self.instance.__exit__(*failure)

    def rates(self, states: Mapping[str, float], parameters: Mapping[str, float]) -> dict[str, float]:
        self.instance.set_in_event_mode(parameters)
        self.instance.x = [states.get(name, 0.0) for name in self.fmu.states]
        return dict(zip(self.fmu.states, self.instance.dx.tolist(), strict=True))


STATE = {"volume_sA.p": 90e5, "volume_sB.p": 40e5, "volume_LA.p": 120e5, "volume_LB.p": 170e5}
STATE |= {"inertiaS.w": 3.0, "spool.u": -0.06, "plate.z[1]": 12.0}


def test_base_model_is_eq_5_10_and_5_24(tmp_path: Path) -> None:
    plain = fmu_build.build("HydraulicTestBench.LoadCircuit.OpenTestBench")
    with At(plain, tmp_path / "b") as base:
        rates = base.rates(STATE, {})
    torque = K * 50e5 - K * -50e5 - 0.26 * 3
    assert rates["inertiaS.w"] == pytest.approx(torque / 0.0733, rel=1e-9)
    flow = 0.12 * 71e-6 * 1450 / 60 - K * 3
    assert rates["volume_sA.p"] == pytest.approx(BETA / 1.52e-3 * flow, rel=1e-9)
    out = 0.06 * K_SV * np.sqrt(2 / RHO * 120e5)  # A to the tank
    assert rates["volume_LA.p"] == pytest.approx(BETA / 1.01e-3 * (K * 3 - out), rel=1e-6)
    into = 0.06 * K_SV * np.sqrt(2 / RHO * 140e5)  # P to B
    assert rates["volume_LB.p"] == pytest.approx(BETA / 1.01e-3 * (into - K * 3), rel=1e-6)


@pytest.mark.slow
def test_coupling_and_hoses_end_where_the_stiff_bench_does(tmp_path: Path) -> None:
    names = ("omega", "pS", "pL")
    soft = steps(written(tmp_path, COMPLIANT, "Compliant"), 30.0, names, alphaCMD=20.0, u_ref=-0.08)
    stiff = steps(built("LoadCircuit.OpenTestBench"), 30.0, names, alphaCMD=20.0, u_ref=-0.08)
    for name in names:
        assert soft[name][-1] == pytest.approx(stiff[name][-1], rel=2e-3)
        assert np.abs(soft[name] - stiff[name]).max() > 1e-3 * np.abs(stiff[name]).max()


def test_controllers_leave_no_error_at_rest() -> None:
    """Thesis Section 6.4: steps of speed and of load pressure; the pulses hold the speed to their resolution."""
    names = ("omegaS", "contOmega", "pL", "Tf")
    record = steps(built("LoadCircuit.TestBench"), 40.0, names, omegaS_ref=30.0, pL_ref=40e5)
    assert record["contOmega"][-1] == pytest.approx(30.0, rel=1e-3)
    assert record["omegaS"][-1] == pytest.approx(record["contOmega"][-1], rel=1e-3)
    assert record["pL"][-1] == pytest.approx(40e5, rel=1e-3)
    law = np.tanh(13.8806 * 30) * (14.8939 + (54.8258 - 14.8939) * np.exp(-30 / 8.3593))
    assert record["Tf"][-1] == pytest.approx(law, rel=1e-3)


OTHER = {"rig.V_d_max": 50e-6, "rig.w_P": 200.0, "rig.alphaMAX": 0.2}
FED = {  # bench: its motors' displacement, its load controller's command and the PI part of that
    "TestBench": ("Vm_max", "load.limit1", "load.pI2"),
    "SampledTestBench": ("rig.Vm_max", "load.u_ref", "load.pi"),
}


@pytest.mark.parametrize("bench", FED)
def test_what_is_fed_forward_follows_the_bench(bench: str) -> None:
    """Eq. 5.35 and 5.37; below 2 rad/s nothing else drives the pump."""
    motors, command, part = FED[bench]
    inputs = {"omegaS_ref": Signal.constant(1.5), "pL_ref": Signal.constant(0.0)}
    record = simulate(
        built(f"LoadCircuit.{bench}"),
        Experiment(np.array([0.1]), ("rig.alphaCMD", command, part), inputs, {**OTHER, motors: 80e-6}),
        solver=Rodas(),
    )
    assert record["rig.alphaCMD"][-1] == pytest.approx(100 * 80e-6 * 1.5 / (50e-6 * 200.0), rel=1e-9)
    opening = record[command][-1] - record[part][-1]
    assert opening == pytest.approx(-80e-6 / (2 * np.pi) / 0.0035 * 1.5, rel=1e-9)


@pytest.mark.slow
def test_bench_with_the_grey_box_in_its_pump(tmp_path: Path) -> None:
    record = steps(written(tmp_path, GREY, "GreyBench"), 40.0, ("contOmega", "pL"), omegaS_ref=30.0, pL_ref=40e5)
    assert record["contOmega"][-1] == pytest.approx(30.0, rel=2e-3)
    assert record["pL"][-1] == pytest.approx(40e5, rel=2e-3)
