import math
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from scipy.optimize import least_squares
from threadpoolctl import threadpool_info, threadpool_limits

from pysim.identify.greybox import (
    FREQUENCY,
    NOISE,
    TIME,
    Effort,
    GaussNewton,
    Measurements,
    Parameter,
    Problem,
    Simulation,
    SinePlan,
    Tie,
    Treatment,
    Tried,
    fit,
    problem,
)
from pysim.simulate import Esdirk
from pysim.types import BadInput, FitOutcome, FrequencyResponse, MeasuredRecord, Model, NoteCode, Record
from tests.pysim.identify.greybox import measurements as m

TIGHT = Simulation(solver=Esdirk(rtol=1e-8, atol=1e-8))


def test_a_log_over_time_gives_the_closed_form_least_squares_and_its_covariance(lag: Model) -> None:
    record = m.ramp_log(2.0, 0.7, seed=1)
    t, y = record.data.time, record.data["y"]
    for initial, answer, start in (
        ("rest", m.ramp_answer, [1.5, 0.4]),
        ("estimate", lambda t, K, T, x: m.ramp_answer(t, K, T) + x * np.exp(-t / T), [1.5, 0.4, 0.0]),
    ):
        task = problem(lag, [m.dataset([record])], ["K", "T"], treatment=Treatment(initial=initial))
        found = fit(task, simulation=TIGHT, optimiser=GaussNewton(tolerance=1e-7))
        oracle = least_squares(lambda p, a=answer: (y - a(t, *p)) / m.NOISE, start, xtol=1e-12, ftol=1e-12)
        assert found.outcome is FitOutcome.CONVERGED
        assert [e.value for e in found.estimates] == pytest.approx(oracle.x[:2], rel=2e-5)
        white = np.linalg.inv(oracle.jac.T @ oracle.jac)[:2, :2]
        point = task.residuals(simulation=TIGHT).evaluate(lag, task.space, task.space.to_search(oracle.x[:2]))
        assert np.linalg.inv(point.jacobian.T @ point.jacobian) == pytest.approx(
            white * (m.NOISE / point.levels[0]) ** -2 / np.outer(oracle.x[:2], oracle.x[:2]), rel=1e-2
        )
        variance = max(2 * oracle.cost / t.size, 1.0)
        expected = np.log(variance * m.NOISE**2) if variance > 1 else 2 * np.log(m.NOISE) + 2 * oracle.cost / t.size - 1
        assert found.cost == pytest.approx(0.5 * t.size * expected, rel=1e-6)
        assert found.records[0].rms["y"] == pytest.approx(math.sqrt(2 * oracle.cost / t.size), rel=1e-4)


def test_stepped_sines_give_gain_and_time_constant(lag: Model) -> None:
    """The truth lies inside 99.9 percent; with the noise gone the truth itself is found."""
    frequencies = (0.1, 0.3, 0.5, 1.0, 3.0)
    noisy = [m.sine_log(2.0, 0.7, f, seed=i) for i, f in enumerate(frequencies)]
    found = fit(problem(lag, [m.dataset(noisy)], ["K", "T"]), simulation=TIGHT)
    for name, truth in (("K", 2.0), ("T", 0.7)):
        assert abs(found[name].value - truth) < 3.3 * found[name].std
    assert found.misfit == pytest.approx(1.0, abs=0.25)
    clean = [m.sine_log(2.0, 0.7, f, seed=i, noise=0.0) for i, f in enumerate(frequencies)]
    exact = fit(problem(lag, [m.dataset(clean)], ["K", "T"]), simulation=TIGHT)
    assert [e.value for e in exact.estimates] == pytest.approx([2.0, 0.7], rel=1e-4)
    assert len(exact.responses) == 1
    assert exact.responses[0].comparison.passes


def test_orbits_and_transients_agree(lag: Model) -> None:
    records = [m.sine_log(2.0, 0.4, f, seed=3) for f in (0.3, 1.0, 2.0)]
    orbit = fit(problem(lag, [m.dataset(records)], ["K", "T"]), simulation=TIGHT)
    treatment = Treatment(steady="transient", sine=SinePlan(settle_periods=2))
    transient = fit(problem(lag, [m.dataset(records)], ["K", "T"], treatment=treatment), simulation=TIGHT)
    for name in ("K", "T"):  # what is left of the start after one period of settling moves the transient a little
        assert transient[name].value == pytest.approx(orbit[name].value, rel=0.05)


