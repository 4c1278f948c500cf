"""Several laws that no catalogue holds: learned one after the other, and the order of those that compete."""

from dataclasses import replace
from functools import cache
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from pysim.diagnosis import diagnose, rivals
from pysim.diagnosis.candidate import Models
from pysim.diagnosis.checkpoint import Checkpoint
from pysim.diagnosis.law_search import LawSearch
from pysim.diagnosis.learn.learn import Learner
from pysim.diagnosis.learn.screening import seen
from pysim.diagnosis.progress import Progress
from pysim.diagnosis.refit import FinalFit, begin
from pysim.diagnosis.search import Found, Search
from pysim.diagnosis.session import Session
from pysim.effects.learned import places
from pysim.types import Dataset, Record
from pysim.types.answer import Diagnosis
from pysim.workflow.learned import with_classes, with_laws
from tests.pysim.diagnosis.learn.clocked import within_the_band
from tests.pysim.diagnosis.plants import FINE, given, measured, variants
from validation.held_out import held_out_rms


@cache
def worn(choosing: int = 1) -> tuple[Dataset, Diagnosis]:
    """An axis whose guideway brakes towards its ends, and whose amplifier has a dead band; no effect is at hand."""
    effects = {"damper": {"d_2": 1e4}, "axis.dead_band": {"u_0": 0.1}}
    own = {"m": 10.5, "d": 90.0, "K": 20.5, "T": 0.021, "K_v": 50.0}
    data = measured("axis", effects, own, fit=(1,), validate=(3,)[:choosing])
    return data, diagnose(given("axis", data, [], initial="near rest"))


def test_a_second_law_is_learned_beside_the_first_and_both_are_refitted() -> None:
    data, found = worn()
    assert [law.slot for law in found.learned] == ["guideway", "amplifier"]
    (damping, voltage), steps = found.learned, found.history
    assert (str(damping.factor), damping.argument, str(voltage.factor)) == ("v", "guideway.x", "sign(u)")
    assert within_the_band(damping, -1e4 * damping.knots**2) > 0.8
    logged = data.records[0].data
    assert isinstance(logged, Record)
    assert damping.reach == pytest.approx((logged["x"].min(), logged["x"].max()), abs=0.05 * np.ptp(logged["x"]))
    assert damping.knots[0] < damping.reach[0] < damping.reach[1] < damping.knots[-1]
    errors = [step.validate for step in steps[1:]]
    assert [law.held_out for law in found.learned] == [(errors[0], errors[1]), (errors[1], errors[2])]
    assert errors[0] > 2 * errors[1] > 4 * errors[2]
    assert [*found.missing[:2]] == [*found.learned]
    curves = {f"law{k}_c" for k in range(9)}
    assert not {one.name for step in steps for one in step.estimates if one.name.startswith(tuple(curves))}


def test_a_dead_band_depends_on_the_voltage_and_on_nothing_else() -> None:
    """A curve over the speed times the voltage's sign comes near, if curves are too round at their ends."""
    found = diagnose(given("axis", measured("axis", {"axis.dead_band": {"u_0": 0.1}}, fit=(1,), validate=(3,)), []))
    (law,) = found.learned
    assert (law.slot, str(law.factor), law.argument) == ("amplifier", "", "amplifier.u")
    assert found.history[-1].validate == pytest.approx(1.0, abs=0.03)


def test_a_law_is_in_the_history_where_no_effect_is_allowed() -> None:
    opened = given("axis", measured("axis", {"damper": {"d_2": 1e3}}, fit=(1,), validate=(3,)), [])
    found = diagnose(replace(opened, settings=replace(opened.settings, max_effects=0)))
    (law,) = found.learned
    assert (law.slot, found.history[-1].step) == ("guideway", "guideway: v * h(guideway.x)")
    assert law.held_out == (found.history[-2].validate, found.history[-1].validate)


@cache
def braked() -> tuple[Dataset, Session, Search, FinalFit]:
    """An axis whose guideway brakes towards its ends, and the refitted model without."""
    data = measured("axis", {"damper": {"d_2": 1e3}}, fit=(1,), validate=(3,))
    opened = given("axis", data, [])
    search = Search(Models(opened), FINE, opened.settings, Progress(lambda told: None), Checkpoint(None, ""))
    base = search.fit_base()
    search.floors = search.floors.with_(base)
    return data, opened, search, base


