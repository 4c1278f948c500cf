"""Which effects are refitted, and from where, on a mass with a spring."""

from collections.abc import Mapping
from pathlib import Path

import pytest

from pysim.diagnosis.candidate import Models
from pysim.diagnosis.refit import FinalFit, Runner, race
from pysim.diagnosis.screen import Sizes, best_of_each, screen
from pysim.diagnosis.settings import Settings
from pysim.diagnosis.starts import Starts
from tests.pysim.diagnosis.plants import FINE, given, measured, refitted, stopped


def runners(models: Models, fit: FinalFit, *, near: bool, sizes: Sizes | None = None) -> list[Runner]:
    def beside(transient: bool) -> FinalFit:
        return fit

    found = screen(models, beside, FINE, sizes)
    return Starts(beside, FINE, near, 0.0, Settings()).runners(found, [], len(best_of_each(found)))


def begun(models: Models, fit: FinalFit, *, near: bool, sizes: Sizes | None = None) -> Mapping[str, list[FinalFit]]:
    """Where each effect's refits begin."""
    starts: dict[str, list[FinalFit]] = {}
    for runner in runners(models, fit, near=near, sizes=sizes):
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


def test_far_from_the_floor_a_limit_begins_at_the_size_that_is_nearest_the_measurements(tmp_path: Path) -> None:
    """The model's parameters as given, its ends where they stop least."""
    _, models = stopped(tmp_path)
    fit = refitted(models)
    sizes = Sizes(limits=(0.92, 0.55, 0.2))
    tried = {one.tried["inverse_x_m"] for one in screen(models, lambda transient: fit, FINE, sizes)}
    starts = begun(models, fit, near=False, sizes=sizes)["stops.ends"]
    assert len(starts) == 2
    nearest = starts[1].values["stops.ends", "inverse_x_m"]
    assert nearest in tried
    assert nearest == min(tried)  # the plant has no ends: the widest limit is nearest


def test_far_from_the_floor_an_effect_that_fits_at_the_nominal_parameters_begins_there_too() -> None:
    """A friction of its usual size is nearer to the logs than none, a constant force is farther away."""
    models = Models(given("mass", measured("mass", {"mass.friction": {"F_c": 0.3}}), ("mass.friction", "mass.bias")))
    starts = begun(models, refitted(models), near=False)
    off, usual = starts["mass.friction"]
    (friction,) = (effect for effect in models.session.catalogue if effect.name == "mass.friction")
    (strength,) = friction.strengths
    assert usual.values["mass.friction", "F_c"] == pytest.approx(strength.nominal)
    assert off.values["mass.friction", "F_c"] < 1e-3 * strength.nominal
    nominal = {key: value for key, value in usual.values.items() if isinstance(key, str)}
    assert nominal == pytest.approx({"m": 1.0, "d": 2.0, "k": 40.0})
    assert len(starts["mass.bias"]) == 1


def test_an_effect_begins_as_good_as_off_and_only_what_promises_enough_goes_on() -> None:
    """Friction is missing: a force that is constant promises next to nothing, and stays where it starts."""
    models = Models(given("mass", measured("mass", {"mass.friction": {"F_c": 0.3}}), ("mass.friction", "mass.bias")))
    fit = refitted(models)
    found = race(runners(models, fit, near=False), Settings())
    friction, bias = (next(one for one in found if name in one.names) for name in ("mass.friction", "mass.bias"))
    assert friction.values["mass.friction", "F_c"] == pytest.approx(0.3, rel=0.05)
    assert bias.state.tried == 0
    assert abs(bias.point.cost - fit.point.cost) < 0.01 * (fit.point.cost - friction.point.cost)