def test_a_table_is_met_in_both_objectives(lag: Model) -> None:
    data = [m.dataset([m.table(2.0, 0.7, np.array([0.1, 0.2, 0.5, 1.0, 2.0]))])]
    for objective in (NOISE, FREQUENCY):
        task = problem(lag, data, ["K", "T"], treatment=Treatment(reference_hz=None))
        optimiser = GaussNewton(tolerance=1e-4) if objective is NOISE else None
        found = fit(task, objective=objective, optimiser=optimiser, simulation=TIGHT)
        assert found.outcome is FitOutcome.CONVERGED, found.message
        assert [e.value for e in found.estimates] == pytest.approx([2.0, 0.7], rel=2e-3)


def test_a_table_is_met_by_runs_over_time_that_last_until_the_model_has_settled(lag: Model) -> None:
    """The time constant is twice the model's own."""
    data = [m.dataset([m.table(2.0, 0.8, np.array([0.3, 0.6, 1.2, 2.4]))])]
    treatment = Treatment(reference_hz=None, steady="transient")
    task = problem(lag, data, ["K", "T"], treatment=treatment)
    longest = [max(run.experiment.times) for one in task.observations for run in one.runs]
    assert min(longest) > 4.0
    found = fit(task, simulation=TIGHT, optimiser=GaussNewton(tolerance=1e-6))
    assert [e.value for e in found.estimates] == pytest.approx([2.0, 0.8], rel=5e-3)


def test_absolute_deviations_over_time_ignore_an_outlier(lag: Model) -> None:
    """Eq. 2.24 in K alone is a weighted median: most samples are exact, so the answer is exact too."""
    record = m.ramp_log(2.0, 0.4, seed=0, noise=0.0)
    values = record.data.values.copy()
    values[::10, 1] += 5.0
    data = m.dataset([m.log(record.data.time, values[:, 0], values[:, 1])])
    found = fit(problem(lag, [data], ["K"]), objective=TIME, simulation=TIGHT)
    assert found["K"].value == pytest.approx(2.0, rel=1e-3)
    squares = fit(problem(lag, [data], ["K"]), simulation=TIGHT)
    assert squares["K"].value > 2.1


def test_an_exact_null_direction_is_found_said_and_not_walked_along(lag: Model) -> None:
    found = fit(problem(lag, [m.dataset([m.ramp_log(2.0, 0.7, seed=2)])], ["K", "T", "g"]), simulation=TIGHT)
    assert dict(found.undetermined[0].exponents) == {"K": 1.0, "g": -1.0}
    assert not found["K"].determined
    assert found["K"].interval == (0.1, 10.0)
    assert found["T"].determined
    product = found.combinations[0]
    assert dict(product.exponents) == {"K": 1.0, "g": 1.0}
    assert product.interval[0] < 2.0 < product.interval[1]
    assert product.value == pytest.approx(2.0, rel=0.02)
    # on logarithmic scales the shortest way from (1.5, 1) to K g = 2 multiplies both by the same factor
    assert found["K"].value / found["g"].value == pytest.approx(1.5, rel=0.02)


def test_ties_and_fixed_values_take_the_place_of_free_ones(lag: Model) -> None:
    data = [m.dataset([m.ramp_log(2.0, 0.7, seed=2)])]
    tied = fit(problem(lag, data, ["K", "T"], ties=[Tie("g", "K", 0.5)]), simulation=TIGHT)
    assert tied["K"].value ** 2 * 0.5 == pytest.approx(2.0, rel=0.02)
    assert tied.values["g"] == pytest.approx(0.5 * tied["K"].value)
    fixed = fit(problem(lag, data, ["K", "T"], fixed={"g": 4.0}), simulation=TIGHT)
    assert fixed["K"].value == pytest.approx(0.5, rel=0.02)


