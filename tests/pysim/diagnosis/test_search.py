"""What logs that may choose say of a larger model."""

import math
from dataclasses import replace
from functools import cache
from pathlib import Path
from tempfile import mkdtemp

import numpy as np
import pytest
from scipy.optimize import least_squares

from pysim.diagnosis import add, diagnose, learn
from pysim.diagnosis.candidate import Models
from pysim.diagnosis.checkpoint import Checkpoint, whose
from pysim.diagnosis.progress import Progress
from pysim.diagnosis.refit import FinalFit, advance, begin, converged
from pysim.diagnosis.search import Compared, Search, Step, Table
from pysim.diagnosis.settings import Settings
from pysim.types import MeasuredRecord, Record
from pysim.types.answer import Verdict
from tests.pysim.diagnosis.plants import FINE, given, measured, refitted, with_library

FRAIL = """
package Frail
  model Drag "A law that ends at 0.15 m, whatever its size"
    extends Mass.PartialForce;
    parameter Real a(unit="N.s/m", min=0, max=5, nominal=1) = 0 "0 = off";
  equation
    f = -a*v*sqrt(1 - x/0.15);
    annotation(__HydraulicTestBench(effect="frail.drag", slot="force"));
  end Drag;

  model Root "A law that only small sizes have"
    extends Mass.PartialForce;
    parameter Real c(unit="N.s/m", min=0, max=5, nominal=0.5) = 0 "0 = off";
  equation
    f = -c*v*sqrt(1 - c);
    annotation(__HydraulicTestBench(effect="frail.root", slot="force"));
  end Root;
end Frail;
"""


@cache
def found(peak: float) -> tuple[Search, FinalFit, FinalFit]:
    """The base model and one that can be simulated in small tests alone; commands of the choosing log up to a peak."""
    library = Path(mkdtemp(prefix="frail-")) / "Frail.mo"
    small, other = (measured("mass", {}, {"d": 2.5}, fit=(1,), length=4.0, peak=p) for p in (2.0, peak))
    data = replace(small, records=(small.records[0], other.records[1]))
    models = Models(with_library(library, FRAIL, data))
    search = Search(models, FINE, Settings(), Progress(lambda told: None), Checkpoint(None, ""))
    base = refitted(models)
    search.floors = search.floors.with_(base)
    return search, base, refitted(models, "frail.drag", values={("frail.drag", "a"): 0.5})


def test_a_model_that_cannot_run_through_the_choosing_logs_is_vetoed() -> None:
    search, base, frail = found(20.0)
    assert search.vetoed(base, frail, search.test(base, frail)).verdict is Verdict.VETOED
    worse = search._held_out([(base, frail)])
    better = search._held_out([(frail, base)])
    assert worse == (math.inf, 0.0)
    assert better == (-math.inf, 0.0)
    assert search._held_out([(frail, frail)]) is None
    assert search._held_out([(base, frail), (frail, base)]) == (math.inf, 0.0)


@cache
def hardened() -> tuple[Search, FinalFit, FinalFit]:
    """The model refitted without and with the effect that the plant has."""
    data = measured("mass", {"mass.hardening": {"k_3": 200.0}}, fit=(1,), validate=(2,))
    models = Models(given("mass", data, ["mass.hardening"], initial="rest"))
    search = Search(models, FINE, Settings(), Progress(lambda told: None), Checkpoint(None, ""))
    return search, refitted(models), refitted(models, "mass.hardening", values={("mass.hardening", "k_3"): 100.0})


def test_a_law_is_vetoed_where_an_effect_predicts_the_choosing_logs_better(monkeypatch: pytest.MonkeyPatch) -> None:
    search, base, effect = hardened()
    law = replace(base, candidate=replace(base.candidate, law="a law that does nothing"))
    test = search.test(base, effect)
    assert search.vetoed(base, law, test).verdict is Verdict.BETTER
    tables = {frozenset[str](): Table((), 0.0, (Compared(effect, "mass.hardening", test),), ())}
    monkeypatch.setattr(search, "_tables", tables)
    assert search.vetoed(base, law, test).verdict is Verdict.VETOED
    assert search.vetoed(base, effect, test).verdict is Verdict.BETTER


