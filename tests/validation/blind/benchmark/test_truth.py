"""Footprints and bounds of a short session against plain linear algebra."""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
import pytest

from pysim.simulate import Rodas, simulate
from pysim.types import Experiment, Record, Signal
from validation.blind.benchmark.judged import _BASE_POWERS, _UNIT_POWERS
from validation.blind.benchmark.truth import Truth, evaluation, noise_free
from validation.blind.benchmark.workshop import workshop
from validation.blind.plant import BOUNDS, Case, measure
from validation.blind.plant import Test as PlantTest
from validation.blind.plant import case as plant_case
from validation.blind.plant import programme as plant_programme

_SINES = ("O+50_A20/2Hz", "O+50_A20/8Hz", "O-50_A10/16Hz")
SHORT = (
    *(test for test in plant_programme() if any(test.file.endswith(f"{name}.txt") for name in _SINES)),
    PlantTest("chirp.txt", "chirp", "validate", 4.0, 50.0, 10.0),
    PlantTest("wave.txt", "stochastic", "fit", 12.0, peak_period=1.0),
)
NAMED = Case("a", "named", (("spring.hardening", "small"),), noise=0.1, seed=5)


@pytest.fixture(scope="module")
def truth() -> Iterator[Truth]:
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(plant_case, "programme", lambda: SHORT)
        yield Truth(NAMED, measure(NAMED), workshop())


def test_noise_free_is_the_data_set_without_its_noise(truth: Truth) -> None:
    noisy, clean = truth.measured.dataset, noise_free(truth.measured)
    off = []
    for one, other in zip(noisy.records, clean.records, strict=True):
        assert isinstance(one.data, Record)
        assert isinstance(other.data, Record)
        assert np.array_equal(one.data["alphaCMD"], other.data["alphaCMD"])
        off.append(one.data["alphaPercent"] - other.data["alphaPercent"])
    size = np.concatenate(off).size
    told = np.hypot(0.1, plant_case.ANGLE_STEP / np.sqrt(12))
    assert np.std(np.concatenate(off)) == pytest.approx(told, rel=4 / np.sqrt(2 * size))


def test_footprint_is_what_no_parameter_can_take(truth: Truth) -> None:
    """To first order, the residual at the truth less its part in the space of the slopes."""
    point, targets = truth.model(()), truth.of_use("fit")
    at = evaluation(targets, point, point.x)
    inside = [j for j, name in enumerate(BOUNDS) if name != "K_L"]  # near its bound
    step = np.linalg.lstsq(at.jacobian[:, inside], -at.residual, rcond=1e-5)[0]
    first_order = float(np.sum((at.residual + at.jacobian[:, inside] @ step) ** 2))
    found = truth.left(())
    assert found == pytest.approx(first_order, rel=0.15)
    assert 3 < found < 0.5 * at.cost  # refitting takes much of it, and something stays
    far, bent = {"tau": 0.01}, {name: value * 1.02 for name, value in truth.base.items()}
    assert truth.left((), far) == found  # no worse start is taken
    assert truth.left((), bent) == pytest.approx(found, abs=0.5)
    with_it = truth.left(["spring.hardening"])
    assert with_it is not None
    assert with_it < 0.5


def test_bound_is_what_drawn_noise_costs(truth: Truth) -> None:
    """Parameters moved by noise to first order: the mean error on what is held out."""
    limits = truth.held_out()
    assert limits is not None
    point = truth.model(["spring.hardening"])
    fitted, held = (evaluation(truth.of_use(use), point, point.x) for use in ("fit", "validate"))
    rng = np.random.default_rng(1)
    noise = rng.standard_normal((fitted.residual.size, 100))
    moved = np.linalg.lstsq(fitted.jacobian, noise, rcond=1e-5)[0]
    drawn = float(np.sqrt(np.mean((held.jacobian @ moved) ** 2)))
    assert limits[0] == pytest.approx(drawn, rel=0.1)
    assert limits[1] < 0.2  # plant and FMU are not the same, but nearly


def test_slopes_by_differences_agree_with_exact_ones(truth: Truth) -> None:
    point, targets = truth.model(["spring.hardening"]), truth.of_use("validate")
    exact = evaluation(targets, point, point.x)
    differences = evaluation(targets, replace(point, events=True), point.x)
    sizes = np.linalg.norm(exact.jacobian, axis=0)
    off = np.linalg.norm(differences.jacobian - exact.jacobian, axis=0)
    assert np.all(off < 0.05 * sizes.max())
    assert np.allclose(differences.residual, exact.residual, atol=0.02)


def test_one_direction_shows_in_no_signal() -> None:
    """Stroke times s, area over s, and all else as the powers say: the signals stay."""
    shop = workshop()
    effects = [shop.effect(name) for name in ("spring.hardening", "linkage.backlash")]
    model, places = shop.variant(effects)
    command = Signal.through(np.array([0.0, 0.3, 0.6, 1.0]), np.array([0.0, 60.0, -40.0, 20.0]))
    run = Experiment(np.linspace(0, 1, 101), ("alphaPercent", "u"), {"alphaCMD": command})
    values = {name: float(model[name].start or 0.0) for name in _BASE_POWERS}
    powers = dict(_BASE_POWERS)
    for effect in effects:
        for p in effect.parameters:
            values[f"{places[effect.name]}.{p.name}"] = p.nominal
            powers[f"{places[effect.name]}.{p.name}"] = _UNIT_POWERS[p.unit]
    scaled = {name: value * 1.3 ** powers[name] for name, value in values.items()}
    off = {**values, **{f"{places[e.name]}.{p.name}": 0.0 for e in effects for p in e.parameters}}
    solver = Rodas(rtol=1e-8, atol=1e-8)
    here, there, without = (simulate(model, run.override(**v), solver=solver) for v in (values, scaled, off))
    assert np.abs(here.values - there.values).max() < 1e-3
    assert np.abs(here["alphaPercent"] - without["alphaPercent"]).max() > 0.1


def test_a_limit_is_seen_to_have_events(truth: Truth) -> None:
    limited = Truth(replace(NAMED, effects=(("valve.saturation", "large"),)), truth.measured, truth.shop)
    assert limited.model(["valve.saturation"]).events
    assert not truth.model(["spring.hardening"]).events
