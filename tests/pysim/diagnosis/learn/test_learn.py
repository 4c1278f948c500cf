"""What is learned from logs of plants whose missing law is known in closed form."""

import math
from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
from scipy.integrate import solve_ivp

from pysim.diagnosis import Session, diagnose, learn, session
from pysim.diagnosis.learn.fit import raced
from pysim.types import Dataset, MeasuredRecord, MeasuredSignal, NoteCode, Record, answer_data
from pysim.types.answer import Diagnosis, Verdict
from pysim.types.record_kind import Command
from pysim.workflow.variants import Variants
from tests.known_answers.plants import Values
from tests.pysim.diagnosis.learn.clocked import DESIGN, on_a_clock, within_the_band
from tests.pysim.diagnosis.plants import given, measured


def opened(effects: dict[str, Values], names: list[str] | None = None) -> Session:
    return given("mass", measured("mass", effects, DESIGN), names, initial="near rest")


@cache
def damped() -> Diagnosis:
    """A damper that is stronger towards the ends of the way; the catalogue has another damping."""
    return diagnose(opened({"damper": {"d_2": 60.0}}, ["mass.drag"]))


def drifting(*, clock: bool) -> Session:
    """A damper that weakens by 0.02 N.s/m a second."""
    return on_a_clock(lambda t, x, v, bristle: -(1.2 - 0.02 * t) * v, clock=clock)


def test_damping_over_position_is_learned_at_its_place_over_its_variables() -> None:
    found = damped()
    (law,) = found.learned
    assert (law.slot, str(law.factor), law.argument) == ("force", "v", "force.x")
    assert (law.unit, law.argument_unit) == ("N.s/m", "m")
    assert law.share > 0.95
    assert law.test is not None
    assert law.test.verdict is Verdict.BETTER
    assert found.missing[0] is law


def test_its_curve_is_the_truth_within_its_band() -> None:
    (law,) = damped().learned
    assert within_the_band(law, -60.0 * law.knots**2) > 0.9
    assert np.sqrt(np.diag(law.covariance)).max() < 0.3 * np.ptp(law.coefficients)


def test_the_error_on_logs_that_were_not_fitted_falls_to_the_noise() -> None:
    found = damped()
    (law,) = found.learned
    assert [step.step for step in found.history] == ["prior", "refit", "force: v * h(force.x)"]
    before, after = law.held_out
    assert before == found.history[-2].validate
    assert after is not None
    assert after == found.history[-1].validate < 1.1
    assert before is not None
    assert before > 4


def test_what_drifts_is_learned_over_time_where_the_logs_say_when_they_began() -> None:
    session = drifting(clock=True)
    assert session.has_clock
    found = learn(session)
    (law,) = found.learned
    assert (law.slot, str(law.factor), law.argument, law.argument_unit) == ("force", "v", "time", "s")
    assert within_the_band(law, 0.02 * law.knots) > 0.9
    assert law.knots[-1] - law.knots[0] > 50
    before, after = found.history[-2].validate, found.history[-1].validate
    assert before is not None
    assert after is not None
    assert after < 1.1 < 0.5 * before


def test_without_a_clock_no_law_over_time_can_be_told() -> None:
    assert not drifting(clock=False).has_clock
    assert not opened({}).has_clock


def test_an_effect_that_the_law_makes_needless_loses_its_name_and_the_parameters_are_the_models_own() -> None:
    found = damped()
    assert found.verdict == "unknown"
    assert not found.effects
    assert found.complete  # of noise there is nothing more than with the law's cause, which has no name yet
    assert not answer_data(found)["complete"]
    assert [one.name for one in found.estimates] == ["m", "d", "k"]
    mass = found.estimates[0]
    assert mass.interval[0] < DESIGN["m"] < mass.interval[1]


def test_a_complete_model_gets_no_law_even_where_one_is_asked_for() -> None:
    found = learn(opened({}, []))
    assert not found.learned
    assert [step.step for step in found.history] == ["prior", "refit"]
    assert found.complete
    assert {NoteCode.NO_LAW, NoteCode.LAW_VETOED, NoteCode.NO_LAW_RUNS} & {note.code for note in found.notes}


def test_where_a_known_effect_suffices_none_is_added() -> None:
    found = diagnose(opened({"mass.friction": {"F_c": 0.4}}))
    assert found.verdict == "mass.friction"
    assert not found.learned
    assert not found.missing


def test_an_effect_whose_shape_differs_keeps_its_name_and_a_law_over_its_own_variable_refines_it() -> None:
    found = diagnose(opened({"mass.friction": {"F_c": 0.4}, "mass.drag": {"c_2": 0.5}}, ["mass.friction"]))
    assert found.verdict == "mass.friction"
    (law,) = found.learned
    assert found.complete
    assert not answer_data(found)["complete"]
    assert (law.slot, law.argument) == ("force", "force.v")
    before, after = found.history[-2].validate, found.history[-1].validate
    assert before is not None
    assert after is not None
    assert after < 1.1 < before


