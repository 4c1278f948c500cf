"""Which laws have events, as the compiler sees it; and numbers that go from one model to another."""

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from fmu_build import build
from pysim.diagnosis.candidate import Models
from pysim.diagnosis.refit import begin
from pysim.effects import STANDARD_LIBRARY, makes_events, read_catalogue
from pysim.io import read_model
from pysim.types import BadInput, Effect, Model
from tests.pysim.diagnosis.plants import FINE, catalogue, given, measured, refitted, variants

LAWS = """
package Laws
  partial model Force
    input Real v(unit="m/s");
    output Real f(unit="N");
  end Force;
  model Own "The law in question"
    extends Force;
    parameter Real a(unit="N", min=0, max=3) = 0;
  equation
    {law}
    annotation(__HydraulicTestBench(effect="laws.own", slot="force"));
  end Own;
  model Mass
    input Real F(start=0);
    output Real v(start=0, fixed=true);
    Own own;
  equation
    own.v = v;
    der(v) = F - v + own.f;
  end Mass;
end Laws;
"""


@pytest.mark.parametrize(
    "law",
    [
        "f = -a*(if v > 0.5 then 1 else 0);",
        "f = -a*floor(v/0.1);",
        "f = -a*integer(v/0.1);",
        "f = -a*div(v, 0.1);",
        "f = -a*mod(v, 0.1);",
        "when v > 0.1 then f = -a; end when;",
        "f = -a*max(abs(v), 1)*sign(v);",
        "f = -a*noEvent(if v > 0.5 then 1 else 0);",
        "f = -a*noEvent(if abs(min(max(v, sin(cos(v))), 1)) > 0.5 then 1 else 0);",
        "f = -a*smooth(0, if v > 0.5 then v else 0.5);",
        'f = -a*v "pushes back where v > 0 (whatever <that> is)";',
        "f = /* for v > 0 */ -a*v // and v < 0\n;",
    ],
)
def test_a_law_has_events_where_its_model_has_event_indicators(law: str, tmp_path: Path) -> None:
    library = tmp_path / "Laws.mo"
    library.write_text(LAWS.format(law=law), encoding="utf-8")
    (effect,) = read_catalogue(library)
    model = read_model(build("Laws.Mass", tmp_path / "Mass.fmu", libraries=[library]))
    assert makes_events(effect) == (model.abilities.event_indicators > 0)


def test_effects_of_the_pump_that_switch() -> None:
    """A sampled card: its model has time events, no other has any."""
    found = {effect.name for effect in read_catalogue(STANDARD_LIBRARY) if makes_events(effect)}
    assert found == {"card.sampling"}


def test_numbers_come_back_by_their_names() -> None:
    models = Models(given("axis", measured("axis", length=2.0)))
    known = catalogue("axis")
    chosen = models.of([known["axis.offset"], known["axis.friction"]])
    values = {"d": 110.0, "T": 0.03, ("axis.friction", "F_c"): 3.0, ("axis.offset", "u_n"): -0.2}
    found = chosen.values(chosen.at(values))
    assert {key: found[key] for key in values} == pytest.approx(values)
    assert found["K"] == pytest.approx(20.0)  # as declared
    assert chosen.at({("axis.friction", "F_c"): 1e9}) == pytest.approx(chosen.at({("axis.friction", "F_c"): 50.0}))


def test_a_model_with_others_off_answers_as_one_that_has_them_not() -> None:
    """One compiled model holds all smooth effects; what is not asked for is off in it."""
    session = given("mass", measured("mass", {"mass.drag": {"c_2": 2.0}}, length=4.0))
    models, values = Models(session), {"m": 1.1, ("mass.drag", "c_2"): 2.5}
    drag = [catalogue("mass")["mass.drag"]]
    one, other = (begin(make(drag), values, FINE).point for make in (models.of, models.alone))
    assert one.cost == pytest.approx(other.cost, abs=0.05)
    assert np.linalg.norm(one.jacobian - other.jacobian) < 1e-3 * np.linalg.norm(other.jacobian)
    assert len(models.of(drag).model.variables) > len(models.alone(drag).model.variables)


def test_what_does_not_build_together_is_built_apart() -> None:
    session = given("mass", measured("mass", length=2.0))
    refused = {"mass.hardening"}

    def picky(effects: Sequence[Effect]) -> tuple[Model, dict[str, str]]:
        if len(effects) > 1 and refused & {effect.name for effect in effects}:
            raise BadInput("not together")
        return variants("mass").build(effects)

    models = Models(replace(session, build=picky))
    for name, effect in catalogue("mass").items():
        assert models.of([effect]).names == (name,)
    with pytest.raises(BadInput, match="not together"):
        models.of([catalogue("mass")["mass.hardening"], catalogue("mass")["mass.drag"]])


def test_initial_states_go_along_by_their_names() -> None:
    """The refitted plant began in motion: its states at the start are those of the model with an effect too."""
    data = measured("axis", begins=2.0, length=3.0)
    models = Models(given("axis", data, initial="estimate"))
    fit = refitted(models)
    wider = models.of([catalogue("axis")["axis.friction"]])
    carried = wider.carried(fit.candidate, fit.point)
    for run, offset, old in zip(wider.residuals(FINE).runs, carried.states, fit.point.carried.states, strict=True):
        assert offset is not None
        assert old is not None
        assert np.abs(old).max() > 0
        named = dict(zip([wider.model.abilities.states[i] for i in run.free], offset, strict=True))
        (own,) = (r for r in fit.candidate.residuals(FINE).runs if r.record == run.record)
        assert named == dict(zip([fit.candidate.model.abilities.states[i] for i in own.free], old, strict=True))
    x = wider.at({**fit.values, ("axis.friction", "F_c"): 0.0})
    there = wider.residuals(FINE).evaluate(wider.model, wider.space, x, carried)
    assert there.cost == pytest.approx(fit.point.cost, abs=0.05)
