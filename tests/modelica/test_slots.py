"""The slots of the pump: each sits where the equations say.

All slots are filled at once, the pump is run, and the thesis' equations, with the fillings' terms in them, are
checked on the result. A slot wired to the wrong variable, or with the wrong sign, breaks one of these identities.
"""

import html
import re
from pathlib import Path

import numpy as np
import pytest

from tests.modelica.library import LIBRARY, Run, compiled, run

FILLINGS = (Path(__file__).parent / "slot_fillings.mo").read_text(encoding="utf-8")
PARAMETERS = {"A_p": 401.33e-6, "V_0": 0.0607e-3, "m_eff": 62.384, "k": 13.445e3, "b": 13.422e3, "L": 47.011e-3}
PARAMETERS |= {"K_p": 42.445, "K_D": 0.24111, "T_d": 0.0040576, "omega_v": 2 * np.pi * 28.05, "zeta_v": 0.82031}
ALPHA_MAX, BETA, P_S, RHO = np.radians(15), 1.4e9, 170e5, 875.0
ALL_AT_ONCE = """
  redeclare SlotFillings.ErrorDeadZone angleError(e_0=1e-4),
  redeclare SlotFillings.ValveOffset cardOutput(u_n=1e-3),
  redeclare SlotFillings.CommandHysteresis spoolCommand(h=3e-3),
  redeclare SlotFillings.ValveRateLimit spool(inverse_r_max=0.5),
  redeclare SlotFillings.ValveDeadband spoolOpening(u_0=5e-3),
  redeclare SlotFillings.SupplyDroop supply(R=2e10),
  redeclare SlotFillings.EntrainedAir oil(eps=5e-3),
  redeclare SlotFillings.LaminarLeakage internalLeakage(C_l=1e-13),
  redeclare SlotFillings.LeakageToTank externalLeakage(C_e=1e-13),
  redeclare SlotFillings.TwoForces pistonForce(F=50),
  redeclare SlotFillings.LinkageBacklash linkage(d=2e-5),
  redeclare SlotFillings.SensorLag angleSensor(T_f=1e-3)
"""


def pump_with(redeclarations: str) -> str:
    """Modelica text of a complete model `Bench`: three growing sines into a pump with filled slots."""
    return f"""{FILLINGS}
model Pump
  extends HydraulicTestBench.Pump.SwashPlateControl({redeclarations});
end Pump;
model Bench
  HydraulicTestBench.Sources.GrowingSines command;
  Pump pump;
equation
  connect(command.y, pump.alphaCMD);
  connect(command.y_t, pump.alphaCMD_t);
end Bench;
"""


@pytest.fixture(scope="module")
def filled() -> Run:
    return run(compiled("Bench", pump_with(ALL_AT_ONCE)), 1.0, points=1001, tolerance=1e-7)


def test_each_filling_arrives_in_its_slot() -> None:
    """Its strength exists under the slot's name, in a model that stays balanced."""
    model = compiled("Bench", pump_with(ALL_AT_ONCE))
    strengths = re.findall(r"redeclare SlotFillings\.\w+ (\w+)\((\w+)=", ALL_AT_ONCE)
    assert len(strengths) == 12
    assert {f"pump.{slot}.{name}" for slot, name in strengths} <= set(model.to_dict("flat")["variables"])
    assert model.structure().is_balanced


@pytest.mark.parametrize(("name", "parameters"), [("PumpWithFriction", {"F_c"}), ("PumpWithBoth", {"F_c", "F_0"})])
def test_recipe_of_the_guide_compiles(name: str, parameters: set[str]) -> None:
    guide = (LIBRARY / "UsersGuide" / "AddAnEffect.mo").read_text(encoding="utf-8")
    recipe = "\n".join(html.unescape(text) for text in re.findall(r"<pre>(.*?)</pre>", guide, re.DOTALL))
    model = compiled(name, recipe)
    assert parameters <= {variable.split(".")[-1] for variable in model.to_dict("flat")["variables"]}
    assert model.structure().is_balanced


def assert_equal(left: np.ndarray, right: np.ndarray, scale: float) -> None:
    """Both sides agree to rounding; `scale` is the size of their terms, and the sides are far from zero."""
    assert np.abs(left).max() > 1e-3 * scale
    assert np.abs(left - right).max() < 1e-9 * scale


def test_force_joins_the_balance_of_the_piston(filled: Run) -> None:
    p = PARAMETERS
    pressure_force = (filled["pump.p1"] - filled["pump.p2"]) * p["A_p"]
    rest = -p["k"] * filled["pump.xp"] - p["b"] * filled["pump.xp_t"]
    extra = -50 * np.tanh(filled["pump.xp_t"] / 1e-3) - 50 * np.tanh(filled["pump.xp"] / 0.2e-3)
    assert np.abs(extra).max() > 50
    assert_equal(p["m_eff"] * filled["pump.xp_tt"], pressure_force + rest + extra, 1e3)


