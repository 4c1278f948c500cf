"""How long a model takes to come to rest, against a closed form."""

import math
from dataclasses import replace

import numpy as np
import pytest

from pysim.identify.greybox import Parameter, Rest, Treatment, problem
from pysim.identify.greybox.context import Context
from pysim.types import Model
from tests.pysim.identify.greybox import measurements as m


@pytest.mark.parametrize("slower", [1.0, 1e5])
def test_a_lag_comes_to_rest_in_some_time_constants_however_slow_it_is(lag: Model, slower: float) -> None:
    """A hundredth is left after T ln 100; looks are 5 percent apart. A slow plant once took a step a millisecond."""
    constant, time = 0.1 * slower, slower * np.arange(0, 3, 0.02)
    data = m.dataset([m.log(time, np.ones(time.size), np.ones(time.size))])
    context = Context(lag, data, {"T": constant}, ("y",), {"y": 1.0}, Treatment(), (None,))
    assert context.settling == pytest.approx(constant * math.log(100), rel=0.06)


def test_a_model_settles_as_slowly_as_its_parameters_say(lag: Model) -> None:
    """The command is held for a settling time at its first value; the model's own time constant is 0.1 s."""
    time = np.arange(0, 30, 0.02)
    for fixed, free in (({"T": 2.0}, ()), ({}, [Parameter("T", 2.0, 0.1, 10.0)])):
        data = m.dataset([m.log(time, np.ones(time.size), np.ones(time.size))])
        found = problem(lag, [data], free, fixed=fixed, treatment=Treatment(rest=Rest(), initial="rest"))
        (run,) = found.residuals().runs
        assert run.begins - run.experiment.start > 2.0 * math.log(100)


def test_the_time_of_a_run_is_the_clock_of_all_records(lag: Model) -> None:
    """What does not depend on time answers as it did, whenever the clock says that it began."""
    time = 3.0 + np.arange(0, 3, 0.02)
    residuals = {}
    for begin in (None, 1000.0):
        record = replace(m.log(time, np.sin(time), np.zeros(time.size)), begin=begin)
        found = problem(lag, [m.dataset([record])], (), fixed={"T": 0.2})
        (run,) = found.residuals().runs
        first = time[0] if begin is None else begin
        assert run.begins == pytest.approx(first, abs=1e-9)
        assert run.experiment.times == pytest.approx(time - time[0] + first, abs=1e-9)
        point = found.residuals().evaluate(lag, found.space, np.zeros(0), jacobian=False)
        residuals[begin] = point.residual * point.levels[0]
    assert residuals[1000.0] == pytest.approx(residuals[None], abs=1e-6)
    assert np.max(np.abs(residuals[None])) > 0.5


def test_a_clock_that_is_a_date_begins_with_the_first_log(lag: Model) -> None:
    time, noon = np.arange(0, 3, 0.02), 1.7e9
    begins = (noon + 40.0, noon, None)
    records = [replace(m.log(time, np.sin(time), np.sin(time)), begin=begin) for begin in begins]
    records = [replace(record, source=f"{k}.txt") for k, record in enumerate(records)]
    found = problem(lag, [m.dataset(records)], (), fixed={"T": 0.2})
    assert [run.begins for run in found.residuals().runs] == [40.0, 0.0, 0.0]
