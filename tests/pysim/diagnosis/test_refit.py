"""Refits of rivals on a plant whose friction the model lacks."""

from dataclasses import replace
from functools import cache

import pytest

from pysim.diagnosis import rank
from pysim.diagnosis.candidate import Models, Values
from pysim.diagnosis.refit import FinalFit, Runner, advance, begin, converged, left_out, race
from pysim.diagnosis.settings import Settings
from pysim.identify.greybox.optimiser import State
from pysim.identify.greybox.residuals import failed_point
from pysim.identify.greybox.runs import Failure
from pysim.types import FitOutcome, NoteCode, Outcome
from tests.pysim.diagnosis.plants import FINE, catalogue, given, measured, refitted

ROUGH = FINE.rough()
EFFECTS = ("mass.friction", "mass.drag", "mass.hardening", "mass.bias", "mass.stick_slip")


@cache
def models() -> Models:
    return Models(given("mass", measured("mass", {"mass.friction": {"F_c": 0.3}}, {"d": 1.8}, length=4.0)))


@cache
def base() -> FinalFit:
    return refitted(models(), simulation=ROUGH)


def start(name: str, size: float = 0.1, values: Values | None = None) -> FinalFit:
    """A rival at this share of its usual size."""
    effect = catalogue("mass")[name]
    own = {(name, p.name): size * p.nominal for p in effect.strengths}
    return begin(models().of([effect]), {**base().values, **own, **(values or {})}, ROUGH, base())


def raced(*fits: FinalFit, **settings: object) -> list[FinalFit]:
    runners = [Runner(lambda fit=fit: fit, base().point.cost) for fit in fits]
    return race(runners, replace(Settings(), **settings), lambda fit: converged(fit, FINE))


def test_the_right_effect_wins_and_ends_where_a_fit_of_it_alone_ends() -> None:
    found = raced(*map(start, EFFECTS))
    assert sorted(fit.names[0] for fit in found) == sorted(EFFECTS)
    friction = found[0]
    assert friction.names == ("mass.friction",)
    alone = refitted(models(), "mass.friction", values={("mass.friction", "F_c"): 0.5})
    assert friction.ended
    assert friction.point.cost == pytest.approx(alone.point.cost, abs=1.5)  # integrated at other steps
    assert friction.values["mass.friction", "F_c"] == pytest.approx(0.3, abs=0.02)
    costs = [fit.point.cost for fit in found]
    assert costs == sorted(costs)


def test_those_that_promise_too_little_are_left_where_they_are() -> None:
    """Two go on beyond the first point, of which one is refitted to its end."""
    found = raced(*(start(name, 0.01) for name in EFFECTS), finalists=1, heat=1, promising=0.9)
    tried = {fit.names[0]: fit.state.tried for fit in found}
    assert found[0].ended
    assert tried["mass.bias"] == tried["mass.hardening"] == tried["mass.drag"] == 1
    assert tried["mass.stick_slip"] > 1


def test_of_two_starts_of_one_candidate_the_better_one_is_kept() -> None:
    bad = start("mass.friction", 20.0, {"k": 150.0})
    good = start("mass.friction")
    for order in ((good, bad), (bad, good)):
        (found,) = raced(*order)
        assert found.point.cost == pytest.approx(converged(good, FINE).point.cost, abs=0.1)


def test_what_cannot_be_simulated_does_not_run() -> None:
    nowhere = replace(start("mass.drag"), state=State(failed_point(base().point.x, Failure("", Outcome.DONE, ""))))
    assert not nowhere.good
    assert raced(nowhere) == []
    assert [fit.names for fit in raced(start("mass.bias"), nowhere)] == [("mass.bias",)]


def test_what_a_refit_promises_is_what_is_left_to_gain() -> None:
    """Close to its end first order is good."""
    end = refitted(models(), "mass.friction", simulation=FINE)
    near = begin(end.candidate, {**end.values, "k": 1.002 * float(end.values["k"])}, FINE)
    assert near.state.outcome is None
    assert advance(near, 0).expected == pytest.approx(end.point.cost, abs=0.15 * (near.point.cost - end.point.cost))


def test_a_search_that_has_ended_is_not_gone_on_with() -> None:
    end = converged(start("mass.friction"))
    assert end.state.outcome is FitOutcome.CONVERGED
    assert advance(end, 5).state.tried == end.state.tried
    assert end.expected == end.point.cost


@pytest.mark.parametrize(("most", "believed"), [(5.0, True), (0.295, True), (0.2, False)])
def test_an_effect_that_would_end_far_beyond_its_bound_is_not_believed(most: float, believed: bool) -> None:
    """Its true size is 0.3 N."""
    friction = catalogue("mass")["mass.friction"]
    narrow = replace(friction, parameters=tuple(replace(p, max=min(p.max, most)) for p in friction.parameters))
    fit = converged(begin(models().of([narrow]), base().values, FINE))
    assert fit.values["mass.friction", "F_c"] == pytest.approx(min(0.3, most), abs=0.01)
    assert fit.believable("mass.friction", Settings()) == believed


def test_an_effect_that_is_not_believed_is_told() -> None:
    friction, drag = (catalogue("mass")[name] for name in ("mass.friction", "mass.drag"))
    narrow = replace(friction, parameters=tuple(replace(p, max=min(p.max, 0.2)) for p in friction.parameters))
    found = rank(replace(models().session, catalogue=(narrow, drag)))
    assert [note.values["effect"] for note in found.notes if note.code is NoteCode.BEYOND_BOUND] == ["mass.friction"]
    assert ("mass.friction",) not in {one.effects for one in found.rivals if one.refitted}
    told = rank(replace(models().session, catalogue=(friction, drag)))
    assert NoteCode.BEYOND_BOUND not in {note.code for note in told.notes}


def test_a_model_refitted_without_a_log_is_that_of_the_other_logs_alone() -> None:
    data = measured("mass", {"mass.drag": {"c_2": 0.5}}, {"d": 1.8}, fit=(1, 2), validate=(3,), length=4.0)
    effect = catalogue("mass")["mass.drag"]
    both, second = (
        Models(given("mass", replace(data, records=records), initial="near rest"))
        for records in (data.records, data.records[1:])
    )
    whole = converged(begin(both.of([effect]), {}, FINE))
    fit = converged(left_out(whole, ["fit-1.txt"]))
    alone = converged(begin(second.of([effect]), whole.values, FINE))
    assert fit.ended
    assert fit.values == pytest.approx(alone.values, rel=1e-3)
    assert fit.point.cost == pytest.approx(alone.point.cost, abs=0.1)
    held = fit.candidate.residuals(FINE, "validate").observations
    assert [one.sources for one in held] == [("fit-1.txt",), ("validate-3.txt",)]