def test_a_law_that_stood_in_for_a_later_one_is_left_out() -> None:
    """The first law was learned where the amplifier alone could have one."""
    _, opened, search, base = braked()
    first = Learner(opened, base, search.floors, 1, search.vetoed, lambda said: None, only="amplifier").learn()
    assert first.law is not None
    (law,) = LawSearch(opened, search).another(Found(base, first.fits[0].fit, (), search.floors), [first])
    assert law.law is not None
    assert law.law.found.label == "guideway: v * h(guideway.x)"
    assert law.present is base
    assert max(search.floors.over(law.law.fit).values()) < 1.05


def test_a_second_law_is_placed_by_runs_of_the_model_with_the_first() -> None:
    data, opened, search, base = braked()
    law = Learner(opened, base, search.floors, 1, search.vetoed, lambda said: None, only="guideway").learn().law
    assert law is not None
    logged, where = data.records[0].data, places(opened.slots, opened.model)
    assert isinstance(logged, Record)
    off = [np.std(seen(fit, where)["guideway.x"] - logged["x"]) for fit in (base, law.held)]
    assert off[1] < 0.5 * off[0]


@pytest.mark.parametrize(("damping", "learns"), [(2.0, True), (-60.0, False)])
def test_beside_an_unstable_model_no_law_is_tried(damping: float, learns: bool) -> None:
    """With negative damping the mass of 1 kg is about 1e200 m away when the log of 8 s ends."""
    opened = given("mass", measured("mass", fit=(1,)), [], initial="near rest")
    search = Search(Models(opened), FINE, opened.settings, Progress(lambda told: None), Checkpoint(None, ""))
    candidate = search.models.of(())
    space = replace(candidate.space, lower=np.array([0.5, -100.0, 1.0]))
    candidate = replace(candidate, problem=replace(candidate.problem, space=space))
    base = begin(candidate, {"m": 1.0, "d": damping, "k": 40.0}, FINE)
    assert bool(seen(base, places(opened.slots, opened.model))) is learns


def test_the_classes_of_both_laws_leave_what_the_answer_says(tmp_path: Path) -> None:
    (data, found), own = worn(), variants("axis")
    effects, wider = with_laws(with_classes(found, own.class_name, own.libraries), own, tmp_path)
    model, _ = wider.build(effects)
    assert {"guideway.c[1]", "amplifier.c[1]"} <= {one.name for one in model.variables}
    left = held_out_rms(model, data, {one.name: one.value for one in found.estimates}, "validate")
    floors = {name.rpartition("/")[2]: floor.sd for name, floor in found.left.floors.items()}
    error = np.sqrt(np.mean([(size / floors[name]) ** 2 for name, size in left.items()]))
    assert error == pytest.approx(found.history[-1].validate, rel=0.01)


def test_where_one_log_is_all_there_is_no_second_law_is_learned() -> None:
    _, found = worn(choosing=0)
    assert len(found.learned) == 1
    assert not found.complete


def test_a_law_that_gains_little_is_not_first_for_a_smaller_lambda(monkeypatch: pytest.MonkeyPatch) -> None:
    """By its own lambda each loses more by 13 coefficients than it gains, and the one that gains little less."""
    opened = given("mass", measured("mass", fit=(1,)), [], initial="near rest")
    search = Search(Models(opened), FINE, opened.settings, Progress(lambda told: None), Checkpoint(None, ""))
    base = search.fit_base()
    learner = Learner(opened, base, search.floors.with_(base), 1, search.vetoed, lambda said: None)
    count, cost = rivals.samples(learner._rough), learner._rough.point.cost
    much, little = (SimpleNamespace(cost=cost - gain, df=13.0) for gain in (2000.0, 130.0))
    lambdas = {id(much): 400.0, id(little): 60.0}
    monkeypatch.setattr(learner, "_colour", lambda one, present: lambdas[id(one)])
    own = [-rivals.penalised(cost - one.cost, one.df, lambdas[id(one)], count) for one in (much, little)]
    assert own[0] > own[1]
    assert learner._ordered([little, much]) == [much, little]  # type: ignore[list-item]
