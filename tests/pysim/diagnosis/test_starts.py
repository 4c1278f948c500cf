"""Which effects are refitted, and from where, on a mass with a spring."""

from collections.abc import Mapping

import pytest

from pysim.diagnosis.candidate import Models
from pysim.diagnosis.refit import FinalFit, Runner, race
from pysim.diagnosis.screen import best_of_each, screen
from pysim.diagnosis.settings import Settings
from pysim.diagnosis.starts import Starts
from tests.pysim.diagnosis.plants import FINE, given, measured, refitted


def runners(models: Models, fit: FinalFit, *, near: bool) -> list[Runner]:
    def beside(transient: bool) -> FinalFit:
        return fit

    found = screen(models, beside, FINE)
    return Starts(beside, FINE, near, Settings()).runners(found, [], len(best_of_each(found)))


def begun(models: Models, fit: FinalFit, *, near: bool) -> Mapping[str, list[FinalFit]]:
    """Where each effect's refits begin."""
    starts: dict[str, list[FinalFit]] = {}
    for runner in runners(models, fit, near=near):
        start = runner.start()
        starts.setdefault(start.names[0], []).append(start)
    return starts


def test_an_effect_is_refitted_though_what_it_leaves_out_colours_the_residual() -> None:
    """A constant force that is missing is all of the residual, which without it is worth a handful of samples."""
    models = Models(given("mass", measured("mass", {"mass.bias": {"F_b": 0.4}}), ("mass.bias", "mass.hardening")))
    starts = begun(models, refitted(models), near=True)
    assert list(starts) == ["mass.bias"]


def test_near_the_floor_nothing_is_refitted_where_nothing_is_missing() -> None:
    models = Models(given("mass", measured("mass")))
    assert begun(models, refitted(models), near=True) == {}


def test_an_effect_begins_as_good_as_off_and_only_what_promises_enough_goes_on() -> None:
    """Friction is missing: a force that is constant promises next to nothing, and stays where it starts."""
    models = Models(given("mass", measured("mass", {"mass.friction": {"F_c": 0.3}}), ("mass.friction", "mass.bias")))
    fit = refitted(models)
    found = race(runners(models, fit, near=False), Settings())
    friction, bias = (next(one for one in found if name in one.names) for name in ("mass.friction", "mass.bias"))
    assert friction.values["mass.friction", "F_c"] == pytest.approx(0.3, rel=0.05)
    assert bias.state.tried == 0
    assert abs(bias.point.cost - fit.point.cost) < 0.01 * (fit.point.cost - friction.point.cost)
