"""Every effect of the test bench: off it is the base model to the last bit, on it does what its equation says.

All are in one bench together, so that they are also seen not to disturb each other. The equations are written down here
a second time.
"""

from collections.abc import Iterator, Mapping, Sequence
from itertools import combinations
from pathlib import Path

import numpy as np
import pytest

import fmu_build
from pysim.effects import Variant, fitting, read_catalogue, slots, variant
from pysim.io import read_model
from pysim.simulate import Rodas, simulate
from pysim.types import Experiment
from tests.modelica.built import built
from tests.modelica.library import LIBRARY
from tests.modelica.test_load_circuit import BETA, K_SV, RHO, STATE, At, K

BASE = "HydraulicTestBench.LoadCircuit.OpenTestBench"
CATALOGUE = {effect.name: effect for effect in fitting(read_catalogue(LIBRARY), BASE, [LIBRARY])}
EXACT = tuple(name for name, effect in CATALOGUE.items() if not effect.bypass)
STANDARD = {  # effects.md: name -> (slot, strengths)
    "shaft.friction": ("shaftFriction", {"tau_c", "tau_s"}),
    "motor.leakage": ("motorLeakage", {"C_m"}),
    "motor.torque_loss": ("motorLoss", {"eta"}),
    "coupling.compliance": ("coupling", {"inverse_k_t"}),
    "servovalve.deadband": ("servoOpening", {"u_0"}),
    "hose.compliance": ("hoses", {"V"}),
}
HALF = 0.0733 / 2  # kg m2, at each motor


def made(names: Sequence[str], folder: Path) -> tuple[Variant, Path]:
    """The bench with these effects, and its FMU."""
    found = variant(BASE, [CATALOGUE[name] for name in names], [LIBRARY], name="Variant")
    (folder / "Variant.mo").write_text(found.text)
    return found, fmu_build.build("Variant", folder / "Variant.fmu", libraries=[folder / "Variant.mo"])


def off(names: Sequence[str]) -> dict[str, float]:
    return {f"{CATALOGUE[n].slot}.{p.name}": float(p.off or 0) for n in names for p in CATALOGUE[n].strengths}


@pytest.fixture(scope="module")
def base(tmp_path_factory: pytest.TempPathFactory) -> Iterator[At]:
    with At(fmu_build.build(BASE), tmp_path_factory.mktemp("base") / "fmu") as at:
        yield at


@pytest.fixture(scope="module")
def full(tmp_path_factory: pytest.TempPathFactory) -> Iterator[At]:
    folder = tmp_path_factory.mktemp("full")
    with At(made(EXACT, folder)[1], folder / "fmu") as at:
        yield at


def drawn(count: int) -> Iterator[dict[str, float]]:
    """States anywhere in the working range, hoses at a pressure of their own."""
    rng = np.random.default_rng(3)
    for _ in range(count):
        state = {f"volume_{line}.p": float(rng.uniform(26e5, 300e5)) for line in ("sA", "sB", "LA", "LB")}
        state |= {f"hoses.p_{line}": float(rng.uniform(26e5, 300e5)) for line in ("sA", "sB", "LA", "LB")}
        state |= {"spool.u": float(rng.uniform(-0.3, 0.3)), "spool.u_t": float(rng.uniform(-5, 5))}
        yield state | {"inertiaS.w": float(rng.uniform(-40, 40)), "plate.z[1]": float(rng.uniform(-30, 30))}


def test_catalogue_is_the_standard_list() -> None:
    assert {e.name: (e.slot, {p.name for p in e.strengths}) for e in CATALOGUE.values()} == STANDARD
    assert set(CATALOGUE) - set(EXACT) == {"coupling.compliance"}
    assert {effect.slot for effect in CATALOGUE.values()} <= {slot.name for slot in slots(BASE, [LIBRARY])}


def test_no_effect_of_the_pump_goes_into_the_bench_nor_the_other_way_round() -> None:
    pump = {e.name for e in fitting(read_catalogue(LIBRARY), "HydraulicTestBench.Pump.FreeGreyBox", [LIBRARY])}
    assert len(pump) == 18
    assert not pump & set(CATALOGUE)


def test_parameters_keep_their_bounds_in_the_fmu(tmp_path: Path) -> None:
    found, path = made(tuple(CATALOGUE), tmp_path)
    built = read_model(path)
    for effect in CATALOGUE.values():
        for p in effect.parameters:
            variable = built[found.parameter(effect.name, p.name)]
            assert (variable.causality, variable.unit) == ("parameter", p.unit)
            assert (variable.start, variable.min, variable.max, variable.nominal) == pytest.approx(
                (p.default, p.min, p.max, p.nominal)
            )


def test_off_is_the_base_model_bit_for_bit(base: At, full: At) -> None:
    for state in drawn(40):
        expected = base.rates(state, {})
        found = full.rates(state, off(EXACT))
        assert {name: found[name] for name in expected} == expected


