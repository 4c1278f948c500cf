"""Which parameters a fit moves, where they begin, and what the others are."""

from dataclasses import replace

import numpy as np
import pytest

from pysim.identify.greybox import Simulation, Tie, fit
from pysim.simulate import Esdirk, Rodas, simulate
from pysim.types import BadInput, Experiment, FitOutcome, Record, Signal
from pysim.workflow import beginning, fit_problem, fitted, model_of
from tests.toy import library, measured

MASS = model_of("Toy.Mass", [library()])
DATA = measured(1, "toy.friction", F_c=0.0)


def test_what_is_free_is_what_the_model_suggests_and_nobody_set() -> None:
    assert fit_problem(MASS, [DATA]).space.keys == ("m", "d", "k")
    task = fit_problem(MASS, [DATA], values={"m": 1.3}, fixed={"k": 19.0})
    assert (task.space.keys, dict(task.space.fixed)) == (("d",), {"m": 1.3, "k": 19.0})
    assert fit_problem(MASS, [DATA], ties=[Tie("d", "m", 2.0)]).space.keys == ("m", "k")


def test_values_are_where_what_is_named_begins_unless_a_start_says_otherwise() -> None:
    task = fit_problem(MASS, [DATA], free=["m", "d"], values={"m": 1.3, "d": 0.4, "k": 21.0}, starts={"d": 0.6})
    assert task.space.values(task.space.to_search(task.space.start)) == pytest.approx({"m": 1.3, "d": 0.6, "k": 21.0})


def test_the_fit_finds_what_was_simulated() -> None:
    """The toy's measurements are of m = 1.05, d = 0.75, k = 21."""
    found = fit(fit_problem(MASS, [DATA], free=["m", "k"], fixed={"d": 0.75}))
    for name, true in (("m", 1.05), ("k", 21.0)):
        assert abs(found[name].value - true) < 4 * found[name].std


@pytest.mark.parametrize("more", [{"starts": {"k": 1.0}}, {"bounds": {"k": (1.0, 2.0)}}])
def test_what_is_not_fitted_has_no_start_and_no_bounds(more: dict[str, dict[str, float]]) -> None:
    with pytest.raises(BadInput, match="k has a start or bounds but is not free"):
        fit_problem(MASS, [DATA], free=["m"], **more)  # type: ignore[arg-type]


def test_logs_in_which_no_input_moves_are_refused() -> None:
    still = []
    for record in DATA.records:
        assert isinstance(record.data, Record)
        still.append(replace(record, data=replace(record.data, values=record.data.values * np.array([0.0, 1.0]))))
    with pytest.raises(BadInput, match="the input F is constant"):
        fit_problem(MASS, [replace(DATA, records=tuple(still))])
    assert fit_problem(MASS, [replace(DATA, records=tuple(still), name="still"), DATA]).observations


def test_what_is_known_of_the_first_sample_wins_over_what_the_data_say() -> None:
    assert {one.initial for one in beginning(DATA, "estimate").records} == {"estimate"}
    assert beginning(DATA, None) is DATA
    free = fit_problem(MASS, [DATA], initial="estimate").observations[0].runs[0]
    assert np.isinf(free.initial[free.free]).all()
    held = fit_problem(MASS, [DATA], initial={"x": 0.1}).observations[0].runs[0]
    assert (held.free.size, held.experiment.start, held.begins) == (0, 0.0, 0.0)  # nothing is run ahead of the log
    assert fit_problem(MASS, [DATA], initial={"x": 0.1}).space.fixed["x"] == 0.1
    for wrong, said in (("resting", "is not known"), ({"F": 1.0}, "F is no state")):
        with pytest.raises(BadInput, match=said):
            fit_problem(MASS, [DATA], initial=wrong)  # type: ignore[arg-type]


def test_nothing_is_free_where_a_model_is_only_compared() -> None:
    task = fit_problem(MASS, [DATA], values={"m": 1.3}, nothing_free=True)
    assert (task.space.size, dict(task.space.fixed)) == (0, {"m": 1.3})


def test_a_search_that_ends_among_errors_of_the_integration_goes_on_with_a_finer_one() -> None:
    rough = Simulation(solver=Esdirk(rtol=0.2, atol=0.2))
    task = fit_problem(MASS, [DATA])
    first = fit(task, simulation=rough)
    again = fitted(task, simulation=rough)
    assert first.outcome is FitOutcome.STALLED
    assert again.misfit < first.misfit
    assert [one.start for one in again.estimates] == [one.start for one in first.estimates]


def test_a_log_may_begin_where_the_start_values_of_the_model_say() -> None:
    """The mass lies at 0 when it is pushed: at rest under the push it would lie at 6/20 m, and would not swing."""
    times, knots = np.arange(0.0, 8.0, 0.02), np.arange(0.0, 8.1, 0.5)
    push = Signal.through(knots, 6 + np.sin(knots))
    run = simulate(MASS, Experiment(times, ("x",), {"F": push}), solver=Rodas(rtol=1e-8, atol=1e-8))
    read = run["x"] + 1e-3 * np.random.default_rng(5).standard_normal(times.size)
    log = Record(times, np.column_stack([push.value(times), read]), ("F", "x"), ("N", "m"))
    data = replace(DATA, records=(replace(DATA.records[0], data=log),))
    left = {}
    for initial in ("model", "rest"):
        found = fit(fit_problem(MASS, [data], free=["m", "k"], initial=initial))
        left[initial] = found.records[0].residual.values
        if initial == "model":
            for name, true in (("m", 1.0), ("k", 20.0)):
                assert abs(found[name].value - true) < 4 * found[name].std
    assert np.sqrt(np.mean(left["model"] ** 2)) == pytest.approx(1.0, rel=0.1)  # times the noise
    assert np.sqrt(np.mean(left["rest"] ** 2)) > 20
