"""How the distance of a truth is counted, and that the closed FMU is closed."""

from pathlib import Path

import numpy as np
import pytest

from pysim.simulate import simulate
from pysim.types import Estimate, Experiment, Signal
from validation.initial_states.case import half_widths
from validation.initial_states.closed import closed_model
from validation.initial_states.mass import TRUTH, force, motion


def estimate(value: float, interval: tuple[float, float]) -> Estimate:
    return Estimate("K", "1", value, 1.0, 0.1, 10.0, 0.1, interval)


def test_a_truth_is_as_far_as_half_widths_to_its_side() -> None:
    lopsided = estimate(2.0, (1.0, 4.0))
    assert half_widths(lopsided, 3.0) == pytest.approx(0.5)
    assert half_widths(lopsided, 0.5) == pytest.approx(1.5)
    assert half_widths(lopsided, 2.0) == 0.0
    assert half_widths(estimate(2.0, (1.0, np.inf)), 100.0) == 0.0
    assert half_widths(estimate(2.0, (2.0, 3.0)), 1.0) > 1e6  # outside an interval that ends at the estimate


def test_the_closed_fmu_moves_as_the_mass_does_and_its_states_cannot_be_set(tmp_path: Path) -> None:
    model = closed_model(tmp_path)
    assert all(model[name].start is None for name in ("s1", "s2"))
    assert not model.abilities.directional_derivatives
    time = np.linspace(0.0, 2.0, 201)
    pushed = force(time, seed=1) * np.minimum(time, 1.0)
    command = Signal.lines(time, pushed)
    found = simulate(model, Experiment(time, ("x",), {"F": command}))
    np.testing.assert_allclose(found["x"], motion(time, pushed, (0.0, 0.0))[:, 0], atol=1e-6)
    assert TRUTH["c"] == model["c"].start