@pytest.mark.parametrize("chamber", [1, 2])
def test_leakage_and_air_join_the_balance_of_a_chamber(filled: Run, chamber: int) -> None:
    sign = 1 if chamber == 1 else -1
    pressure = filled[f"pump.p{chamber}"]
    across = 1e-13 * (filled["pump.p1"] - filled["pump.p2"])
    valve = filled["pump.Q1"] if chamber == 1 else -filled["pump.Q2"]
    displaced = PARAMETERS["A_p"] * filled["pump.xp_t"]
    flow = valve - sign * (displaced + filled["pump.QL"] + across) - 1e-13 * pressure
    absolute = pressure + 1.013e5
    compressibility = 1 / BETA + 5e-3 * (1.013e5 / absolute) ** (1 / 1.4) / (1.4 * absolute)
    volume = PARAMETERS["V_0"] + sign * PARAMETERS["A_p"] * filled["pump.xp"]
    # the volume's floor of 0.1 cm3 adds a share of up to 1e-7
    left = filled[f"pump.p{chamber}_t"] * volume * compressibility
    assert np.abs(left).max() > 1e-8
    assert np.abs(left - flow).max() < 1e-6 * np.abs(left).max() + 1e-13


def test_edges_see_the_opening_and_the_drooping_supply(filled: Run) -> None:
    opening = np.sign(filled["pump.u"]) * np.maximum(np.abs(filled["pump.u"]) - 5e-3, 0)
    size = np.minimum(np.abs(opening), 1)
    area = -4.67e-6 * size**3 + 6.6454e-6 * size**2 + 0.967e-6 * size
    assert_equal(filled["pump.K"], area, 1e-6)
    supply = P_S - filled["pump.supply.dp"]
    assert filled["pump.supply.dp"].max() > 1e5
    difference = np.where(opening >= 0, supply, 0) - filled["pump.p1"]
    flow = area * np.sqrt(2 / RHO) * difference / (difference**2 + 1e8) ** 0.25
    assert_equal(filled["pump.Q1"], flow, 1e-5)
    delivered = np.where(opening >= 0, filled["pump.Q1"], -filled["pump.Q2"])
    assert_equal(filled["pump.supply.Q"], delivered, 1e-5)


def test_card_works_on_what_its_slots_give(filled: Run) -> None:
    p = PARAMETERS
    seen = filled["pump.angleSensor.y"]
    error = filled["pump.alphaCMD"] / 100 * ALPHA_MAX - seen
    rate = filled["pump.alphaCMD_t"] / 100 * ALPHA_MAX - filled["pump.angleSensor.y_t"]
    beyond = np.abs(error) > 1e-4
    assert beyond.any()
    assert not beyond.all()
    passed = np.where(beyond, error - 1e-4 * np.sign(error), 0)
    assert_equal(filled["pump.P_Cont"], p["K_p"] * passed, 1)
    assert_equal(filled["pump.PD_Prop"], p["K_D"] * (p["K_p"] * passed - filled["pump.u"]), 0.1)
    # the told rate reaches the controller through the observer, which leaves the solver's error times 3/T
    derivative = p["K_D"] * p["T_d"] * (p["K_p"] * np.where(beyond, rate, 0) - filled["pump.u_t"])
    assert np.abs(filled["pump.PD_Der"] - derivative).max() < 1e-5
    assert_equal(filled["pump.alphaPercent"], 100 * seen / ALPHA_MAX, 100)


def test_command_passes_card_output_and_play_ahead_of_the_dead_time(filled: Run) -> None:
    command = filled["pump.PD_Prop"] + filled["pump.PD_Der"] + 1e-3
    assert_equal(filled["pump.spoolCommand.s"], command, 0.1)
    assert_equal(filled["pump.deadTime.s"], filled["pump.spoolCommand.y"], 0.1)
    assert np.abs(filled["pump.deadTime.s"] - command).max() > 2e-3  # the play of 3e-3 is felt


def test_spool_keeps_its_limit_and_its_parameters(filled: Run) -> None:
    p = PARAMETERS
    assert np.abs(filled["pump.u_t"]).max() == pytest.approx(2, rel=1e-3)
    free = p["omega_v"] ** 2 * (filled["pump.uCMD"] - filled["pump.u"])
    free -= 2 * p["zeta_v"] * p["omega_v"] * filled["pump.u_t"]
    running = np.abs(filled["pump.u_t"]) < 1.9
    assert_equal(filled["pump.u_tt"][running], free[running], 100)


def test_angle_follows_the_linkage_not_the_piston(filled: Run) -> None:
    arm = PARAMETERS["L"] / (2 * np.tan(ALPHA_MAX))
    assert_equal(filled["pump.alpha"], np.arctan(filled["pump.linkage.y"] / arm), 0.1)
    play = np.abs(filled["pump.linkage.y"] - filled["pump.xp"]).max()
    assert 1.9e-5 < play < 1e-4
