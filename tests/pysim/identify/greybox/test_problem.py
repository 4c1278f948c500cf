"""The measurements of one model beside another."""

from functools import cache
from pathlib import Path

import numpy as np
import pytest

from pysim.effects import read_catalogue
from pysim.identify.greybox import Measurements, Parameter, Problem, Treatment, problem
from pysim.identify.greybox.problem import beside
from pysim.identify.greybox.residuals import Point
from pysim.types import Dataset, Model
from pysim.workflow.variants import Variants
from tests.known_answers.plants import PLANTS
from tests.pysim.diagnosis.plants import FINE, catalogue, measured, variants
from tests.pysim.identify.greybox import measurements as m

RELAXING = """
package More
  model Relaxing "A spring in series with a damper"
    extends Mass.PartialForce;
    parameter Real k_z(unit="N/m", min=0, max=50, nominal=10) = 0 "0 = off";
    Real z(unit="m", start=0, fixed=true, nominal=0.05);
  equation
    0.2*der(z) = x - z;
    f = -k_z*(x - z);
    annotation(__HydraulicTestBench(effect="more.relaxing", slot="force"));
  end Relaxing;
end More;
"""
FREE = ("m", "d", "k")


@cache
def data() -> Dataset:
    return measured("mass", {"mass.friction": {"F_c": 0.3}}, length=4.0, begins=1.0)


def made(effects: tuple[str, ...], initial: str) -> tuple[Problem, Problem]:
    """Beside the model with effects: taken over from the base model's, and built anew."""
    own = variants("mass")
    model, places = own.build([catalogue("mass")[name] for name in effects])
    free: list[Parameter | str] = [*FREE]
    for name in effects:
        free += [Parameter(f"{places[name]}.{p.name}", log=False) for p in catalogue("mass")[name].parameters]
    treatment = Treatment(initial=initial)
    base = problem(own.build(())[0], [Measurements(data())], FREE, treatment=treatment)
    return beside(base, model, free), problem(model, [Measurements(data())], free, treatment=treatment)


def at(one: Problem, shift: float, use: str = "fit") -> Point:
    x = one.space.to_search(one.space.start) + shift
    return one.residuals(simulation=FINE, use=use).evaluate(one.model, one.space, x)


@pytest.mark.parametrize("initial", ["near rest", "rest", "estimate"])
@pytest.mark.parametrize("effects", [("mass.friction",), ("mass.drag", "mass.hardening")])
def test_it_counts_as_a_problem_that_is_made_anew(effects: tuple[str, ...], initial: str) -> None:
    moved, anew = made(effects, initial)
    assert moved.space.keys == anew.space.keys
    assert dict(moved.floors) == dict(anew.floors)
    for use in ("fit", "validate"):
        one, other = at(moved, 0.05, use), at(anew, 0.05, use)
        assert one.cost == pytest.approx(other.cost, rel=1e-9)
        assert one.residual == pytest.approx(other.residual, rel=1e-6, abs=1e-9)
        assert np.abs(one.jacobian - other.jacobian).max() < 1e-6 * np.abs(other.jacobian).max()


def test_tables_and_stepped_sines_go_along_too(lag: Model) -> None:
    records = [m.table(1.5, 0.4, np.array([0.1, 1.0, 3.0])), m.sine_log(1.5, 0.4, 0.5, 1), m.ramp_log(1.5, 0.4, 2)]
    base = problem(lag, [Measurements(m.dataset(records))], ["K", "T"])
    moved = beside(base, lag, ["K", "T", "g"])
    anew = problem(lag, [Measurements(m.dataset(records))], ["K", "T", "g"])
    one, other = at(moved, 0.05), at(anew, 0.05)
    assert one.cost == pytest.approx(other.cost, rel=1e-9)
    assert one.jacobian == pytest.approx(other.jacobian)


def test_states_that_are_new_are_as_free_as_their_size(tmp_path: Path) -> None:
    """A spring in series with a damper has a length of its own, which the base model knows nothing of."""
    library = tmp_path / "More.mo"
    library.write_text(RELAXING, encoding="utf-8")
    own = Variants("Mass.Design", (PLANTS["mass"].library, library))
    model, _ = own.build(read_catalogue(library))
    base = problem(own.build(())[0], [Measurements(data())], FREE)
    moved = beside(base, model, FREE)
    for before, after in zip(base.observations, moved.observations, strict=True):
        old = dict(zip(base.model.abilities.states, before.runs[0].initial.tolist(), strict=True))
        sizes = dict(zip(model.abilities.states, after.runs[0].initial.tolist(), strict=True))
        assert {name: sizes.pop(name) for name in old} == old
        assert list(sizes.values()) == [0.05]