def test_an_estimate_at_its_bound_has_a_one_sided_interval(lag: Model) -> None:
    data = [m.dataset([m.ramp_log(2.0, 0.7, seed=2)])]
    found = fit(problem(lag, data, [Parameter("K", upper=1.8), "T"]), simulation=TIGHT)
    assert (found["K"].value, found["K"].at) == (1.8, "upper")
    assert found["K"].interval[1] == 1.8
    assert found["T"].at == ""


def test_a_parameter_that_hardly_shows_is_open_to_its_bounds(lag: Model) -> None:
    t = np.arange(0, 3, 0.02)
    noise = m.NOISE * np.random.default_rng(3).standard_normal(t.size)
    found = fit(problem(lag, [m.dataset([m.log(t, 1e-6 * t, noise)])], ["K"]), simulation=TIGHT)
    assert found["K"].std > 300
    assert found["K"].interval == (0.1, 10.0)


def test_points_that_do_not_run_are_survived(lag: Model) -> None:
    """ln(1 - fragile) is no number from 1 on: the search has to come back from there."""
    t = np.arange(0, 3, 0.02)
    T, level = 0.4, math.log(1 - 0.98)
    record = m.log(t, 0 * t, level * (1 - np.exp(-t / T)))
    tried: list[Tried] = []
    free = [Parameter("fragile", start=0.3, lower=-20.0, upper=20.0)]
    found = fit(
        problem(lag, [m.dataset([record])], free, treatment=Treatment(rest=None)),
        optimiser=GaussNewton(radius=5.0),
        simulation=TIGHT,
        progress=tried.append,
    )
    assert any(math.isinf(one.last) for one in tried)
    assert found["fragile"].value == pytest.approx(0.98, rel=1e-3)


def test_held_out_records_are_compared_and_never_fitted(lag: Model) -> None:
    wrong = m.ramp_log(3.0, 0.7, seed=5, use="validate", source="held.txt")
    alone = fit(problem(lag, [m.dataset([m.ramp_log(2.0, 0.7, seed=2)])], ["K", "T"]), simulation=TIGHT)
    both = fit(problem(lag, [m.dataset([m.ramp_log(2.0, 0.7, seed=2), wrong])], ["K", "T"]), simulation=TIGHT)
    assert both.values == pytest.approx(dict(alone.values))
    assert both.held_out()["held.txt: y"] > 10


def test_a_record_that_starts_away_from_rest_has_its_own_initial_state(lag: Model) -> None:
    t = np.arange(0, 3, 0.02)
    rng = np.random.default_rng(4)
    away = m.ramp_answer(t, 2.0, 0.7) + 1.5 * np.exp(-t / 0.7) + m.NOISE * rng.standard_normal(t.size)
    records = [m.ramp_log(2.0, 0.7, seed=2), m.log(t, t, away, "away.txt")]
    free = ["K", "T", Parameter("x", record="away.txt")]
    found = fit(problem(lag, [m.dataset(records)], free), simulation=TIGHT)
    assert abs(found["x@away.txt"].value - 1.5) < 3.3 * found["x@away.txt"].std
    assert abs(found["T"].value - 0.7) < 3.3 * found["T"].std
    assert found.misfit == pytest.approx(1, abs=0.2)


def test_noise_that_is_not_specified_is_estimated_and_said(lag: Model) -> None:
    found = fit(problem(lag, [m.dataset([m.ramp_log(2.0, 0.7, seed=2)], noise=None)], ["K", "T"]), simulation=TIGHT)
    note = next(note for note in found.notes if note.code is NoteCode.NOISE_ESTIMATED)
    assert (note.values["signal"], note.values["unit"]) == ("y", "1")
    assert note.values["value"] == pytest.approx(m.NOISE, rel=0.25)
    assert found.records[0].noise[0] == pytest.approx(m.NOISE, rel=0.25)


def test_the_nominal_start_is_tried_too(lag: Model) -> None:
    data = [m.dataset([m.ramp_log(2.0, 0.7, seed=2)])]
    found = fit(problem(lag, data, [Parameter("K", start=9.0), "T"]), simulation=TIGHT)
    assert [s.name for s in found.starts] == ["given", "nominal"]
    drawn = fit(problem(lag, data, ["K", "T"]), simulation=TIGHT, effort=Effort(starts=2, seed=1))
    assert [s.name for s in drawn.starts] == ["given", "drawn-1", "drawn-2"]
    assert [s.cost for s in drawn.starts] == pytest.approx([found.cost] * 3, rel=4e-3)  # ends of rough searches
    assert drawn.cost == pytest.approx(found.cost, rel=1e-4)