def test_a_model_without_slots_gets_a_law_in_the_equation_of_a_state() -> None:
    found = learn(replace(opened({"damper": {"d_2": 60.0}}, []), slots=()))
    (law,) = found.learned
    assert law.slot == "der(v)"
    assert found.history[-1].validate is not None
    assert found.history[-1].validate < 1.1
    assert str(law.factor) == "v"
    assert within_the_band(law, -60.0 * law.knots**2 / law.parameters["m"]) > 0.8


def without_choosing_logs(*effects: dict[str, Values]) -> Session:
    """A fitted log of each of these plants, and none that may choose."""
    logs = [measured("mass", own, DESIGN, fit=(1 + k,), validate=()) for k, own in enumerate(effects)]
    return given(
        "mass", replace(logs[0], records=tuple(r for own in logs for r in own.records)), [], initial="near rest"
    )


def test_where_no_log_may_choose_a_law_has_to_predict_each_log_from_the_others() -> None:
    found = learn(without_choosing_logs({"damper": {"d_2": 60.0}}, {"damper": {"d_2": 60.0}}))
    (law,) = found.learned
    assert law.test is not None
    assert law.test.held_out is not None
    assert law.test.held_out < 0
    assert within_the_band(law, -60.0 * law.knots**2) > 0.9


def test_a_law_that_another_log_contradicts_is_vetoed() -> None:
    found = learn(without_choosing_logs({"damper": {"d_2": 60.0}}, {"damper": {"d_2": -20.0}}))
    assert not found.learned
    assert not found.complete
    assert NoteCode.LAW_VETOED in {note.code for note in found.notes}


LAG = """
model Lag "A lag with a gain and an offset"
  parameter Real a(unit="1/s", min=0.1, max=10, nominal=1) = 1;
  parameter Real K(unit="1/s", min=0.1, max=10, nominal=1) = 1;
  parameter Real c(unit="1/s", min=-10, max=10, nominal=1) = 0;
  input Real F(unit="1", start=0);
  output Real x(unit="1", start=0, fixed=true);
equation
  der(x) = -a*x + K*F + c;
end Lag;
"""


def test_a_curve_over_an_input_of_two_values_is_what_gain_and_offset_can_do_and_is_not_tried(tmp_path: Path) -> None:
    """The law is -x^3. An input that is switched, as in many tests, takes no other value than its two."""
    (tmp_path / "Lag.mo").write_text(LAG, encoding="utf-8")
    rng, records, hold = np.random.default_rng(3), list[MeasuredRecord](), 0.5
    for name in ("one", "two"):
        time, x, level = np.arange(0, 30, 0.05), [0.0], rng.integers(0, 2, 61).astype(float)
        level[0] = 0.0  # it rests there
        for k in range(60):
            span = np.linspace(0, hold, 11)
            part = solve_ivp(lambda t, y, F: -y + F - y**3, (0, hold), x[-1:], t_eval=span, args=(level[k],), rtol=1e-9)
            x += part.y[0, 1:].tolist()
        values = np.column_stack([np.repeat(level[:60], 10), np.array(x[:-1]) + 1e-3 * rng.standard_normal(time.size)])
        records.append(MeasuredRecord(name, "stochastic", "fit", Record(time, values, ("F", "x"), ("1", "1"))))
    signals = (
        MeasuredSignal("F", "input", "1", "F", "F", hold=Command.STEPS),
        MeasuredSignal("x", "output", "1", "x", "x"),
    )
    own = Variants("Lag", (tmp_path / "Lag.mo",))
    data = Dataset("lag", "switched", "plant", signals, tuple(records))
    found = learn(session(own.build(())[0], data, initial="rest", workers=1, build_law=own.probed))
    (law,) = found.learned
    assert law.argument == "x"
    assert found.history[-1].fit is not None
    assert found.history[-1].fit < 1.1


@dataclass(frozen=True)
class Racer:
    """A law of which the costs after each heat are known."""

    name: str
    costs: tuple[float, ...]
    heats: int = 0

    @property
    def cost(self) -> float:
        return self.costs[min(self.heats, len(self.costs) - 1)]

    @property
    def fit(self) -> SimpleNamespace:
        return SimpleNamespace(good=math.isfinite(self.cost))


def test_a_law_that_gains_more_than_it_lacks_is_not_beaten_yet() -> None:
    quick, slow = Racer("quick", (40, 30, 29.9)), Racer("slow", (60, 42, 25, 20))
    running: Any = [quick, slow, Racer("poor", (70, 69, 0)), Racer("stuck", (50, math.inf))]
    ended: Any = raced(running, lambda one: replace(one, heats=one.heats + 1))
    assert {one.name: (one.cost, one.heats) for one in ended} == {"slow": (25, 2), "quick": (29.9, 2), "poor": (69, 1)}
