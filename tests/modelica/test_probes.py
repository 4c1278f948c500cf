"""Every slot of the pump takes probes at its outputs, and a probe does what an effect with the same term does."""

from collections.abc import Mapping

import numpy as np
import pytest

from fmu_build import build
from pysim.io import read_model
from pysim.simulate import Rodas, simulate
from pysim.types import Experiment, Model, Signal
from tests.contracts.fmu import Fmu
from tests.modelica.effects import BASE, RightHandSide, built_variant, pump, states

SLOTS = {  # slot: its outputs, as in HydraulicTestBench.Interfaces
    "commandRate": ("rate",),
    "angleError": ("y", "y_t"),
    "cardOutput": ("y",),
    "spoolCommand": ("y",),
    "deadTime": ("y",),
    "spool": ("u", "u_t", "u_tt"),
    "spoolOpening": ("y",),
    "supply": ("dp",),
    "oil": ("kappa1", "kappa2"),
    "internalLeakage": ("q",),
    "externalLeakage": ("q1", "q2"),
    "pistonForce": ("f",),
    "linkage": ("y", "y_t"),
    "angleSensor": ("y", "y_t"),
}
PROBES = tuple(f"{slot}.{name}" for slot, names in SLOTS.items() for name in names)
TIMES = np.arange(0, 0.6, 0.002)
SEEN = ("alphaPercent", "u", "chamber1.p", "piston.v")
SOLVER = Rodas(rtol=1e-7, atol=1e-7)


@pytest.fixture(scope="module")
def probed() -> Model:
    return read_model(build(BASE, probes=PROBES))


def response(model: Model, *, overrides: Mapping[str, float] | None = None, **probes: float) -> np.ndarray:
    """(n_t, 4) to 10 percent at 2 Hz, with constant probes; dots in names written as __."""
    command = Signal.through(TIMES, 10 * np.sin(4 * np.pi * TIMES))
    inputs = {"probe." + name.replace("__", "."): Signal.constant(value) for name, value in probes.items()}
    experiment = Experiment(
        TIMES, SEEN, {"alphaCMD": command, **inputs}, overrides or {}, rates={"alphaCMD_t": "alphaCMD"}
    )
    return simulate(model, experiment, solver=SOLVER).values


@pytest.fixture(scope="module")
def unmoved(probed: Model) -> np.ndarray:
    return response(probed)


def sizes(values: np.ndarray) -> np.ndarray:
    return np.abs(values).max(axis=0)


def test_at_zero_the_pump_is_the_one_without_probes(probed, tmp_path):
    """At any state within rounding: the sum with zero is exact, but may stand elsewhere in an expression."""
    rng = np.random.default_rng(3)
    points = [states(rng) for _ in range(20)]
    with RightHandSide((), tmp_path) as plain:
        expected = [plain.at(point) for point in points]
    fmu = Fmu.unpack(probed.path, tmp_path / "probed", 2)
    with fmu.open("me").start() as instance:
        for point, rates in zip(points, expected, strict=True):
            instance.x = [point[name] for name in fmu.states]
            assert dict(zip(fmu.states, instance.dx, strict=True)) == pytest.approx(rates, rel=1e-12, abs=1e-12)


def test_a_probe_of_the_piston_force_is_a_bias_of_the_swash_plate(probed, unmoved):
    made, fmu = pump(("swash.bias",))
    bias = read_model(fmu)
    strength = made.parameter("swash.bias", "F_b")
    by_effect = response(bias, overrides={strength: 300.0})
    by_probe = response(probed, pistonForce__f=300.0)
    assert (np.abs(by_probe - by_effect) < 1e-9 * sizes(by_effect)).all()
    assert (sizes(by_probe - unmoved) > 1e-3 * sizes(by_effect)).all()


def test_a_probe_adds_to_the_effect_that_fills_the_slot(probed):
    made, _ = pump(("swash.bias",))
    both = read_model(built_variant(made, probes=("pistonForce.f",)))
    summed = response(both, overrides={made.parameter("swash.bias", "F_b"): 200.0}, pistonForce__f=100.0)
    expected = response(probed, pistonForce__f=300.0)
    assert (np.abs(summed - expected) < 1e-9 * sizes(expected)).all()


@pytest.mark.parametrize("name", PROBES)
def test_each_probe_moves_the_pump(probed, unmoved, name):
    """From rest and at no command, by what is small against the variable's size."""
    size = {"dp": 1e5, "kappa1": 1e-10, "kappa2": 1e-10, "q": 1e-6, "q1": 1e-6, "q2": 1e-6, "f": 100.0, "rate": 10.0}
    moved = response(probed, **{name.replace(".", "__"): size.get(name.rpartition(".")[2], 1e-3)})
    assert np.abs(moved - unmoved).max(axis=0)[0] > 1e-6


def test_a_probe_has_the_unit_of_the_place(probed):
    """Slots for signals with a rate leave the unit open; what they are connected with tells it."""
    units = {name: probed[f"probe.{name}"].unit for name in ("linkage.y", "angleSensor.y", "angleError.y", "supply.dp")}
    assert units == {"linkage.y": "m", "angleSensor.y": "rad", "angleError.y": "rad", "supply.dp": "Pa"}
    assert [probed[f"probe.{slot}.y_t"].unit for slot in ("linkage", "angleSensor")] == ["m/s", "rad/s"]
