"""The crane: rest, fall, slack wire and compensation, against closed forms and its own equations."""

import numpy as np
import pytest

from pysim.simulate import Rodas, simulate
from pysim.types import Experiment, Record, Signal
from tests.modelica.built import built, ran

WEIGHT = (390 - 1025 * 0.05) * 9.81  # N, in water
STIFFNESS = 1e11 * 20e-6 / 50
DRUM = 0.03
IDEAL, HYDRAULIC = "Crane.IdealCompensation", "Crane.HydraulicCompensation"


def driven(name: str, stop: float, recorded: tuple[str, ...], points: int = 2001, **inputs: Signal) -> Record:
    run = Experiment(np.linspace(0, stop, points), recorded, inputs)
    return simulate(built(name), run, solver=Rodas(rtol=1e-8, atol=1e-8))


def test_payload_sinks_as_the_closed_form_and_hangs_still() -> None:
    record = ran("Validation.PayloadFall", 5.0, ("error", "error_hanging", "error_p"))
    assert np.abs(record["error"]).max() < 5.5 * 1e-7  # m/s, of the last velocity
    assert np.abs(record["error_hanging"]).max() < 1e-7  # m: the wire's smooth beginning, 1.2e-9, and the solver
    assert np.abs(record["error_p"]).max() < 10  # Pa, of 105 bar


def test_crane_begins_at_rest() -> None:
    """Nothing moves while nothing is commanded: oil, drum, wire and payload are in balance from the start."""
    record = driven(HYDRAULIC, 20.0, ("omega", "z_PL", "F_L", "pS"))
    assert np.abs(record["omega"]).max() < 1e-5
    assert np.ptp(record["z_PL"]) < 1e-6
    assert record["F_L"][-1] == pytest.approx(WEIGHT, rel=1e-6)
    assert record["pS"][-1] == pytest.approx(WEIGHT * DRUM * 2 * np.pi / 60e-6, rel=1e-6)


def test_references_are_eq_5_50_and_5_51() -> None:
    t = np.arange(0, 20.01, 0.02)
    heave = Signal.through(t, 0.5 * np.sin(0.8 * t))
    record = driven(IDEAL, 20.0, ("omegaS_ref", "pL_ref", "drum.z_v"), z_v_t=heave)
    assert np.allclose(record["omegaS_ref"], -heave.value(record.time) / DRUM, atol=1e-9)
    assert np.allclose(record["pL_ref"], WEIGHT * DRUM * 2 * np.pi / 60e-6, rtol=1e-5)
    assert np.ptp(record["drum.z_v"]) == pytest.approx(2 * 0.5 / 0.8, rel=1e-3)


def test_wire_and_payload_follow_their_equations_slack_and_taut() -> None:
    """A heave fast enough to throw the payload: Eq. 5.49 and 5.44 with weight and sign, from the recorded motion."""
    t = np.arange(0, 10.001, 0.005)
    swing = Signal.through(t, (1 - np.exp(-t)) * 4.0 * np.sin(3.5 * t))
    names = ("drum.z_v", "payload.z_PL", "payload.v_PL", "wire.F_w", "winch.phi", "payload.F_drag")
    model = built(IDEAL)
    run = Experiment(np.linspace(0, 10, 10001), names, {"z_v_t": swing}, {"gain": 0.0})
    record = simulate(model, run, solver=Rodas(rtol=1e-9, atol=1e-9))
    stretch = record["drum.z_v"] + DRUM * record["winch.phi"] - record["payload.z_PL"]
    rate = swing.value(record.time) - record["payload.v_PL"]
    tension = np.where(stretch > 0, np.maximum(STIFFNESS * stretch + STIFFNESS / 10 * rate, 0), 0)
    clear = np.abs(stretch) > 1e-3  # its smooth beginning
    assert (stretch < -0.01).any()
    assert record["wire.F_w"][stretch < 0].max() == 0
    assert np.allclose(record["wire.F_w"][clear], tension[clear], atol=1e-3 * WEIGHT)
    v = record["payload.v_PL"]
    assert (v > 0.5).any()
    assert np.allclose(record["payload.F_drag"], 0.5 * 1025 * 1.1 * 0.2 * v * np.abs(v), rtol=1e-9, atol=1e-9)
    acceleration = np.gradient(v, record.time)
    expected = (record["wire.F_w"] - WEIGHT - record["payload.F_drag"]) / 390
    calm = np.abs(np.gradient(np.gradient(v, record.time), record.time)) < 300  # between the jerks
    assert np.abs(acceleration - expected)[calm][2:-2].max() < 0.05


def test_compensation_keeps_the_payload_in_place() -> None:
    """Fed forward, the pump leaves less than a tenth of what a crane without it does."""
    record = ran("Examples.ActiveHeave", 60.0, ("active.z_PL", "passive.z_PL", "active.z_v", "active.pS"), 3001)
    active, passive = np.ptp(record["active.z_PL"]), np.ptp(record["passive.z_PL"])
    assert passive > 0.9 * np.ptp(record["active.z_v"])
    assert active < 0.1 * passive
    assert record["active.pS"].min() > 0.8 * WEIGHT * DRUM * 2 * np.pi / 60e-6  # Fig. 5.16: nearly constant
