import threading

import numpy as np
import pytest

from pysim.simulate import Rodas, simulate, simulate_many
from pysim.types import BadInput, Experiment, Outcome
from tests.pysim.simulate.fixture_fmus import FRAGILE, OSCILLATOR


def experiments(count: int) -> list[Experiment]:
    times = np.linspace(0, 10, 51)
    return [Experiment(times, ("x", "v"), overrides={"w": 0.5 + 0.1 * i, "x": 1.0}) for i in range(count)]


@pytest.mark.parametrize("fmi", [2, 3])
@pytest.mark.parametrize("workers", [1, 4, None])
def test_many_equal_one_by_one_bit_for_bit(fixture_model, fmi, workers):
    model = fixture_model(OSCILLATOR, fmi)
    records = simulate_many(model, experiments(25), workers=workers)
    for experiment, record in zip(experiments(25), records, strict=True):
        alone = simulate(model, experiment)
        np.testing.assert_array_equal(record.values, alone.values)
        assert record.statistics == alone.statistics


def test_failed_run_does_not_touch_the_others(fixture_model):
    times = np.linspace(0, 1.5, 16)
    ends = [0, 0, 3.0, 0]
    runs = [Experiment(np.append(times, 2 + end) if end else times, ("x",)) for end in ends]
    records = simulate_many(fixture_model(FRAGILE), runs, solver=Rodas())
    assert [r.outcome is Outcome.DONE for r in records] == [True, True, False, True]
    np.testing.assert_array_equal(records[0].values, records[3].values)
    np.testing.assert_allclose(records[2].values[:10], records[0].values[:10], rtol=1e-4)


@pytest.mark.parametrize("fmi", [2, 3])
@pytest.mark.parametrize("workers", [1, 2])
def test_after_a_fatal_error_the_rest_runs_in_another_instance(fixture_model, fmi, workers):
    good, fatal = Experiment(np.array([1.0]), ("x",)), Experiment(np.array([3.0]), ("x",), overrides={"manner": 6.0})
    records = simulate_many(fixture_model(FRAGILE, fmi), [good, fatal, good, fatal, good, good], workers=workers)
    outcomes = [Outcome.DONE, Outcome.MODEL_ERROR]
    assert [r.outcome for r in records] == [outcomes[i] for i in (0, 1, 0, 1, 0, 0)]
    assert "a fatal FMI error" in records[1].message
    assert "root of a negative number" in records[1].message
    np.testing.assert_array_equal(records[4].values, records[0].values)


def test_progress_counts_up_in_the_calling_thread(fixture_model):
    seen = []
    simulate_many(
        fixture_model(OSCILLATOR),
        experiments(7),
        progress=lambda done, of: seen.append((done, of, threading.get_ident())),
    )
    assert seen == [(i, 7, threading.get_ident()) for i in range(1, 8)]


def test_stopping_ends_runs_that_are_under_way(fixture_model):
    long = Experiment(np.array([1e9]), ("x",), overrides={"D": 0.0, "x": 1.0})

    def stop(done: int, of: int) -> None:
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):  # else this takes minutes
        simulate_many(fixture_model(OSCILLATOR), [experiments(1)[0], long, long], workers=3, progress=stop)


def test_bad_input_is_found_before_anything_runs(fixture_model):
    wrong = Experiment(np.array([1.0]), ("nothing",))
    seen = []
    with pytest.raises(BadInput, match="no variable 'nothing'"):
        simulate_many(fixture_model(OSCILLATOR), [*experiments(2), wrong], progress=lambda *p: seen.append(p))
    assert seen == []
    for workers in (0, 1.5, "2"):
        with pytest.raises(BadInput, match="workers must be at least 1"):
            simulate_many(fixture_model(OSCILLATOR), experiments(1), workers=workers)
    with pytest.raises(BadInput, match=r"write \[Experiment\(\.\.\.\), \.\.\.\], also for a single one"):
        simulate_many(fixture_model(OSCILLATOR), experiments(1)[0])
    with pytest.raises(BadInput, match=r"experiments\[2\] is None"):
        simulate_many(fixture_model(OSCILLATOR), [*experiments(2), None])


def test_nothing_to_do_is_done(fixture_model):
    assert simulate_many(fixture_model(OSCILLATOR), []) == ()
