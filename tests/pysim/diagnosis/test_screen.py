"""First-order gains against refits, for effects that are linear in their strength."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np
import pytest

from pysim.diagnosis import rivals
from pysim.diagnosis.candidate import Models, Refused
from pysim.diagnosis.floors import Floors
from pysim.diagnosis.refit import FinalFit, begin, converged
from pysim.diagnosis.screen import Screened, Sizes, best_of_each, screen, screened
from pysim.diagnosis.search import Found
from pysim.diagnosis.session import session
from pysim.diagnosis.settings import Settings
from pysim.diagnosis.starts import Starts
from pysim.diagnosis.verdict import notes_of
from pysim.effects import read_catalogue
from pysim.present.notes import words
from pysim.types import BadInput, Effect, Model, Record
from pysim.workflow.variants import Variants
from tests.known_answers.plants import PLANTS
from tests.pysim.diagnosis.plants import FINE, catalogue, given, measured, refitted, stopped, variants

# Hardly there, it acts at the largest places alone; at its usual size, in the middle.
SIDE = """
package Side
  model Push "A push at some place"
    extends Mass.PartialForce;
    parameter Real a(unit="1", min=0, max=10, nominal=1) = 0 "0 = off";
  equation
    f = -a*exp(STEEP*x)/(1 + a*exp(STEEP*x))^2;
    annotation(__HydraulicTestBench(effect="side.push", slot="force"));
  end Push;
