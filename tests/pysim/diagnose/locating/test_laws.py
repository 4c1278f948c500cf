"""What is looked for at the pump's slots, and that a table is what its values say."""

from pathlib import Path

import numpy as np
import pytest

from fmu_build import build
from pysim.diagnose.locating.laws import KNOTS, LAGS, Copy, Law, slot_laws, state_laws, wrapped
from pysim.effects import STANDARD_LIBRARY, slots
from pysim.io import read_model
from pysim.simulate import Rodas, simulate
from pysim.types import Experiment, Signal

PUMP = "HydraulicTestBench.Pump.FreeGreyBox"


def test_the_places_of_the_pump() -> None:
    pump = read_model(build(PUMP))
    laws = {(law.slot, law.argument): law for law in slot_laws(slots(PUMP, [STANDARD_LIBRARY]), pump)}
    assert {argument for slot, argument in laws if slot == "pistonForce"} == {"pistonForce.x", "pistonForce.v"}
    assert laws["angleSensor", "angleSensor.s_t"].probes == (
        "angleSensor.y=missing_term1",
        "angleSensor.y_t=missing_term1_t",
    )
    assert [copy.argument for copy in laws["oil", "oil.p"].copies] == ["oil.p1", "oil.p2"]
    assert laws["spoolOpening", "der(spoolOpening.s)"].of_rate
    assert laws["supply", "supply.Q"].lag > 0 == laws["oil", "oil.p"].lag
    late = [law.lag for law in slot_laws(slots(PUMP, [STANDARD_LIBRARY]), pump) if law.slot == "supply"]
    assert tuple(late) == LAGS
    assert {c.output for law in laws.values() if law.slot == "spool" for c in law.copies} == {"spool.u_tt", "spool.u"}


PLAIN = """
model Plain
  input Real s(start=0);
  Real s_t;
  Real f;
  Real g;
  Real w(start=0, fixed=true);
  output Real y;
equation
  der(w) = s - w;
  s_t = s - w;
  f = 0;
  g = 0;
  y = f;
end Plain;
"""


def table(k: np.ndarray, c: np.ndarray, z: np.ndarray) -> np.ndarray:
    """Straight between the knots and on beyond them."""
    inside = np.interp(z, k, c)
    low, high = (c[1] - c[0]) / (k[1] - k[0]), (c[-1] - c[-2]) / (k[-1] - k[-2])
    return np.where(z < k[0], c[0] + low * (z - k[0]), np.where(z > k[-1], c[-1] + high * (z - k[-1]), inside))


@pytest.fixture
def run(tmp_path: Path):
    def made(law: Law, k: np.ndarray, c: np.ndarray, unit: float, times: np.ndarray):
        (tmp_path / "m.mo").write_text(PLAIN + wrapped("Plain", law, "Located"))
        model = read_model(build("Located", libraries=[tmp_path / "m.mo"], probes=law.probes))
        values = {**dict(zip(law.knots, k, strict=True)), **dict(zip(law.values, c, strict=True)), "missing_unit": unit}
        ramp = Signal.lines([0.0, 1.0], [-2.0, 2.0])
        experiment = Experiment(times, ("f", "g", "w"), {"s": ramp}, values)
        return simulate(model, experiment, solver=Rodas(rtol=1e-9, atol=1e-9))

    return made


def test_a_table_is_straight_between_its_values_but_for_rounded_corners(run) -> None:
    k = np.linspace(-1.4, 1.4, KNOTS)
    c = np.random.default_rng(1).standard_normal(KNOTS)
    times = np.linspace(0, 1, 401)
    found = run(Law("here", "s", (Copy("f", "s"),)), k, c, 3.0, times)
    expected = 3 * table(k, c, -2 + 4 * times)
    bend = 3 * np.max(np.abs(np.diff(c, 2)))
    assert np.max(np.abs(found["f"] - expected)) < 0.15 * bend  # (1/4 of the interval)/2 is its largest share of a bend
    straight = run(Law("here", "s", (Copy("f", "s"),)), k, 0.5 - 2 * k, 1.0, times)
    np.testing.assert_allclose(straight["f"], 0.5 - 2 * (-2 + 4 * times), atol=1e-9)


def test_the_rate_of_a_term_is_its_derivative(run) -> None:
    """f = h(w) and g = h'(w) der(w), with der(w) = s_t known."""
    k, times = np.linspace(-1.4, 1.4, KNOTS), np.linspace(0, 1, 2001)
    law = Law("here", "w", (Copy("f", "w", "g", "s_t"),))
    found = run(law, k, np.sin(2 * k), 1.0, times)
    np.testing.assert_allclose(found["g"][1:-1], np.gradient(found["f"], times)[1:-1], atol=2e-2)
    assert np.ptp(found["g"]) > 0.5


def test_a_term_that_follows_late(run) -> None:
    """The lag of 20 ms makes h = z run 20 ms behind a ramp of 4 per s."""
    k, times = np.linspace(-1.4, 1.4, KNOTS), np.linspace(0.5, 1, 11)
    found = run(Law("here", "s", (Copy("f", "s"),), lag=0.02), k, k, 1.0, times)
    np.testing.assert_allclose(found["f"], -2 + 4 * (times - 0.02), atol=1e-6)


def test_a_term_over_a_rate(run) -> None:
    k, times = np.linspace(-10, 10, KNOTS), np.linspace(0.5, 0.99, 11)
    found = run(Law("here", "der(s)", (Copy("f", "s"),), of_rate=True), k, k, 1.0, times)
    np.testing.assert_allclose(found["f"], 4.0, atol=1e-6)


def test_states_equations_depend_on_what_they_depend_on() -> None:
    pump = read_model(build(PUMP))
    pairs = {(law.slot, law.argument) for law in state_laws(pump)}
    assert ("der(piston.v)", "piston.v") in pairs
    assert ("der(piston.v)", "deadTime.z1") not in pairs
