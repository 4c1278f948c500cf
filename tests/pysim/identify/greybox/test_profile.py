import numpy as np
import pytest

from pysim.identify.greybox import Parameter, Problem, Simulation, fit, problem, profile
from pysim.simulate import Esdirk
from pysim.types import BadInput, Fit, Model
from tests.pysim.identify.greybox import measurements as m

TIGHT = Simulation(solver=Esdirk(rtol=1e-8, atol=1e-8))


def test_a_profile_agrees_with_the_interval_where_all_is_nearly_linear(lag: Model) -> None:
    task = problem(lag, [m.dataset([m.ramp_log(2.0, 0.7, seed=1)])], ["K", "T"])
    found = fit(task, simulation=TIGHT)
    exact = profile(task, found, "K", simulation=TIGHT)
    low, high = white(task, found, 0)
    assert exact.interval == pytest.approx((low, high), abs=0.1 * (high - low))
    assert exact.points[:, 1].min() == pytest.approx(found.cost, abs=0.05)


def white(task: Problem, found: Fit, place: int) -> tuple[float, float]:
    """The interval of white residuals, to first order."""
    x = task.space.to_search(np.array([one.value for one in found.estimates]))
    residuals = task.residuals(simulation=TIGHT)
    point = residuals.evaluate(task.model, task.space, x)
    for _ in range(2):
        point = residuals.evaluate(task.model, task.space, x, point.carried_to(x))
    std = np.sqrt(np.linalg.inv(point.jacobian.T @ point.jacobian)[place, place]) * task.space.slope(x)[place]
    return found.estimates[place].value - 1.96 * std, found.estimates[place].value + 1.96 * std


def test_what_is_not_determined_has_a_profile_up_to_its_bounds(lag: Model) -> None:
    task = problem(lag, [m.dataset([m.ramp_log(2.0, 0.7, seed=1)])], ["K", "T", "g"])
    exact = profile(task, fit(task, simulation=TIGHT), "g", simulation=TIGHT)
    assert exact.interval[1] == 10.0  # K = 0.2 is within its bounds
    assert exact.interval[0] == pytest.approx(0.2, rel=0.1)  # K ends at 10


@pytest.mark.parametrize("everywhere", [[], ["x"]])
def test_a_start_value_of_one_log_is_held_in_that_log_only(lag: Model, everywhere: list[str]) -> None:
    """The model is linear in it, whether the other log starts from rest or from an unknown value of its own."""
    t = np.arange(0, 3, 0.02)
    rng = np.random.default_rng(4)
    away = m.ramp_answer(t, 2.0, 0.7) + 1.5 * np.exp(-t / 0.7) + m.NOISE * rng.standard_normal(t.size)
    records = [m.ramp_log(2.0, 0.7, seed=2), m.log(t, t, away, "away.txt")]
    free = ["K", "T", *everywhere, Parameter("x", record="away.txt")]
    task = problem(lag, [m.dataset(records)], free)
    found = fit(task, simulation=TIGHT)
    exact = profile(task, found, "x@away.txt", simulation=TIGHT)
    low, high = white(task, found, len(free) - 1)
    assert exact.interval == pytest.approx((low, high), abs=0.1 * (high - low))
    assert exact.points[:, 1].min() == pytest.approx(found.cost, abs=0.05)


def test_a_parameter_that_was_not_free_is_refused(lag: Model) -> None:
    task = problem(lag, [m.dataset([m.ramp_log(2.0, 0.7, seed=1)])], ["K", "T"])
    with pytest.raises(BadInput, match="g is not free"):
        profile(task, fit(task), "g")
