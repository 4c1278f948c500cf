"""The ruler counts what the fit counts, and its slopes are the model's."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from pysim.diagnose import residuals
from pysim.diagnose.refit import refit
from pysim.diagnose.residuals import Ruler, rulers
from pysim.diagnose.subject import extended, identifiable
from pysim.identify.greybox import GaussNewton, Simulation, Treatment, fit, problem
from pysim.io import read_model
from pysim.simulate import Esdirk, Rodas, simulate_many
from pysim.types import BadInput, Record
from tests.pysim.diagnose.bench import REST
from tests.pysim.diagnose.toy import base, build_variant, measured, toy_subject


def test_exact_slopes_and_differences_agree() -> None:
    subject = toy_subject(measured(1))
    ruler, held = rulers(subject.targets)
    assert held is not None
    what = extended(subject, ())
    x = what.space.to_search(what.space.start)
    exact = ruler.evaluation(what, x)
    assert exact.residual == pytest.approx(ruler.at(what, x))
    tight = Ruler(ruler.targets, Rodas(rtol=1e-9, atol=1e-9))
    for j in range(x.size):
        h = 1e-4 * np.eye(x.size)[j]
        up, down = tight.at(what, x + h), tight.at(what, x - h)
        central = (up - down) / 2e-4
        assert np.linalg.norm(exact.jacobian[:, j] - central) < 1e-2 * np.linalg.norm(central)


def test_slopes_of_a_run_that_chatters_are_differences(monkeypatch: pytest.MonkeyPatch) -> None:
    """Where the run for exact slopes takes so many more steps than a plain one."""
    given = toy_subject(measured(1))
    ruler, what = Ruler(given.targets), extended(given, ())
    x = what.space.to_search(what.space.start)
    exact = ruler.evaluation(what, x)
    monkeypatch.setattr(residuals, "_PATIENCE", 0)
    cheap = ruler.evaluation(what, x)
    assert cheap.residual.tolist() == exact.residual.tolist()
    for j, step in enumerate(residuals.steps_inside(x, what.space.bounds())):
        aside = ruler.at(what, x + step * np.eye(x.size)[j])
        assert aside is not None
        assert cheap.jacobian[:, j] == pytest.approx((aside - exact.residual) / step)
        assert np.linalg.norm(cheap.jacobian[:, j] - exact.jacobian[:, j]) > 0


def test_a_model_that_ran_away_has_no_residuals(monkeypatch: pytest.MonkeyPatch) -> None:
    """Differences by such would be slopes whose products leave the range of numbers."""
    given = toy_subject(measured(1))
    ruler, what = Ruler(given.targets), extended(given, ())
    runs = ruler.experiments({})

    def wild(*args: Any, **options: Any) -> list[Record]:
        return [replace(one, values=1e60 * one.values) for one in simulate_many(*args, **options)]

    assert ruler.count(what.model, runs) is not None
    monkeypatch.setattr(residuals, "simulate_many", wild)
    assert ruler.count(what.model, runs) is None


def test_the_refit_ends_where_the_fit_does() -> None:
    data = measured(7)
    subject = toy_subject(data)
    ruler = replace(rulers(subject.targets)[0], solver=Rodas(rtol=1e-8, atol=1e-8))
    what = extended(subject, ())
    best = refit(ruler, what, ruler.evaluation(what, what.space.to_search(what.space.start)))
    fine = Simulation(Esdirk(rtol=1e-8, atol=1e-8))
    treatment = Treatment(rest=REST, initial="rest")
    other = fit(
        problem(base(), [data], ["m", "d", "k"], treatment=treatment),
        optimiser=GaussNewton(tolerance=1e-4),
        simulation=fine,
    )
    found = what.space.to_model(best.x)
    for value, estimate in zip(found, other.estimates, strict=True):
        assert abs(value - estimate.value) < 0.1 * estimate.std


def test_what_may_be_refitted() -> None:
    assert identifiable(base()) == ("m", "d", "k")
    model, _ = build_variant([])
    assert identifiable(model) == ("m", "d", "k")
    assert read_model(base().path).name == "Toy.Mass"


def test_effects_need_the_class() -> None:
    subject = toy_subject(measured(1))
    alone = subject.__class__(subject.model, subject.targets, subject.free, subject.catalogue, None)
    with pytest.raises(BadInput, match="class is not at hand"):
        extended(alone, subject.catalogue[:1])
