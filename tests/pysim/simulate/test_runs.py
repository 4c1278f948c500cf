"""A model that stays open gives what the functions give, and is asked once for what it offers."""

import math
from collections.abc import Callable
from unittest.mock import patch

import numpy as np
import pytest

from pysim.simulate import Esdirk, Periodic, Rk45, open_runs, periodic_many, sensitivities_many
from pysim.simulate.sensitivity import probe
from pysim.types import BadInput, Experiment, Model, Signal
from tests.pysim.simulate.fixture_fmus import OSCILLATOR

_SINE = Signal(np.zeros(1), np.zeros((1, 4)), np.array([[[1.0, 0.0, 3.0, 0.0]]]))


def experiments(count: int) -> list[Experiment]:
    times = np.linspace(0, 3, 7)
    return [Experiment(times, ("x",), {"u": _SINE}, {"D": 0.1 + 0.1 * i, "x": 1.0}) for i in range(count)]


def orbits(count: int) -> list[Periodic]:
    return [Periodic(2 * math.pi / 3, 8, ("x", "v"), {"u": _SINE}, {"D": 0.1 + 0.1 * i}) for i in range(count)]


@pytest.mark.parametrize("fmi", [2, 3])
def test_the_same_results_as_by_the_functions_and_one_question(fixture_model: Callable[..., Model], fmi: int) -> None:
    model, names = fixture_model(OSCILLATOR, fmi), ("w", "D")
    with patch.object(probe, "probe", wraps=probe.probe) as asked, open_runs(model) as runs:
        passes = [runs.sensitivities(experiments(3), names, workers=2) for _ in range(2)]
        found = [runs.orbits(orbits(3), names, workers=2) for _ in range(2)]
    assert asked.call_count == 2  # once for what each of them records
    for runs_of_pass in passes:
        for one, other in zip(runs_of_pass, sensitivities_many(model, experiments(3), names), strict=True):
            np.testing.assert_array_equal(one.record.values, other.record.values)
            np.testing.assert_array_equal(one.by_parameter, other.by_parameter)
    for orbits_of_pass in found:
        for one_orbit, other_orbit in zip(orbits_of_pass, periodic_many(model, orbits(3), names), strict=True):
            np.testing.assert_array_equal(one_orbit.record.values, other_orbit.record.values)
            np.testing.assert_array_equal(one_orbit.state_by_parameter, other_orbit.state_by_parameter)


def test_misuse_is_refused_as_by_the_functions(fixture_model: Callable[..., Model]) -> None:
    with open_runs(fixture_model(OSCILLATOR)) as runs:
        assert runs.orbits([]) == runs.sensitivities([], ()) == ()
        with pytest.raises(BadInput, match="no variable 'mass'"):
            runs.sensitivities(experiments(1), ("mass",))
        with pytest.raises(BadInput, match="cannot be differentiated"):
            runs.orbits(orbits(1), solver=Rk45())  # type: ignore[arg-type]
    with pytest.raises(BadInput, match="give what pysim"), open_runs("pump.fmu"):  # type: ignore[arg-type]
        pass


def test_results_do_not_depend_on_who_ran_before(fixture_model: Callable[..., Model]) -> None:
    with open_runs(fixture_model(OSCILLATOR)) as runs:
        alone = runs.sensitivities(experiments(1), ("w",), solver=Esdirk(1e-6, 1e-6))
        runs.orbits(orbits(2), ("D",))
        again = runs.sensitivities(experiments(1), ("w",), solver=Esdirk(1e-6, 1e-6))
    np.testing.assert_array_equal(again[0].by_parameter, alone[0].by_parameter)