def test_only_the_best_of_rough_searches_is_polished(lag: Model) -> None:
    tried: list[Tried] = []
    data = [m.dataset([m.ramp_log(2.0, 0.7, seed=2), m.sine_log(2.0, 0.7, 0.5, seed=1)])]
    task = problem(lag, data, [Parameter("K", start=9.0), "T"])
    found = fit(task, progress=tried.append)
    rough = {name: [one.last for one in tried if one.search == name] for name in ("given", "nominal")}
    polished = {one.search for one in tried} - set(rough)
    assert polished == {f"{min(rough, key=lambda name: min(rough[name]))}-polished"}
    assert sum(one.search in polished for one in tried) <= 4
    assert found.cost == pytest.approx(fit(task, simulation=TIGHT).cost, abs=GaussNewton().tolerance)


class Killed(Exception):
    """Stands for the end of the process."""


def killing(after: int) -> Callable[[Tried], None]:
    def kill(tried: Tried) -> None:
        if tried.tried == after:
            raise Killed

    return kill


def measured() -> list[MeasuredRecord]:
    """A log over time, stepped sines and a table that tells how uncertain it is."""
    table = m.table(2.0, 0.7, np.array([0.2, 0.5, 1.0]))
    assert isinstance(table.data, FrequencyResponse)
    response = replace(table.data, covariance=np.array([np.diag([1e-4, 1e-4, 1e-4])] * 3))
    sines = [m.sine_log(2.0, 0.7, f, seed=1) for f in (0.5, 1.0)]
    return [m.ramp_log(2.0, 0.7, seed=2), *sines, replace(table, data=response)]


def logged(
    lag: Model,
    records: list[MeasuredRecord],
    noise: float = m.NOISE,
    overrides: dict[str, float] | None = None,
    reference: float = 0.5,
    upper: float = 10.0,
) -> Problem:
    data = [Measurements(m.dataset(records, noise), overrides or {})]
    free = [Parameter("K", upper=upper), "T"]
    return problem(lag, data, free, treatment=Treatment(reference_hz=reference))


def test_a_killed_fit_resumes_bit_for_bit(lag: Model, tmp_path: Path) -> None:
    """The problem is put together anew, as in another process."""
    whole = fit(logged(lag, measured()))
    with pytest.raises(Killed):
        fit(logged(lag, measured()), effort=Effort(log=tmp_path), progress=killing(2))
    resumed = fit(logged(lag, measured()), effort=Effort(log=tmp_path, resume=True))
    assert dict(resumed.values) == dict(whole.values)
    assert (resumed.cost, resumed.iterations) == (whole.cost, whole.iterations)


def moved(record: MeasuredRecord, *, column: int | None) -> MeasuredRecord:
    """A log with one value other by next to nothing, or with other times."""
    assert isinstance(record.data, Record)
    time, values = record.data.time.copy(), record.data.values.copy()
    if column is None:
        time[1:] += 1e-9
    else:
        values[-40, column] += 1e-12
    return replace(record, data=replace(record.data, time=time, values=values))


def doubtful(record: MeasuredRecord) -> MeasuredRecord:
    """A table with a covariance that is other by next to nothing."""
    assert isinstance(record.data, FrequencyResponse)
    assert record.data.covariance is not None
    return replace(record, data=replace(record.data, covariance=record.data.covariance * (1 + 1e-12)))


def changed(place: int, change: Callable[[MeasuredRecord], MeasuredRecord]) -> list[MeasuredRecord]:
    return [change(record) if i == place else record for i, record in enumerate(measured())]


