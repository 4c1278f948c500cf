"""Which tests a term is looked for in, and what of its argument these see."""

from dataclasses import replace

import numpy as np

from pysim.diagnose.fitted import Fitted
from pysim.diagnose.locating.laws import slot_laws
from pysim.diagnose.locating.runs import patient, seen, thinned
from pysim.diagnose.residuals import rulers
from pysim.diagnose.subject import extended
from pysim.effects import slots
from pysim.identify.greybox import Rest
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


def test_the_argument_is_seen_on_the_models_own_way() -> None:
    given = toy_subject(measured(1))
    ruler, _ = rulers(given.targets)
    what = extended(given, ())
    current = Fitted(what, ruler.evaluation(what, what.space.to_search(what.space.start)))
    laws = slot_laws(slots("Toy.Mass", [library()]), base())
    found = seen(ruler, current, laws)
    assert set(found) == {"force|force.x", "force|force.v"}
    x, v = found["force|force.x"], found["force|force.v"]
    times = np.linspace(-Rest().hold, 11.98, x.size)
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