@pytest.mark.parametrize(
    ("on", "state", "change"),
    [
        (
            {"shaftFriction.tau_c": 15.0, "shaftFriction.tau_s": 55.0, "shaftFriction.r": 14.0},
            "inertiaS.w",
            -np.tanh(14 * 3) * (15 + 40 * np.exp(-3 / 10)) / 0.0733,
        ),
        ({"motorLoss.eta": 0.1}, "inertiaS.w", -0.1 * K * 100e5 / 0.0733),
        ({"motorLeakage.C_m": 2e-12}, "volume_sA.p", -BETA / 1.52e-3 * 2e-12 * 50e5),
        ({"motorLeakage.C_m": 2e-12}, "volume_LA.p", BETA / 1.01e-3 * 2e-12 * 50e5),
        ({"servoOpening.u_0": 0.02}, "volume_LA.p", BETA / 1.01e-3 * 0.02 * K_SV * np.sqrt(2 / RHO * 120e5)),
        ({"hoses.V": 1e-3, "hoses.T": 0.01}, "volume_LA.p", -1e-3 / 1.01e-3 * (120e5 - 100e5) / 0.01),
        ({"hoses.V": 1e-3, "hoses.T": 0.01}, "volume_LB.p", -1e-3 / 1.01e-3 * (170e5 - 100e5) / 0.01),
        ({"hoses.V": 1e-3, "hoses.T": 0.01}, "volume_sA.p", -1e-3 / 1.52e-3 * (90e5 - 100e5) / 0.01),
        ({"hoses.V": 1e-3, "hoses.T": 0.01}, "volume_sB.p", -1e-3 / 1.52e-3 * (40e5 - 100e5) / 0.01),
    ],
)
def test_effect_adds_its_equation(full: At, on: Mapping[str, float], state: str, change: float) -> None:
    at = {**STATE, **{f"hoses.p_{line}": 100e5 for line in ("sA", "sB", "LA", "LB")}}
    usual = {"shaftFriction.r": 10.0, "hoses.T": 5e-3}
    found = full.rates(at, {**off(EXACT), **usual, **on})[state] - full.rates(at, {**off(EXACT), **usual})[state]
    assert found == pytest.approx(change, rel=1e-6)


def test_two_at_once_add_up(full: At) -> None:
    friction, loss = {"shaftFriction.tau_c": 12.0}, {"motorLoss.eta": 0.08}
    alone = [full.rates(STATE, {**off(EXACT), **on})["inertiaS.w"] for on in ({}, friction, loss)]
    both = full.rates(STATE, {**off(EXACT), **friction, **loss})["inertiaS.w"]
    assert both - alone[0] == pytest.approx(sum(alone[1:]) - 2 * alone[0], rel=1e-12)
    assert min(abs(one - alone[0]) for one in alone[1:]) > 1


def test_coupling_is_spring_and_damper_between_the_halves(base: At, tmp_path: Path) -> None:
    """Twisted by 1 mrad at 2000 N m/rad, and opening at 0.5 rad/s; neither shows in the sum of both halves."""
    names = tuple(CATALOGUE)
    with At(made(names, tmp_path)[1], tmp_path / "fmu") as at:
        twisted = {**STATE, "inertiaL.phi": 1e-3, "inertiaL.w": 3.5}
        given = {**off(names), "coupling.inverse_k_t": 1 / 2000, "coupling.T_d": 3e-4}
        rates = at.rates(twisted, given)
        level = at.rates({**STATE, "inertiaL.w": 3.0}, given)
    torque = 2000 * (1e-3 + 3e-4 * 0.5)
    assert rates["inertiaS.w"] - level["inertiaS.w"] == pytest.approx(torque / HALF, rel=1e-9)
    assert rates["inertiaL.w"] - level["inertiaL.w"] == pytest.approx(-torque / HALF, rel=1e-9)
    together = 0.5 * (level["inertiaS.w"] + level["inertiaL.w"])
    assert together == pytest.approx(base.rates(STATE, {})["inertiaS.w"], rel=1e-9)


def test_coupling_turns_as_one_at_the_start(tmp_path: Path) -> None:
    text = tmp_path / "Turning.mo"
    text.write_text("""model Turning
  HydraulicTestBench.LoadCircuit.OpenTestBench bench(
    inertiaS(phi(start=1), w(start=20)),
    redeclare HydraulicTestBench.Effects.CouplingCompliance coupling(inverse_k_t=3e-4));
equation
  bench.alphaCMD = 0;
  bench.alphaCMD_t = 0;
  bench.u_ref = 0;
end Turning;
""")
    names = ("bench.inertiaS.w", "bench.inertiaL.w", "bench.inertiaL.phi")
    run = Experiment(np.array([0.0, 1e-3]), names)
    start = simulate(built("Turning", (), (text,)), run, solver=Rodas()).values[0]
    assert start == pytest.approx([20, 20, 1])


@pytest.mark.slow
@pytest.mark.parametrize("pair", list(combinations(CATALOGUE, 2)), ids=" ".join)
def test_every_two_build(pair: tuple[str, str], tmp_path: Path) -> None:
    found, path = made(pair, tmp_path)
    names = {variable.name for variable in read_model(path).variables}
    assert {found.parameter(name, p.name) for name in pair for p in CATALOGUE[name].parameters} <= names