@pytest.mark.parametrize(("rise", "of_a_law"), [(-1.0, Verdict.BETTER), (1.0, Verdict.VETOED)])
def test_a_rise_that_chance_may_bring_vetoes_a_law_and_no_effect(
    rise: float, of_a_law: Verdict, monkeypatch: pytest.MonkeyPatch
) -> None:
    """One stretch of a log, where a curve bends, can hold all of the rise; between stretches it is chance then."""
    search, base, effect = hardened()
    test, law = search.test(base, effect), replace(effect, candidate=replace(effect.candidate, law="a law"))
    monkeypatch.setattr(search, "_held_out", lambda pairs: (rise, 10.0))
    assert search.vetoed(base, effect, test).verdict is Verdict.BETTER
    assert search.vetoed(base, law, test).verdict is of_a_law


@pytest.mark.parametrize("law", ["", "a law whose coefficient stays as it was fitted"])
def test_the_choosing_logs_say_by_how_much_their_cost_rises_as_far_as_parameters_are_open(law: str) -> None:
    """Against the least cost of both uses together around the fit, sought by SciPy."""
    search, base, frail = found(2.0)
    own = frail.candidate.keys.index(("frail.drag", "a"))
    if law:
        prior = np.zeros((frail.point.x.size, frail.point.x.size))
        prior[own, own] = 1.0
        frail = replace(frail, candidate=replace(frail.candidate, law=law, precision=prior))
    answer = search._held_out([(base, frail)])
    assert answer is not None
    costs = []
    for fit in (base, frail):
        candidate, there = fit.candidate, fit.point
        residuals = candidate.residuals(FINE, "validate")

        def open_(x: np.ndarray, use: str, fit: FinalFit = fit) -> np.ndarray:
            of = fit.candidate.residuals(FINE, use)
            point = of.evaluate(fit.candidate.model, fit.candidate.space, x, jacobian=False, states=False)
            return point.residual

        plain = residuals.evaluate(candidate.model, candidate.space, there.x, jacobian=False)

        def both(x: np.ndarray, fit: FinalFit = fit) -> np.ndarray:
            move = fit.point.jacobian @ (x - fit.point.x)
            return np.concatenate([open_(x, "validate", fit), move])

        lower, upper = candidate.space.bounds()
        if candidate.law:
            lower[own], upper[own] = there.x[own] - 1e-9, there.x[own] + 1e-9
        least = least_squares(both, there.x, bounds=(lower, upper), x_scale=1e-2)
        costs.append(plain.cost + least.cost - 0.5 * plain.square)
    assert answer[0] == pytest.approx(costs[1] - costs[0], abs=0.3)
    assert answer[1] > 0
    assert search._held_out([(base, frail)] * 2) == pytest.approx((2 * answer[0], math.sqrt(2) * answer[1]))


def test_a_model_that_does_not_run_beside_an_effect_is_refitted_from_the_base_model() -> None:
    search, base, frail = found(2.0)
    search._keep(base)
    (root,) = (effect for effect in search.models.session.catalogue if effect.name == "frail.root")
    candidate = search.models.of([root])
    far = {**base.values, ("frail.root", "c"): 2.0}
    assert not begin(candidate, far, FINE, base).good
    fit = search._refitted(candidate, far, frail)
    assert fit.good
    assert fit.point.cost <= base.point.cost + 1.0


def test_rivals_end_by_runs_as_fine_as_each_needs() -> None:
    """A sharp sign is integrated wrongly by tens of nats where runs are as rough as the base model allows."""
    data = measured("mass", {"mass.friction": {"F_c": 0.4}}, {"m": 1.05, "d": 1.8, "k": 42.0})
    opened = given("mass", data, ["mass.friction", "mass.stick_slip", "mass.bias"], initial="near rest")
    search = Search(Models(opened), FINE, opened.settings, Progress(lambda told: None), Checkpoint(None, ""))
    base = search.fit_base()
    search.floors = search.floors.with_(base)
    ended = [one.fit for one in search.expand(base).rivals if one.fit.ended]
    assert {fit.names for fit in ended} >= {("mass.friction",), ("mass.stick_slip",)}
    for fit in ended:
        finer = begin(fit.candidate, fit.values, fit.simulation.finer(1e-3), fit)
        assert search.floors.between(fit, finer) < 1.5 * opened.settings.fine
    assert min(fit.simulation.solver.rtol for fit in ended) < base.simulation.solver.rtol


@pytest.mark.parametrize(("deviations", "named"), [(4.0, ("sensor.offset",)), (0.1, ())])
def test_a_size_that_nobody_believes_leaves_something_missing(deviations: float, named: tuple[str, ...]) -> None:
    """The position is read too high by half its noise, a third of what is expected of such a sensor."""
    data, shift = measured("mass"), 0.0005
    shifted = []
    for record in data.records:
        assert isinstance(record.data, Record)
        values = record.data.values.copy()
        values[:, record.data.names.index("x")] += shift
        shifted.append(replace(record, data=replace(record.data, values=values)))
    logs = given("mass", replace(data, records=tuple(shifted)), ["mass.drag"])
    answer = diagnose(replace(logs, settings=Settings(believable=deviations), build_law=None))
    assert tuple(one.effect.name for one in answer.effects) == named
    assert answer.complete == bool(named)


