"""Which tests a term is looked for in, and what of its argument these see."""

from dataclasses import replace

import numpy as np
import pytest

from pysim.diagnose.adapter import Target
from pysim.diagnose.fitted import Fitted
from pysim.diagnose.locating.laws import slot_laws
from pysim.diagnose.locating.runs import patient, seen, thinned
from pysim.diagnose.nuisance import suspects
from pysim.diagnose.residuals import Ruler, rulers
from pysim.diagnose.subject import extended
from pysim.effects import slots
from pysim.identify.greybox.observation import Run
from pysim.identify.greybox.residuals import Point
from pysim.identify.greybox.response_table import ResponseTable
from pysim.types import Experiment, FrequencyResponse, SineTest
from tests.pysim.diagnose.bench import HOLD
from tests.pysim.diagnose.logs import RATE, sines, wave
from tests.pysim.diagnose.toy import base, library, measured, toy_subject


def test_a_log_over_time_is_always_kept() -> None:
    given = toy_subject(measured(1))
    ruler, _ = rulers(given.targets)
    what = extended(given, ())
    point = ruler.evaluation(what, what.space.to_search(what.space.start))
    few = thinned(ruler, point)
    assert [target.runs for target in few.targets] == [target.runs for target in ruler.targets]
    again = few.evaluation(what, point.x)
    np.testing.assert_allclose(again.residual, point.residual)


def log(name: str, duration: float) -> Target:
    return wave(np.zeros(round(duration * RATE) + 1), 1.0, name=name)


def stepped() -> Target:
    """Six sines that take 6.7 s in all."""
    return sines(np.zeros, 1.0)


def table() -> Target:
    """A response that exists as a table only, of 1 s per frequency."""
    frequency = np.array([1.0, 2.0, 3.0])
    response = FrequencyResponse(frequency, np.ones(3), np.zeros(3), SineTest(0.0, 1.0, "u", "y"), "a table")
    runs = tuple(Run(f"{f:g}Hz", Experiment(np.linspace(0, 1, 9), ("y",))) for f in frequency)
    return ResponseTable("data", "table.csv", "fit", response, runs, None)


def kept(*shown: tuple[Target, float]) -> list[str]:
    """What is run, by its records' names, of targets with residuals as large as told."""
    ruler = Ruler(tuple(target for target, _ in shown))
    sizes = (w.size for w in ruler.whitenings)
    residual = np.concatenate([np.full(n, size) for n, (_, size) in zip(sizes, shown, strict=True)])
    few = thinned(ruler, Point(np.zeros(0), float(residual @ residual), residual, np.zeros((residual.size, 0))))
    return [run.record for target in few.targets for run in target.runs]


@pytest.mark.parametrize("second", [1.0, 3.0])
def test_of_two_logs_as_long_the_one_that_shows_more_is_used(second: float) -> None:
    a, b = (log("a", 20.0), 2.0), (log("b", 20.0), second)
    assert kept(a, b) == kept(b, a) == [("a" if second < 2 else "b")]


def test_a_long_log_that_shows_no_more_for_its_time_leaves_room_for_sines() -> None:
    """Of 74.7 s 16.4 may be run: the short log and all sines; the long log alone would take all of it and more."""
    found = kept((log("long", 60.0), 2.0), (log("short", 8.0), 2.0), (stepped(), 2.0))
    assert found[0] == "short"
    assert len(found) == 7


def test_logs_and_sines_compete_once_there_is_a_log() -> None:
    """Of 113.2 s 24.9 may be run: 20 by the best log, the rest by what shows more for its time."""
    logs = (log("best", 20.0), 9.0), (log("other", 4.5), 1.1), (log("long", 82.0), 1.0)
    assert kept(*logs, (stepped(), 1.0)) == ["best", "other"]
    found = kept(*logs, (stepped(), 9.0))
    assert found[0] == "best"
    assert "other" not in found
    assert len(found) == 6


def test_a_log_that_shows_nothing_is_kept_where_there_is_no_other() -> None:
    assert kept((stepped(), 9.0), (log("a", 60.0), 0.5)) == ["a"]
    assert "a" in kept((stepped(), 9.0), (log("a", 1.0), 0.5))


def test_a_sine_that_had_not_settled_comes_after_the_log_and_ahead_of_other_sines() -> None:
    """Of 70.7 s 15.6 may be run: too little for all sines."""
    early = replace(log("early", 6.0), kind="frequency-response")
    found = kept((log("a", 8.0), 1.0), (stepped(), 9.0), (early, 0.5), (log("b", 50.0), 0.5))
    assert {"a", "early"} <= set(found)
    assert "b" not in found


def test_what_a_run_answers_near_the_plant_goes_with_it() -> None:
    targets = table(), log("a", 2.0), log("b", 20.0), stepped()
    runs = [run for target in targets for run in target.runs]
    near = tuple(np.full((run.experiment.times.size, 1), float(k)) for k, run in enumerate(runs))
    ruler = Ruler(targets, suspected=suspects(targets), near=near)
    residual = np.ones(sum(w.size for w in ruler.whitenings))
    few = thinned(ruler, Point(np.zeros(0), 0.0, residual, np.zeros((residual.size, 0))))
    names, left = [run.record for run in runs], [run.record for target in few.targets for run in target.runs]
    assert left[:4] == ["1Hz", "2Hz", "3Hz", "a"]
    assert [names[int(answer[0, 0])] for answer in few.near] == left


def test_the_argument_is_seen_on_the_models_own_way() -> None:
    given = toy_subject(measured(1))
    ruler, _ = rulers(given.targets)
    what = extended(given, ())
    current = Fitted(what, ruler.evaluation(what, what.space.to_search(what.space.start)))
    laws = slot_laws(slots("Toy.Mass", [library()]), base())
    found = seen(ruler, current, laws)
    assert set(found) == {"force|force.x", "force|force.v"}
    x, v = found["force|force.x"], found["force|force.v"]
    times = np.linspace(-HOLD, 11.98, x.size)
    np.testing.assert_allclose(np.gradient(x, times)[2:-2], v[2:-2], atol=0.02 * np.max(np.abs(v)))


def test_a_run_of_far_too_many_steps_has_failed() -> None:
    given = toy_subject(measured(1))
    ruler, _ = rulers(given.targets)
    what = extended(given, ())
    current = Fitted(what, ruler.evaluation(what, what.space.to_search(what.space.start)))
    limited = patient(ruler, current)
    np.testing.assert_array_equal(limited.at(what, current.point.x), current.point.residual)
    assert limited.solver.max_steps < 1e6
    short = replace(limited, solver=replace(limited.solver, max_steps=10))
    assert short.at(what, current.point.x) is None
