"""Which test would tell two repairs of the locked model apart."""

from __future__ import annotations

import numpy as np

from pysim.bench import read_plan, run_plan
from pysim.diagnose import subject
from pysim.diagnose.fitted import Fitted
from pysim.diagnose.next_test import next_test
from pysim.diagnose.subject import Extended
from pysim.identify.greybox import Parameter, problem
from pysim.types import Dataset, NextTest
from validation.pump import pump_model
from validation.real_measurements.explain import Explained
from validation.real_measurements.hypotheses import LOCKED

_PLAN, _SEED = "bench-01", 1


def settle(one: Explained, other: Explained, responses: Dataset) -> NextTest | None:
    """The shortest test that would tell two repairs by a known number apart, knowing what the responses say already.

    What a bench can do, and how noisy its signals are, is taken from the packaged plan of the virtual bench.
    """
    locked = pump_model("locked")
    bench = run_plan(locked, read_plan(_PLAN), _SEED).dataset
    own = subject(locked, bench, (), None, free=LOCKED)
    return next_test(own, _fitted(one, responses), _fitted(other, responses))


def _fitted(explained: Explained, responses: Dataset) -> Fitted:
    """The fit as a point with slopes of the responses."""
    model, hypothesis = pump_model("locked"), explained.hypothesis
    parameters = [Parameter(e.name, e.value, e.lower, e.upper) for e in explained.fit.estimates]
    task = problem(model, [responses], parameters, ties=hypothesis.ties)
    x = task.space.to_search(np.array([e.value for e in explained.fit.estimates]))
    return Fitted(Extended((), model, space=task.space), task.residuals().evaluate(model, task.space, x))
