"""FMUs of others run in processes of their own: a crash or a hang is the outcome of one run."""

import time
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from pysim.simulate import Esdirk, Periodic, Rk45, periodic_many, sensitivities_many, simulate, simulate_many
from pysim.simulate import _foreign as foreign
from pysim.simulate._foreign import is_ours
from pysim.simulate._library import open_library
from pysim.simulate._run import run_many
from pysim.types import BadInput, Experiment, Model, Outcome, Signal
from tests.pysim.simulate.fixture_fmus import FRAGILE, OSCILLATOR
from tests.pysim.simulate.text_models import LAG, text_model

_ABORT, _SEGFAULT, _HANG = 3.0, 4.0, 5.0


def fragile(manner: float, end: float = 3.0) -> Experiment:
    return Experiment(np.array([1.0, end]), ("x",), overrides={"manner": manner})


def test_ours_and_others_are_told_apart(fixture_model: Callable[..., Model], tmp_path: Path) -> None:
    assert is_ours(text_model(LAG, tmp_path))
    assert not any(is_ours(fixture_model(OSCILLATOR, fmi)) for fmi in (2, 3))


@pytest.mark.parametrize("fmi", [2, 3])
@pytest.mark.parametrize("manner", [_ABORT, _SEGFAULT])
def test_a_crash_is_the_outcome_of_its_run(fixture_model: Callable[..., Model], fmi: int, manner: float) -> None:
    runs = [fragile(manner, 1.5), fragile(manner), fragile(manner, 1.5)]
    records = simulate_many(fixture_model(FRAGILE, fmi), runs, workers=2)
    assert [record.outcome for record in records] == [Outcome.DONE, Outcome.MODEL_ERROR, Outcome.DONE]
    assert "crashed" in records[1].message
    assert records[1].values.shape == (0, 1)
    np.testing.assert_array_equal(records[0].values, records[2].values)


def test_a_hang_ends_after_the_limit(fixture_model: Callable[..., Model], monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(foreign, "LONGEST", 0.5)
    model = fixture_model(FRAGILE)
    silent, fine = simulate_many(model, [fragile(_HANG), fragile(_HANG, 1.5)], workers=1)
    assert (silent.outcome, fine.outcome) == (Outcome.MODEL_ERROR, Outcome.DONE)
    assert "no answer" in silent.message


def test_crashes_do_not_end_what_needs_derivatives(fixture_model: Callable[..., Model]) -> None:
    model = fixture_model(FRAGILE)
    bad, fine = sensitivities_many(model, [fragile(_ABORT), fragile(_ABORT, 1.5)], ("x",))
    assert (bad.record.outcome, fine.record.outcome) == (Outcome.MODEL_ERROR, Outcome.DONE)
    (orbit,) = periodic_many(model, [Periodic(1.0, 4, ("x",), {}, {"manner": _SEGFAULT})])
    assert orbit.outcome is Outcome.MODEL_ERROR


def test_the_same_numbers_as_in_this_process(fixture_model: Callable[..., Model]) -> None:
    sine = Signal(np.zeros(1), np.zeros((1, 4)), np.array([[[1.0, 0.0, 3.0, 0.0]]]))
    runs = [Experiment(np.linspace(0, 5, 51), ("x", "v"), {"u": sine}, {"w": 1.0 + i}) for i in range(5)]
    model = fixture_model(OSCILLATOR)
    with open_library(model) as library:
        here = run_many(library, runs, Esdirk())
    for one, other in zip(simulate_many(model, runs, solver=Esdirk(), workers=2), here, strict=True):
        np.testing.assert_array_equal(one.values, other.values)
        assert one.statistics == other.statistics


def test_an_interrupt_ends_a_run_that_hangs(fixture_model: Callable[..., Model]) -> None:
    def stop(done: int, of: int) -> None:
        raise KeyboardInterrupt

    begun = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        simulate_many(fixture_model(FRAGILE), [fragile(_ABORT, 1.5), fragile(_HANG)], workers=2, progress=stop)
    assert time.monotonic() - begun < foreign.LONGEST


class Own(Rk45):
    """A solver that another process cannot import."""


def test_a_solver_of_the_users_own_goes_along(fixture_model: Callable[..., Model]) -> None:
    Own.__module__ = "__main__"
    experiment = Experiment(np.array([1.0]), ("x",), overrides={"x": 1.0})
    own, known = (simulate(fixture_model(OSCILLATOR), experiment, solver=solver) for solver in (Own(), Rk45()))
    np.testing.assert_array_equal(own.values, known.values)


def test_what_cannot_be_opened_is_said_before_any_run(fixture_model: Callable[..., Model], tmp_path: Path) -> None:
    model = fixture_model(OSCILLATOR)
    gone = Model(tmp_path / "gone.fmu", model.name, model.token, model.variables, model.abilities)
    with pytest.raises(BadInput, match="export it again"):
        simulate(gone, Experiment(np.ones(1), ("x",)))