def test_a_run_is_given_up_by_what_the_longest_log_takes_be_it_a_choosing_one() -> None:
    """It is ten times as long."""
    short, long = (measured("mass", fit=(1,), length=length) for length in (2.0, 20.0))
    given_up = []
    for choosing in (short, long):
        data = replace(short, records=(short.records[0], choosing.records[1]))
        search = Search(
            Models(given("mass", data)), FINE, Settings(), Progress(lambda told: None), Checkpoint(None, "")
        )
        search.fit_base()
        given_up.append(search.fine.solver.max_steps)
    assert given_up[1] > 4 * given_up[0]


def swung(d: float, periods: int) -> tuple[Search, FinalFit]:
    """A mass on a spring with a damper d (N.s/m), swung at 1.5 Hz from rest on, logged for some periods: its base fit.

    Closed form: what lasts, and what dies away with d/(2 m).
    """
    mass, k, force, f = 1.0, 40.0, 2.0, 1.5
    w, decay = 2 * math.pi * f, d / (2 * mass)
    own = math.sqrt(k / mass - decay**2)
    gain = force / complex(k - mass * w**2, d * w)
    time = np.arange(0.0, periods / f, 0.01)
    begun, speed = gain.imag, w * gain.real
    dying = np.exp(-decay * time) * (-begun * np.cos(own * time) - (speed + decay * begun) / own * np.sin(own * time))
    x = np.imag(gain * np.exp(1j * w * time)) + dying + 1e-3 * np.random.default_rng(1).standard_normal(time.size)
    values = np.column_stack([force * np.sin(w * time), x])
    log = MeasuredRecord(
        "sine.txt", "frequency-response", "fit", Record(time, values, ("F", "x"), ("N", "m")), 0.0, force, f
    )
    wave = measured("mass", {}, {"d": d, "k": k}, fit=(1,), validate=())
    opened = given("mass", replace(wave, records=(log, *wave.records)), [])
    search = Search(Models(opened), FINE, Settings(), Progress(lambda told: None), Checkpoint(None, ""))
    return search, search.fit_base()


@pytest.mark.parametrize(("d", "periods", "transient"), [(0.3, 6, True), (0.3, 90, False), (4.0, 8, False)])
def test_a_sine_that_is_not_steady_when_its_log_ends_is_run_as_the_bench_ran_it(
    d: float, periods: int, transient: bool
) -> None:
    search, base = swung(d, periods)
    assert (base.candidate.transient, search.models.all_transient) == (transient, transient)
    assert base.values["d"] == pytest.approx(d, rel=0.03)
    assert base.values["k"] == pytest.approx(40.0, rel=0.003)
    assert search.floors.with_(base).over(base)[("mass", "x")] < 1.05


@pytest.mark.parametrize("first", ["mass.friction", "mass.drag"])
def test_what_came_in_first_is_exchanged_for_what_does_better_beside_the_rest(first: str) -> None:
    """Friction and a bias are missing; whichever of friction and drag came in first, friction stays."""
    data = measured("mass", {"mass.friction": {"F_c": 0.4}, "mass.bias": {"F_b": 0.5}})
    opened = given("mass", data, ["mass.friction", "mass.drag", "mass.bias"], initial="near rest")
    search = Search(Models(opened), FINE, opened.settings, Progress(lambda told: None), Checkpoint(None, ""))
    base = search.fit_base()
    search.floors = search.floors.with_(base)
    known = {effect.name: effect for effect in opened.catalogue}
    fits = {name: search.with_effects(base, [known[name]]) for name in ("mass.friction", "mass.drag")}
    rivals = [Compared(fit, name, search.test(base, fit)) for name, fit in fits.items()]
    rivals.sort(key=lambda one: one.added != first)
    second = search.with_effects(fits[first], [known[first], known["mass.bias"]])
    steps = [
        Step(fits[first], first, rivals[0].test, False, tuple(rivals)),
        Step(second, "mass.bias", search.test(fits[first], second), False, ()),
    ]
    found = search._exchanged(base, steps)
    assert [step.added for step in found] == ["mass.friction", "mass.bias"]
    assert [step.model.names for step in found] == [("mass.friction",), ("mass.friction", "mass.bias")]
    assert found[-1].model.values["mass.friction", "F_c"] == pytest.approx(0.4, rel=0.1)
    assert found[0].rivals[0].added == "mass.friction"