end Side;
"""
FORCE = -0.02  # N, constant: it shifts the mass by half its noise


@cache
def models() -> Models:
    return Models(given("mass", measured("mass", {"mass.bias": {"F_b": FORCE}}, {"d": 1.9})))


@cache
def base() -> FinalFit:
    return refitted(models())


def by_name() -> dict[str, Screened]:
    return {one.effect.name: one for one in best_of_each(screen(models(), lambda transient: base(), FINE))}


def test_what_fits_beside_the_base_model_alone_is_refused_beside_the_other() -> None:
    own, names = models().session, ("mass.bias", "mass.drag")

    def single(effects: Sequence[Effect]) -> tuple[Model, Mapping[str, str]]:
        if len(effects) > 1:
            raise BadInput("share a slot")
        return variants("mass").build(effects)

    chosen = tuple(effect for effect in own.catalogue if effect.name in names)
    alone = Models(replace(own, catalogue=chosen, build=single))
    assert {one.effect.name for one in screen(alone, lambda transient: base(), FINE)} == {*names}
    assert alone.refused == {}
    screen(alone, lambda transient: refitted(alone, "mass.bias"), FINE)
    assert alone.refused == {"mass.drag": Refused("share a slot", ("mass.bias",))}
    first, beside = notes_of(Found(base(), base(), (), Floors()), (), {"e": Refused("why"), **alone.refused}, own)
    assert (first.values, beside.values["beside"]) == ({"effect": "e", "reason": "why"}, "mass.bias")
    assert "beside mass.bias" in words(beside)
    assert "beside" not in words(first)


def at_size(size: float) -> Screened:
    """A constant force at this share of its usual size."""
    bias = next(effect for effect in models().session.catalogue if effect.name == "mass.bias")
    (found,) = screened(models().of((bias,)), bias, base(), FINE, Sizes(usual=(size,)))
    return found


def test_of_a_linear_effect_it_foresees_what_a_refit_gains() -> None:
    """With levels held it promises half the fall of the squares over them; the refit gains n/2 times a logarithm."""
    found = by_name()["mass.bias"]
    refit = converged(begin(found.candidate, found.values, FINE, base()))
    n = rivals.samples(base())
    assert base().point.cost - refit.point.cost == pytest.approx(-n / 2 * math.log(1 - 2 * found.gain / n), rel=0.03)
    assert refit.values["mass.bias", "F_b"] == pytest.approx(FORCE, abs=0.004)


def test_at_whatever_size_a_linear_effect_is_tried_it_promises_what_its_slope_does() -> None:
    gains = [at_size(size).gain for size in (0.03, 0.3, 3.0)]
    assert gains == pytest.approx([by_name()["mass.bias"].gain] * 3, rel=0.02)


def test_the_refit_begins_near_the_amount_that_is_best() -> None:
    """Within a fifth and three times of what was tried, where first order is trusted."""
    nominal = 0.3
    assert at_size(0.1).values["mass.bias", "F_b"] == pytest.approx(FORCE, abs=0.005)
    assert at_size(0.01).values["mass.bias", "F_b"] == pytest.approx(-3 * 0.01 * nominal)


def test_amounts_begin_along_with_others_where_each_would_begin_alone() -> None:
    """One run of a model that has all of them gives each the cost and the promise that a run of its own does."""
    found = by_name()
    starts = {name: one.start for name, one in found.items() if one.start is not None}
    assert len(starts) > 2
    assert [found[name].before for name in starts] == pytest.approx([base().point.cost] * len(starts), abs=0.05)
    for name, start in starts.items():
        alone = begin(start.candidate, start.values, FINE, base())
        assert start.point.x == pytest.approx(alone.point.x), name
        assert start.point.cost == pytest.approx(alone.point.cost, abs=0.05), name
        assert start.point.jacobian == pytest.approx(
            alone.point.jacobian, abs=0.01 * np.abs(alone.point.jacobian).max()
        )
        assert start.expected == pytest.approx(alone.expected, abs=0.5), name


def test_the_change_is_what_refitting_cannot_do() -> None:
    own = rivals.of(base())
    for one in by_name().values():
        along = own.jacobian.T @ (one.change / own.level)
        assert np.abs(along).max() < 1e-6 * np.linalg.norm(one.change / own.level) * np.linalg.norm(own.jacobian)


def test_the_best_gain_comes_first() -> None:
    found = screen(models(), lambda transient: base(), FINE)
    assert [one.gain for one in found] == sorted((one.gain for one in found), reverse=True)
    assert found[0].effect.name == "mass.bias"


def test_a_strength_of_one_sign_gains_nothing_against_it() -> None:
    """The plant damps less than a model whose damping may not fall: drag would have to be negative."""
    data = measured("mass", {}, {"d": 1.5}, fit=(1,), length=4.0)
    own = Models(given("mass", data, ("mass.drag",)))
    held = begin(own.of(()), {"d": 3.0}, FINE)
    point = replace(held.point, jacobian=np.zeros_like(held.point.jacobian))
    blind = replace(held, state=replace(held.state, best=point))
    found = screen(own, lambda transient: blind, FINE)
    assert [one.gain for one in found] == [0.0] * len(found)
    assert all(one.values["mass.drag", "c_2"] > 0 for one in found)


def test_an_amount_that_acts_elsewhere_at_its_usual_size_than_practically_off_is_nonlinear(tmp_path: Path) -> None:
    library, plant = tmp_path / "Side.mo", PLANTS["mass"]
    data = measured("mass", length=4.0)
    most = max(float(np.abs(record.data["x"]).max()) for record in data.records if isinstance(record.data, Record))
    library.write_text(SIDE.replace("STEEP", f"{10 / most:.3g}"), encoding="utf-8")
    own = Variants(plant.model, (plant.library, library))
    effects = (*read_catalogue(library), catalogue("mass")["mass.bias"])
    made = Models(session(own.build(())[0], data, effects, own.build, initial="rest", workers=1))
    fit = refitted(made)
    found = screen(made, lambda transient: fit, FINE, wrong_by=4.0)
    assert {one.effect.name: one.start is None for one in found if one.nonlinear} == {"side.push": True}
    assert {one.effect.name for one in found if not one.nonlinear} == {"side.push", "mass.bias"}
    starts = {share: Starts(lambda transient: fit, FINE, True, share, Settings()) for share in (0.0, 1e3)}
    assert [len(one.runners(found, [], 2)) for one in starts.values()] == [0, 2]  # where noise alone is left, and not


def test_a_limit_is_tried_below_what_its_variable_reaches(tmp_path: Path) -> None:
    data, made = stopped(tmp_path)
    fit = refitted(made)
    found = screen(made, lambda transient: fit, FINE, Sizes(limits=(0.9, 0.5)))
    most = max(float(np.abs(record.data["x"]).max()) for record in data.records if record.use == "fit")
    tried = sorted(1 / one.values["stops.ends", "inverse_x_m"] for one in found)
    assert tried == pytest.approx([0.5 * most, 0.9 * most], rel=0.03)
    assert best_of_each(found) == found[:1]  # each effect once, at its best size