# What differs from the problem of the log, by next to nothing.
OTHER: dict[str, Callable[[Model], Problem]] = {
    "values": lambda lag: logged(lag, changed(0, lambda log: moved(log, column=1))),
    "input": lambda lag: logged(lag, changed(0, lambda log: moved(log, column=0))),
    "times": lambda lag: logged(lag, changed(0, lambda log: moved(log, column=None))),
    "sine": lambda lag: logged(lag, changed(1, lambda log: moved(log, column=1))),
    "use": lambda lag: logged(lag, changed(0, lambda log: replace(log, use="validate"))),
    "source": lambda lag: logged(lag, changed(0, lambda log: replace(log, source="another.txt"))),
    "covariance": lambda lag: logged(lag, changed(3, doubtful)),
    "fewer": lambda lag: logged(lag, measured()[1:]),
    "noise": lambda lag: logged(lag, measured(), noise=0.02000000001),
    "overrides": lambda lag: logged(lag, measured(), overrides={"g": 1.00000000001}),
    "reference": lambda lag: logged(lag, measured(), reference=1.0),
    "bound": lambda lag: logged(lag, measured(), upper=10.00000000001),
}


@pytest.mark.parametrize("other", OTHER.values(), ids=OTHER)
def test_a_fit_is_not_resumed_on_other_data(lag: Model, tmp_path: Path, other: Callable[[Model], Problem]) -> None:
    with pytest.raises(Killed):
        fit(logged(lag, measured()), effort=Effort(log=tmp_path), progress=killing(0))
    with pytest.raises(BadInput, match=r"another fit: other .*data.*; repeat the command that was stopped, or delete"):
        fit(other(lag), effort=Effort(log=tmp_path, resume=True))


def test_a_fit_begun_anew_meets_nothing_of_an_earlier_one(lag: Model, tmp_path: Path) -> None:
    """It is killed before the searches that the earlier one has logged too."""
    before, after = ([m.dataset([m.ramp_log(2.0, 0.7, seed=seed)])] for seed in (2, 3))
    free = [Parameter("K", start=9.0), "T"]
    fit(problem(lag, before, free), effort=Effort(log=tmp_path))
    with pytest.raises(Killed):
        fit(problem(lag, after, free), effort=Effort(log=tmp_path), progress=killing(1))
    resumed = fit(problem(lag, after, free), effort=Effort(log=tmp_path, resume=True))
    assert dict(resumed.values) == dict(fit(problem(lag, after, free)).values)


def test_a_fit_that_is_refused_leaves_the_log_of_an_earlier_one(lag: Model, tmp_path: Path) -> None:
    task = problem(lag, [m.dataset([m.ramp_log(2.0, 0.7, seed=2)])], ["K", "T"])
    with pytest.raises(Killed):
        fit(task, effort=Effort(log=tmp_path), progress=killing(1))
    with pytest.raises(BadInput, match="needs frequency data"):
        fit(task, objective=FREQUENCY, effort=Effort(log=tmp_path))
    assert (tmp_path / "given" / "state.npz").is_file()


def test_what_cannot_be_fitted_is_refused(lag: Model) -> None:
    data = [m.dataset([m.ramp_log(2.0, 0.7, seed=2)])]
    task = problem(lag, data, ["K"])
    with pytest.raises(BadInput, match="at least one free parameter"):
        fit(problem(lag, data, []))
    with pytest.raises(BadInput, match="needs frequency data"):
        fit(task, objective=FREQUENCY)
    with pytest.raises(BadInput, match="sum of squares"):
        fit(task, objective=TIME, optimiser=GaussNewton())
    with pytest.raises(BadInput, match="nothing to resume"):
        Effort(resume=True)
    free = [Parameter("fragile", start=2.0, lower=1.5, upper=3.0)]
    with pytest.raises(BadInput, match="could not be simulated at any start"):
        fit(problem(lag, data, free))


def test_blas_has_one_thread_while_runs_are_simulated_and_its_own_again_behind_them(lag: Model) -> None:
    def threads() -> set[int]:
        return {library["num_threads"] for library in threadpool_info() if library["user_api"] == "blas"}

    seen: list[set[int]] = []
    task = problem(lag, [m.dataset([m.ramp_log(2.0, 0.7, seed=1)])], ["K", "T"])
    with threadpool_limits(2, "blas"):
        fit(task, progress=lambda tried: seen.append(threads()))
        assert seen[0] == {1}
        assert threads() == {2}