def test_errors_of_an_effect_that_is_asked_for_are_those_of_runs_as_fine_as_it_needs() -> None:
    """A sharp sign is integrated wrongly where runs are as rough as the base model allows; a search refines them."""
    data = measured("mass", {"mass.friction": {"F_c": 0.4}}, {"m": 1.05, "d": 1.8, "k": 42.0})
    opened = given("mass", data, ["mass.friction"], initial="near rest")
    asked, sought = add(opened, opened.catalogue), diagnose(replace(opened, build_law=None))
    assert asked.history[-1].fit == pytest.approx(sought.history[-1].fit, abs=0.005)


@pytest.mark.slow
def test_errors_of_a_learned_law_are_those_of_runs_as_fine_as_it_needs() -> None:
    """A friction that changes sign sharply, learned where no effect is like it, leaves as little as the effect."""
    data = measured("mass", {"mass.friction": {"F_c": 0.4}}, {"m": 1.05, "d": 1.8, "k": 42.0})
    with_it, without = (given("mass", data, [name], initial="near rest") for name in ("mass.friction", "mass.bias"))
    asked, learned = add(with_it, with_it.catalogue), learn(without)
    assert learned.history[-1].fit == pytest.approx(asked.history[-1].fit, abs=0.02)


def test_choices_that_gain_nothing_together_are_not_exchanged() -> None:
    """Beside themselves: two steps on trial may gain nothing over the base model."""
    data = measured("mass", {}, {"m": 1.05})
    opened = given("mass", data, ["mass.friction", "mass.drag", "mass.bias"])
    search = Search(Models(opened), FINE, opened.settings, Progress(lambda told: None), Checkpoint(None, ""))
    base = search.fit_base()
    known = {effect.name: effect for effect in opened.catalogue}
    first = search.with_effects(base, [known["mass.drag"]])
    second = search.with_effects(first, [known["mass.drag"], known["mass.bias"]])
    trial = Compared(first, "mass.drag", search.test(base, first))
    steps = [
        Step(first, "mass.drag", trial.test, True, (trial,)),
        Step(second, "mass.bias", search.test(first, second), True, ()),
    ]
    assert search._exchanged(second, list(steps)) == steps


def test_a_part_of_a_search_is_found_once() -> None:
    known = Checkpoint(None, "")
    fits = [refitted(Models(given("mass", measured("mass", {}))))]
    assert known.once("base", lambda: fits, [], FINE) == known.once("base", lambda: [], [], FINE) == fits


def test_a_refit_goes_on_from_its_file_as_it_would_have(tmp_path: Path) -> None:
    """However fine its runs are, and ended or not."""
    models, file = Models(given("mass", measured("mass", {}))), tmp_path / "kept.jsonl"
    candidate = models.of(())
    for part, simulation in (("rough", FINE.rough()), ("finer", FINE.finer(0.03))):
        fit = advance(begin(candidate, {"d": 1.3}, simulation), 1)
        assert not fit.ended
        Checkpoint(file, "whose").once(part, lambda fit=fit: [fit], [candidate], FINE)
        (kept,) = Checkpoint(file, "whose").once(part, lambda: [], [candidate], FINE)
        assert (kept.simulation, kept.expected) == (simulation, pytest.approx(fit.expected))
        assert converged(kept).values == converged(fit).values


def test_where_the_search_begins_is_part_of_what_a_checkpoint_is_of() -> None:
    opened = given("mass", measured("mass", {}))
    assert whose(opened, "diagnose") != whose(replace(opened, begins={"d": 1.3}), "diagnose")


def test_steps_are_limited_by_those_of_a_plant_that_moves() -> None:
    """A log that only dies away, six swings: a model that began at rest would take as good as no steps."""
    times = np.arange(0, 6, 0.01)
    x = 0.3 * np.exp(-0.2 * times) * np.cos(6.3 * times)
    record = Record(times, np.column_stack([0 * times, x]), ("F", "x"), ("N", "m"))
    logs = (MeasuredRecord("decay.txt", "stochastic", "fit", record, initial="estimate"),)
    opened = given("mass", replace(measured("mass"), records=logs), ["mass.friction"], initial="estimate")
    search = Search(Models(opened), FINE, opened.settings, Progress(lambda told: None), Checkpoint(None, ""))
    search.fit_base()
    for simulation in (search.fine, search.rough):
        assert simulation.solver.max_steps > opened.settings.patience * 6 * 5
