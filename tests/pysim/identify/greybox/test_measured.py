"""How a log becomes a run of the model."""

from dataclasses import replace

import numpy as np
import pytest

from pysim.identify.greybox import Measurements, Rest, Treatment, fit, problem
from pysim.identify.greybox.time_log import TimeLog
from pysim.simulate import Rodas, simulate
from pysim.types import Experiment, Model, Record
from tests.pysim.identify.greybox import measurements as m

TIME = np.arange(0, 3, 0.02)
TIME_CONSTANT = 0.4  # of the model as it is built, s


def run_of(lag: Model, w: np.ndarray, *, rest: Rest | None = Rest(), **overrides: float) -> Experiment:  # noqa: B008
    data = m.dataset([m.log(TIME, w, m.ramp_answer(TIME, 2.0, 0.7))])
    (target,) = problem(
        lag, [Measurements(data, overrides=overrides)], ["K"], treatment=Treatment(rest=rest)
    ).observations
    assert isinstance(target, TimeLog)
    return target.run.experiment


def test_a_model_at_rest_gets_the_time_to_come_to_rest_elsewhere(lag: Model) -> None:
    ramp = run_of(lag, TIME)
    assert ramp.start < -5 * TIME_CONSTANT  # though the command begins where the model starts
    moved = replace(ramp, overrides={"fragile": 0.5, "T": 0.1}, record=("y",))
    equilibrium = np.log(0.5)  # of an offset that the model did not have when its log was read
    assert simulate(lag, moved, solver=Rodas(rtol=1e-8, atol=1e-8))["y"][0] == pytest.approx(equilibrium, abs=1e-4)


def test_a_model_that_moves_by_itself_starts_where_its_log_does(lag: Model) -> None:
    assert run_of(lag, TIME, x=1.0).start == 0.0
    assert run_of(lag, TIME, rest=None).start == 0.0


def test_a_command_that_begins_elsewhere_is_led_to(lag: Model) -> None:
    ahead = Rest(ramp=0.5, hold=2.0)
    assert run_of(lag, 1.0 + TIME, rest=ahead).start == -2.5
    assert run_of(lag, 1.0 + TIME, rest=ahead, x=1.0).start == -2.5


def test_every_record_of_a_fit_says_which_log_it_is(lag: Model) -> None:
    """Whatever the order in which logs are compared, of which file they are, and though a table stands between them."""
    ramps = [m.ramp_log(2.0, 0.7, seed=k, use=use, source="a.tdms") for k, use in ((1, "fit"), (2, "validate"))]
    fast, slow = (replace(m.sine_log(2.0, 0.7, f, seed=3), source="a.tdms") for f in (2.0, 0.5))
    data = m.dataset([ramps[0], fast, m.table(2.0, 0.7, np.array([0.1, 1.0])), slow, ramps[1]])
    records = fit(problem(lag, [data], ["K"])).records
    assert sorted(record.index for record in records) == [0, 1, 2, 3]
    for record in records:
        whole = data.logs()[record.index].data
        assert isinstance(whole, Record)
        samples = np.isin(whole.time, record.measured.time)
        assert np.array_equal(record.measured.values[:, 0], whole["y"][samples])
